#include "solids/solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "mesogen/diagnostics/error.hpp"
#include "plugin/plugin_call.hpp"

namespace mesogen {

namespace {

using Point = Shape::Point;

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point moved(const Point& from, double by, const Point& along) {
  return {from[0] + by * along[0], from[1] + by * along[1], from[2] + by * along[2]};
}

/// At a depth s behind the surface, with an extrapolation length b, a linear field that is `value` there becomes
/// value + (f - value) (b - s) / (b + s).
double share_behind(double length, double depth) {
  if (std::isinf(length)) return 1.0;
  return length + depth > 0.0 ? (length - depth) / (length + depth) : -1.0;
}

double depth_of(const WallParticle& at, const std::array<double, 3>& box, const std::array<bool, 3>& periodic) {
  double square = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    double way = at.mirror[d] - at.position[d];
    if (periodic[d]) way = std::remainder(way, box[d]);
    square += way * way;
  }
  return 0.5 * std::sqrt(square);
}

}  // namespace

Solid::Solid(std::string name, PluginPointer<Shape> shape, Case::Solid keys)
    : name_(std::move(name)), shape_(std::move(shape)), keys_(std::move(keys)) {}

void Solid::prepare(const Scene& scene) {
  dimension_ = scene.dimension;
  for (int d = 0; d < dimension_; ++d) {
    box_[static_cast<std::size_t>(d)] = scene.box[static_cast<std::size_t>(d)];
    periodic_[static_cast<std::size_t>(d)] = scene.periodic[static_cast<std::size_t>(d)];
  }
  step_ = 1e-4 * scene.spacing;
  keys_.velocity.resize(3);
  call_plugin(shape_.get_deleter().plugin, "prepare()", [&] { shape_->prepare(scene); });
  centre_ = call_plugin(shape_.get_deleter().plugin, "centre()", [&] { return shape_->centre(); });
  if (keys_.anchoring == "none") return;
  if (scene.dimension != 2) throw BadParameter("anchoring", "knows the director of two dimensions alone: leave it out");
  const auto elasticity = scene.constants.find("elastic_constant");
  if (elasticity == scene.constants.end())
    throw BadParameter(
        "anchoring", "needs a nematic: add a [physics.*] section that publishes an elastic_constant, or leave it out");
  if (keys_.anchoring_strength && scene.varying.contains("elastic_constant"))
    throw BadParameter(
        "anchoring_strength",
        "is a strength against an elastic_constant that is the same everywhere: give that as a number, or "
        "take anchoring_strength = \"strong\"");
  if (keys_.anchoring_strength) extrapolation_length_ = elasticity->second / *keys_.anchoring_strength;
}

// The shape is there in every image of the box.
double Solid::shape_distance(const Point& at) const {
  double least = shape_->distance(at);
  const int images = 3;
  for (int n = 1; n < images * images * images; ++n) {
    Point image = at;
    bool there = true;
    for (int d = 0, rest = n; d < 3; ++d, rest /= images) {
      const int boxes = rest % images == 2 ? -1 : rest % images;
      const auto axis = static_cast<std::size_t>(d);
      there = there && (boxes == 0 || periodic_[axis]);
      image[axis] += boxes * box_[axis];
    }
    if (there) least = std::min(least, shape_->distance(image));
  }
  return least;
}

double Solid::distance(const Point& at) const {
  const std::string_view plugin = shape_.get_deleter().plugin;
  const double distance = call_plugin(PluginCall{.plugin = plugin, .call = "distance()"}, ExitCode::run_failed,
                                      [&] { return shape_distance(at); });
  if (!std::isfinite(distance))
    throw Error(ExitCode::plugin_refused, fmt::format("plugin \"{}\", distance(): is {} at ({:g}, {:g}, {:g})", plugin,
                                                      distance, at[0], at[1], at[2]));
  return keys_.fluid == "inside" ? -distance : distance;
}

Point Solid::normal(const Point& at) const {
  Point slope{};
  for (int d = 0; d < dimension_; ++d) {
    Point there = at;
    const auto axis = static_cast<std::size_t>(d);
    there[axis] = at[axis] + step_;
    slope[axis] = distance(there);
    there[axis] = at[axis] - step_;
    slope[axis] -= distance(there);
  }
  const double length = std::sqrt(dot(slope, slope));
  if (!(length > 0.1 * step_)) return {};
  for (double& component : slope) component /= length;
  return slope;
}

