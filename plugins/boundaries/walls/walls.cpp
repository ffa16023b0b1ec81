// Solid walls across one axis or more, the box periodic along the others: no slip, the director anchored or free.
// Fixed particles fill what the kernel reaches behind a wall. What they carry is taken from the mirror point in
// the fluid (S. Marrone et al., Comput. Methods Appl. Mech. Engrg. 200, 1526 (2011)), so that it has the wall's value
// half way, at the face of the box; pressure and whatever else has no value there has no slope. The velocity along a
// wall keeps its curvature behind it: otherwise the fluid slips where the stress varies across the wall. The order
// tensor does not, so that the molecular field stays the variation of the free energy.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class Walls final : public Boundary {
 public:
  void parameters(ParameterList& list) override {
    list.texts("axes", axes_).choices({"x", "y"}).doc("axes with a wall at both ends; the other axes are periodic");
    list.number("velocity_low", velocity_low_)
        .unit("m/s")
        .doc("speed of the wall at the low end of the axis, along the wall; positive toward larger x or y");
    list.number("velocity_high", velocity_high_).unit("m/s").doc("the same for the wall at the high end");
    list.text("anchoring", anchoring_)
        .choices({"none", "planar", "homeotropic", "angle"})
        .doc(
            "director at the walls. none: free (no torque); planar: along the walls; homeotropic: across them; angle: "
            "at angle_low and angle_high");
    list.number("angle_low", angle_low_)
        .unit("degree")
        .at_least(-180)
        .at_most(180)
        .doc("angle of the director to the x axis at the wall at the low end, with anchoring = \"angle\"");
    list.number("angle_high", angle_high_)
        .unit("degree")
        .at_least(-180)
        .at_most(180)
        .doc(
            "the same for the wall at the high end. The sign counts: 45 and -45 are different directors, but 90 and "
            "-90 are the same");
    list.number("order", order_)
        .unit("1")
        .at_least(0)
        .at_most(1)
        .doc("order q at the walls, if they anchor the director");
  }

  void scales(Scales& scales) const override {
    scales.speed = std::max({scales.speed, std::abs(velocity_low_), std::abs(velocity_high_)});
  }

  void prepare(const Scene& scene) override {
    if (axes_.empty()) refuse("axes", "names no axis: without walls the boundary is \"periodic_wrap\"");
    for (std::size_t n = 0; n < axes_.size(); ++n)
      if (std::find(axes_.begin(), axes_.begin() + static_cast<std::ptrdiff_t>(n), axes_[n]) !=
          axes_.begin() + static_cast<std::ptrdiff_t>(n))
        refuse("axes", "names \"" + axes_[n] + "\" twice");
    if (anchoring_ != "angle" && (angle_low_ != 0.0 || angle_high_ != 0.0))
      refuse(angle_low_ != 0.0 ? "angle_low" : "angle_high", "has a meaning only with anchoring = \"angle\"");
    if (anchoring_ == "none" && order_ != 1.0) refuse("order", "has a meaning only at walls that anchor the director");
    if (anchoring_ != "none" && scene.dimension != 2)
      refuse("anchoring", "knows the director of two dimensions alone: leave it out");
    if (anchoring_ != "none" && !scene.constants.contains("elastic_constant"))
      refuse("anchoring", "needs a nematic: add a [physics.*] section with type = \"beris_edwards\", or leave it out");
  }

  [[nodiscard]] Continuation continuation(int axis) const override {
    return has_wall(axis) ? Continuation::none : Continuation::wrapped;
  }

  /// The lattice of the particles, continued behind the walls.
  [[nodiscard]] std::vector<WallParticle> wall_particles(const Scene& scene, double reach) const override {
    std::array<int, 3> first{};
    std::array<int, 3> last{};
    std::array<double, 3> step{};
    for (unsigned d = 0; d < 3; ++d) {
      if (static_cast<int>(d) >= scene.dimension) continue;
      const int inside = static_cast<int>(std::lround(scene.box[d] / scene.spacing));
      step[d] = scene.box[d] / inside;
      const int layers = has_wall(static_cast<int>(d)) ? static_cast<int>(std::ceil(reach / step[d])) : 0;
      first[d] = -layers;
      last[d] = inside + layers - 1;
    }
    std::vector<WallParticle> all;
    std::array<int, 3> at{};
    for (at[2] = first[2]; at[2] <= last[2]; ++at[2])
      for (at[1] = first[1]; at[1] <= last[1]; ++at[1])
        for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) add(scene, at, step, all);
    return all;
  }

  [[nodiscard]] AffineRule wall_rule(const Scene&, const FieldKind& field, const WallParticle& at) const override {
    if (field.role == FieldRole::velocity) return AffineRule::curved_at(field, wall_velocity(at.normal));
    if (field.rank == Rank::order_tensor && field.role == FieldRole::state && anchoring_ != "none")
      return AffineRule::held_at(field, wall_order(at.normal));
    return AffineRule(field);
  }

 private:
  [[noreturn]] static void refuse(const std::string& key, const std::string& what) { throw BadParameter(key, what); }

  [[nodiscard]] bool has_wall(int axis) const {
    const char* const name = axis == 0 ? "x" : (axis == 1 ? "y" : "z");
    return std::find(axes_.begin(), axes_.end(), name) != axes_.end();
  }

  static void add(const Scene& scene, const std::array<int, 3>& at, const std::array<double, 3>& step,
                  std::vector<WallParticle>& all) {
    WallParticle wall;
    // In a corner the wall that is farther away counts: the particle lies deeper behind it.
    double deepest = 0.0;
    for (unsigned d = 0; d < static_cast<unsigned>(scene.dimension); ++d) {
      const double x = wall.position[d] = (at[d] + 0.5) * step[d];
      wall.mirror[d] = x < 0.0 ? -x : std::min(x, 2.0 * scene.box[d] - x);
      const double depth = std::max(-x, x - scene.box[d]);
      if (depth <= deepest) continue;
      deepest = depth;
      wall.normal = {};
      wall.normal[d] = x < 0.0 ? 1.0 : -1.0;
    }
    if (deepest > 0.0) all.push_back(wall);
  }

  /// Of the two walls across an axis, the normal points away from the axis' end at the one that is there.
  static bool is_high(const std::array<double, 3>& normal) { return normal[0] + normal[1] + normal[2] < 0.0; }
  static bool is_across_x(const std::array<double, 3>& normal) { return normal[0] != 0.0; }

  [[nodiscard]] std::array<double, 3> wall_velocity(const std::array<double, 3>& normal) const {
    std::array<double, 3> velocity{};
    velocity[is_across_x(normal) ? 1 : 0] = is_high(normal) ? velocity_high_ : velocity_low_;
    return velocity;
  }

  [[nodiscard]] std::array<double, 2> wall_order(const std::array<double, 3>& normal) const {
    const double along = is_across_x(normal) ? std::numbers::pi / 2.0 : 0.0;
    double angle = (is_high(normal) ? angle_high_ : angle_low_) * std::numbers::pi / 180.0;
    if (anchoring_ == "planar") angle = along;
    if (anchoring_ == "homeotropic") angle = std::numbers::pi / 2.0 - along;
    return {order_ * std::cos(2.0 * angle), order_ * std::sin(2.0 * angle)};
  }

  std::vector<std::string> axes_{"y"};
  double velocity_low_ = 0.0;
  double velocity_high_ = 0.0;
  std::string anchoring_ = "none";
  double angle_low_ = 0.0;
  double angle_high_ = 0.0;
  double order_ = 1.0;
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(Walls, "walls", "1.0.0",
                        "Solid walls: no slip, anchored or free director; fixed wall particles")
