#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include "mesogen/exec/for_each.hpp"
#include "mesogen/neighbours/neighbours.hpp"
#include "mesogen/particles/field_view.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

namespace sph {
struct SmoothingKernel;
}

/// What a pass is given: the fields that it declared, and no others. An undeclared access throws, naming the plugin
/// instance and the field.
class MESOGEN_EXPORT PassContext {
 public:
  PassContext() = default;
  PassContext(const PassContext&) = delete;
  PassContext& operator=(const PassContext&) = delete;
  virtual ~PassContext();

  /// A field declared by reads, reads_neighbours or reads_if_present.
  template <class Real>
  [[nodiscard]] FieldView<const Real> read(std::string_view field) const {
    const RawField raw = readable(field, sizeof(Real));
    return {static_cast<const Real*>(raw.data), raw.stride};
  }
  /// A field declared by writes or accumulates.
  template <class Real>
  [[nodiscard]] FieldView<Real> write(std::string_view field) const {
    const RawField raw = writable(field, sizeof(Real));
    return {static_cast<Real*>(raw.data), raw.stride};
  }
  /// Does the scene have this field, declared by reads_if_present?
  [[nodiscard]] virtual bool has(std::string_view field) const = 0;

  /// Cell grid for pair sums.
  template <class Real, int Dim>
  [[nodiscard]] Neighbours<Real, Dim> neighbours() const {
    Neighbours<Real, Dim> grid{};
    fill_neighbours(&grid, sizeof(Real), Dim);
    return grid;
  }
  [[nodiscard]] virtual const sph::SmoothingKernel& kernel() const = 0;
  [[nodiscard]] virtual const Scene& scene() const = 0;
  /// Where the pass runs. On a device, fields, positions and ids lie in its memory, for what goes through
  /// exec::for_each or sph::pair_sum alone; if the pass has loops of its own, say HOST_ONLY to mesogen_add_plugin. Ask
  /// for each in every run of the pass: a pointer that is kept may be out of date the next time.
  [[nodiscard]] virtual exec::Space space() const = 0;
  /// Real particles; boundary copies follow them in storage.
  [[nodiscard]] virtual Index count() const = 0;
  /// Coordinates of the particles, m; some spacings outside the box until they are sorted the next time.
  [[nodiscard]] virtual const double* position(int axis) const = 0;
  /// Another number whenever particles have moved or changed places in storage.
  [[nodiscard]] virtual std::uint64_t positions_version() const = 0;
  /// Numbers 0, 1, ... that stay with the particles while their order in storage changes: what random numbers go by.
  [[nodiscard]] virtual const std::int64_t* id() const = 0;
  /// Time at which fields stand now, s; the step size, s (0 when the rates are first evaluated); steps done.
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
