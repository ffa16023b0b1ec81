// A boundary that breaks one promise, which a definition names.
#include "mesogen/plugin/boundary.hpp"

#include <limits>
#include <stdexcept>

#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class Misbehaving final : public Boundary {
 public:
  [[nodiscard]] Continuation continuation(int axis) const override {
    return axis == 0 ? Continuation::ghosts : Continuation::none;
  }

#ifdef KEEP_INSIDE
  void keep_inside(const Scene&, double*, std::int32_t*) const override {
    throw std::runtime_error("nobody expects this");
  }
#endif
  [[nodiscard]] std::array<double, 3> shear(const Scene&, const std::array<int, 3>&) const override {
#ifdef SHEAR_NOT_FINITE
    return {std::numeric_limits<double>::infinity(), 0.0, 0.0};
#elif defined(SHEAR_ACROSS)
    return {0.0, 0.5, 0.0};
#else
    return {};
#endif
  }
  [[nodiscard]] std::vector<WallParticle> wall_particles(const Scene& scene, double) const override {
#ifdef WALL_PARTICLES
    throw 42;
#endif
    WallParticle wall{.position = {0.25, -0.01, 0.0}, .mirror = {0.25, 0.01, 0.0}, .normal = {0.0, 1.0, 0.0}};
#ifdef WALL_ASTRAY
    wall.position[0] = 2.0 * scene.box[0];
#endif
#ifdef MIRROR_ASTRAY
    wall.mirror[1] = 1e300;
#endif
#ifdef WALL_NOWHERE
    wall.position[0] = std::numeric_limits<double>::quiet_NaN();
#endif
#ifdef LONG_NORMAL
    wall.normal[1] = 2.0;
#endif
#ifdef NORMAL_INWARD
    wall.normal[1] = -1.0;
#endif
#ifdef NORMAL_ALONG
    wall.normal = {1.0, 0.0, 0.0};
#endif
    (void)scene;
    return {wall};
  }
  [[nodiscard]] AffineRule ghost_rule(const Scene&, const FieldKind& field, const std::array<int, 3>&) const override {
#ifdef GHOST_RULE
    throw std::out_of_range("no such image");
#endif
    return AffineRule(field);
  }
  [[nodiscard]] AffineRule wall_rule(const Scene&, const FieldKind& field, const WallParticle&) const override {
#ifdef WALL_RULE
    throw std::out_of_range("no such field");
#endif
    AffineRule rule(field);
#ifdef RULE_OF_ANOTHER
    rule = AffineRule(FieldKind{Rank::matrix, field.role, 3});
#endif
#ifdef RULE_NOT_FINITE
    rule.matrix(0, 0) = std::numeric_limits<double>::infinity();
#endif
    return rule;
  }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(Misbehaving, NAME, "1.0.0", "Breaks a promise")
