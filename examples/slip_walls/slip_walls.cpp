// Walls without friction across y, periodic along x: the fluid glides along them. Like the plugin `walls`, but the
// velocity along the wall goes on as it is and only its normal component turns round.

#include <cmath>

#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class SlipWalls final : public Boundary {
 public:
  static constexpr DimensionSet dimensions{2};

  [[nodiscard]] Continuation continuation(int axis) const override {
    return axis == 1 ? Continuation::none : Continuation::wrapped;
  }

  // The lattice of the particles goes on behind the walls, as far as the kernel reaches.
  [[nodiscard]] std::vector<WallParticle> wall_particles(const Scene& scene, double reach) const override {
    const auto columns = static_cast<int>(std::lround(scene.box[0] / scene.spacing));
    const auto layers = static_cast<int>(std::ceil(reach / scene.spacing));
    std::vector<WallParticle> all;
    for (int layer = 0; layer < layers; ++layer)
      for (int column = 0; column < columns; ++column) {
        const double x = (column + 0.5) * scene.box[0] / columns;
        const double depth = (layer + 0.5) * scene.spacing;
        const double top = scene.box[1];
        all.push_back({.position = {x, -depth, 0.0}, .mirror = {x, depth, 0.0}, .normal = {0.0, 1.0, 0.0}});
        all.push_back({.position = {x, top + depth, 0.0}, .mirror = {x, top - depth, 0.0}, .normal = {0.0, -1.0, 0.0}});
      }
    return all;
  }

  // The velocity has its mirror image behind the wall; all else goes on as it is, which is the default.
  [[nodiscard]] AffineRule wall_rule(const Scene& scene, const FieldKind& field,
                                     const WallParticle& at) const override {
    if (field.role == FieldRole::velocity) return AffineRule::reflected(field, at.normal);
    return Boundary::wall_rule(scene, field, at);
  }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(SlipWalls, "slip_walls", "1.0.0", "Walls without friction across y, periodic along x")
