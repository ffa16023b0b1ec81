// A box with two ways to go on beyond its faces: periodic along x, and solid walls across y, where the fluid does not
// slip. See Boundary for all that a boundary can say.

#include <cmath>

#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class TemplateNamePlugin final : public Boundary {
 public:
  // Without this line: in any dimension.
  static constexpr DimensionSet dimensions{2};

  // Continuation::ghosts is periodic too; Continuation::none lets the box end.
  [[nodiscard]] Continuation continuation(int axis) const override {
    return axis == 1 ? Continuation::none : Continuation::wrapped;
  }

  // The lattice of the particles goes on behind both walls, as far as the kernel reaches.
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

  // The fluid is at rest at the walls; everything else has no slope there, which is the default.
  [[nodiscard]] AffineRule wall_rule(const Scene& scene, const FieldKind& field,
                                     const WallParticle& at) const override {
    const double at_rest[3] = {0.0, 0.0, 0.0};
    if (field.role == FieldRole::velocity) return AffineRule::curved_at(field, at_rest);
    return Boundary::wall_rule(scene, field, at);
  }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(TemplateNamePlugin, "template_name", "1.0.0", "Periodic along x, no slip at walls across y")
