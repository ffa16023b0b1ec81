#include <algorithm>

#include "mesogen/domain/periodic.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// Along one axis: by how much the images of a particle that lie near the box are shifted, itself (0) first.
struct Shifts {
  std::array<double, 3> value{};
  int count = 1;

  Shifts() = default;
  Shifts(double coordinate, double length, double reach) {
    if (coordinate < reach) value[static_cast<unsigned>(count++)] = length;
    if (coordinate >= length - reach) value[static_cast<unsigned>(count++)] = -length;
  }
};

/// Periodic box with copies: particles within reach of a face are repeated beyond the opposite one, those near an edge
/// or corner once for each of its faces and their combinations.
class PeriodicGhosts final : public Boundary {
 public:
  [[nodiscard]] bool wraps(int) const override { return false; }

  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override {
    for (int d = 0; d < scene.dimension; ++d)
      wrap_into_box(scene.box[static_cast<unsigned>(d)], position[d], images[d]);
  }

  /// Copies come in the order of their sources, whatever the number of threads: every chunk of particles counts its
  /// copies, a running sum tells where each chunk writes, then each fills its part.
  void copies(const Scene& scene, const double* const* position, Index count, double reach,
              Copies& out) const override {
    constexpr Index chunk = 4096;
    const Index chunks = (count + chunk - 1) / chunk;
    std::vector<std::size_t> begin(static_cast<std::size_t>(chunks) + 1, 0);
    const auto particles_of = [&](Index c, const auto& action) {
      for (Index i = c * chunk, end = std::min<Index>(count, i + chunk); i < end; ++i)
        action(i, shifts_of(scene, position, i, reach));
    };
#pragma omp parallel for schedule(static)
    for (Index c = 0; c < chunks; ++c)
      particles_of(c, [&](Index, const std::array<Shifts, 3>& shifts) {
        begin[static_cast<std::size_t>(c) + 1] +=
            static_cast<std::size_t>(shifts[0].count * shifts[1].count * shifts[2].count - 1);
      });
    for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
    out.source.resize(begin.back());
    out.offset.resize(begin.back());
#pragma omp parallel for schedule(static)
    for (Index c = 0; c < chunks; ++c) {
      std::size_t next = begin[static_cast<std::size_t>(c)];
      particles_of(c, [&](Index i, const std::array<Shifts, 3>& shifts) { next = write(i, shifts, next, out); });
    }
  }

 private:
  static std::array<Shifts, 3> shifts_of(const Scene& scene, const double* const* position, Index i, double reach) {
    std::array<Shifts, 3> shifts;
    for (unsigned d = 0; d < shifts.size(); ++d)
      if (d < static_cast<unsigned>(scene.dimension)) shifts[d] = Shifts(position[d][i], scene.box[d], reach);
    return shifts;
  }

  /// Writes all copies of particle i from place `next` on; returns the place behind them.
  static std::size_t write(Index i, const std::array<Shifts, 3>& shifts, std::size_t next, Copies& out) {
    const auto& [x, y, z] = shifts;
    for (unsigned c = 0; c < static_cast<unsigned>(z.count); ++c)
      for (unsigned b = 0; b < static_cast<unsigned>(y.count); ++b)
        for (unsigned a = 0; a < static_cast<unsigned>(x.count); ++a) {
          if (a + b + c == 0) continue;  // the particle itself
          out.source[next] = i;
          out.offset[next] = {x.value[a], y.value[b], z.value[c]};
          ++next;
        }
    return next;
  }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(PeriodicGhosts, "periodic_ghosts", "1.0.0", "Periodic box, copies beyond each face")