// From where the slope leads to the surface, along it, until the way back is across. For an exact distance the first
// step is enough.
Point Solid::nearest(const Point& at) const {
  const auto onto_surface = [this](Point point) {
    for (int n = 0; n < 8; ++n) {
      const double away = distance(point);
      if (std::abs(away) < 1e-9 * step_) break;
      point = moved(point, -away, normal(point));
    }
    return point;
  };
  Point best = onto_surface(at);
  for (int n = 0; n < 8; ++n) {
    const Point n_here = normal(best);
    const Point way = moved(at, -1.0, best);
    const Point aside = moved(way, -dot(way, n_here), n_here);
    if (dot(aside, aside) < 1e-4 * step_ * step_) break;
    const Point next = onto_surface(moved(best, 1.0, aside));
    const Point way_next = moved(at, -1.0, next);
    if (!(dot(way_next, way_next) < dot(way, way))) break;
    best = next;
  }
  return best;
}

Point Solid::velocity(const Point& at) const {
  Point velocity{};
  std::copy(keys_.velocity.begin(), keys_.velocity.end(), velocity.begin());
  if (keys_.angular_velocity == 0.0) return velocity;
  Point arm{};  // from the nearest image of the centre
  for (int d = 0; d < dimension_; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    arm[axis] = at[axis] - centre_[axis];
    if (periodic_[axis]) arm[axis] = std::remainder(arm[axis], box_[axis]);
  }
  velocity[0] -= keys_.angular_velocity * arm[1];
  velocity[1] += keys_.angular_velocity * arm[0];
  return velocity;
}

AffineRule Solid::rule(const FieldKind& field, const WallParticle& at) const {
  if (field.role == FieldRole::velocity) return velocity_rule(field, at);
  if (field.rank != Rank::order_tensor || field.role != FieldRole::state || keys_.anchoring == "none")
    return AffineRule(field);
  const std::array<double, 2> value = wall_order(at.normal);
  if (extrapolation_length_ == 0.0) return AffineRule::held_at(field, value);
  AffineRule rule(field);
  const double share = share_behind(extrapolation_length_, depth_of(at, box_, periodic_));
  for (int c = 0; c < rule.components(); ++c) {
    rule.matrix(c, c) = share;
    rule.summand(c) = (1.0 - share) * value[static_cast<std::size_t>(c)];
  }
  return rule;
}

// v' = U - (v - U).n n + share (v - U) along the wall.
AffineRule Solid::velocity_rule(const FieldKind& field, const WallParticle& at) const {
  Point surface{};
  for (std::size_t d = 0; d < 3; ++d) {
    double way = at.mirror[d] - at.position[d];
    if (periodic_[d]) way = std::remainder(way, box_[d]);
    surface[d] = at.position[d] + 0.5 * way;
  }
  const Point wall = velocity(surface);
  if (keys_.slip.word == "none") return AffineRule::curved_at(field, wall);
  const double length = keys_.slip.word == "free" ? std::numeric_limits<double>::infinity() : keys_.slip.number;
  const double share = share_behind(length, depth_of(at, box_, periodic_));
  AffineRule rule(field);
  for (int r = 0; r < rule.components(); ++r)
    for (int c = 0; c < rule.components(); ++c) {
      const double across = at.normal[static_cast<std::size_t>(r)] * at.normal[static_cast<std::size_t>(c)];
      rule.matrix(r, c) = share * ((r == c ? 1.0 : 0.0) - across) - across;
    }
  for (int r = 0; r < rule.components(); ++r) {
    rule.summand(r) = wall[static_cast<std::size_t>(r)];
    for (int c = 0; c < rule.components(); ++c)
      rule.summand(r) -= rule.matrix(r, c) * wall[static_cast<std::size_t>(c)];
  }
  return rule;
}

// The tangent has the fluid at its left.
std::array<double, 2> Solid::wall_order(const Point& normal) const {
  const double tangent = std::atan2(-normal[0], normal[1]);
  double angle = tangent;
  if (keys_.anchoring == "normal") angle += 0.5 * std::numbers::pi;
  if (keys_.anchoring == "angle") angle += keys_.angle * std::numbers::pi / 180.0;
  return {keys_.order * std::cos(2.0 * angle), keys_.order * std::sin(2.0 * angle)};
}

}  // namespace mesogen
