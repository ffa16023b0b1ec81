#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include "mesogen/exec/for_each.hpp"
#include "mesogen/fields/field_view.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/sph/neighbours.hpp"

namespace mesogen {

namespace sph {
struct SmoothingKernel;
}
namespace mesh {
class DeviceMesh;
}
namespace exec {
class Sharing;
}

/// A number that may vary (Parameter::may_vary), at each particle.
template <class Real>
struct Varying {
  FieldView<const Real> field;  ///< empty: the same everywhere
  Real number;

  MESOGEN_HOST_DEVICE Real operator()(Index i) const { return field ? field(i) : number; }
};

/// What a pass may use: the fields that it declared, and no others. Access to any other field throws an error that
/// names the plugin instance and the field.
class MESOGEN_EXPORT PassContext {
 public:
  PassContext() = default;
  PassContext(const PassContext&) = delete;
  PassContext& operator=(const PassContext&) = delete;
  virtual ~PassContext();

  /// A field that the pass declared by reads, reads_neighbours or reads_if_present.
  template <class Real>
  [[nodiscard]] FieldView<const Real> read(std::string_view field) const {
    const RawField raw = readable(field, sizeof(Real));
    return {static_cast<const Real*>(raw.data), raw.stride};
  }
  /// A field that the pass declared by writes or accumulates.
  template <class Real>
  [[nodiscard]] FieldView<Real> write(std::string_view field) const {
    const RawField raw = writable(field, sizeof(Real));
    return {static_cast<Real*>(raw.data), raw.stride};
  }
  /// True if the scene has this field, which the pass declared by reads_if_present.
  [[nodiscard]] virtual bool has(std::string_view field) const = 0;

  /// A number that may vary, whose field the pass declared by reads_if_present; `otherwise` in a scene without it.
  template <class Real>
  [[nodiscard]] Varying<Real> varying(std::string_view field, double otherwise) const {
    if (has(field)) return {read<Real>(field), Real(otherwise)};
    return {{}, Real(otherwise)};
  }

  /// Cell grid for sums over pairs.
  template <class Real, int Dim>
  [[nodiscard]] Neighbours<Real, Dim> neighbours() const {
    Neighbours<Real, Dim> grid{};
    fill_neighbours(&grid, sizeof(Real), Dim);
    return grid;
  }
  [[nodiscard]] virtual const sph::SmoothingKernel& kernel() const = 0;
  [[nodiscard]] virtual const Scene& scene() const = 0;
  /// The space in which the pass runs. On a device, fields, positions and ids lie in the memory of the device: only
  /// exec::for_each and sph::pair_sum may use them. If the pass has loops of its own, say HOST_ONLY to
  /// mesogen_add_plugin. Ask for pointers in every run of the pass: a pointer of an earlier run may be out of date.
  [[nodiscard]] virtual exec::Space space() const = 0;
  /// What a device offers a mesh beside the particles (mesh/pass_spectrum.hpp); null on the host.
  [[nodiscard]] virtual const mesh::DeviceMesh* device_mesh() const;
  /// The processes that share the particles, to add up with them what this one found for its own; null where there is
  /// one.
  [[nodiscard]] virtual const exec::Sharing* sharing() const;
  /// Number of particles of the fluid that this process has. Boundary copies follow them in storage.
  [[nodiscard]] virtual Index count() const = 0;
  /// Coordinates of the particles, m. Between two sortings they may be some spacings outside the box.
  [[nodiscard]] virtual const double* position(int axis) const = 0;
  /// A number that changes whenever particles have moved or have changed their order in storage.
  [[nodiscard]] virtual std::uint64_t positions_version() const = 0;
  /// Numbers 0, 1, ... that stay with the particles while their order in storage changes. Random numbers use them.
  [[nodiscard]] virtual const std::int64_t* id() const = 0;
  /// Time of the present fields, s; step size, s (0 when the rates are first computed); number of steps done.
  [[nodiscard]] virtual double time() const = 0;
  [[nodiscard]] virtual double step_size() const = 0;
  [[nodiscard]] virtual std::int64_t step() const = 0;

 protected:
  struct RawField {
    void* data;
    std::ptrdiff_t stride;
  };
  [[nodiscard]] virtual RawField readable(std::string_view field, std::size_t element_size) const = 0;
  [[nodiscard]] virtual RawField writable(std::string_view field, std::size_t element_size) const = 0;
  virtual void fill_neighbours(void* grid, std::size_t element_size, int dimension) const = 0;
};

}  // namespace mesogen
