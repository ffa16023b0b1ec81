// A shape by a formula f that is below 0 inside of it and above 0 outside, such as x^2 / 4 + y^2 - 1. The formula need
// not be a distance: the nearest point of f = 0, where the way there is along the slope of f, is found by Newton's
// method.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/expression.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/shape.hpp"
#include "mesogen/text/formatted.hpp"

namespace {

using namespace mesogen;

class ShapeByExpression final : public Shape {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.text("distance", text_)
        .required()
        .doc(
            "formula of x and y (m): below 0 inside, above 0 outside, with a slope wherever it is 0. It need not grow "
            "like a distance: \"(x - 5)^2 / 4 + (y - 5)^2 - 1\"");
    list.numbers("centre", centre_).unit("m").sizes({2}).doc("the point around which it turns");
  }

  void prepare(const Scene& scene) override {
    try {
      formula_.emplace(text_, scene);
    } catch (const Error& error) {
      throw BadParameter("distance", "\"" + text_ + "\": " + error.what());
    }
    check_finite(scene);
    step_ = 1e-4 * scene.spacing;
    farthest_ = scene.support;
    find_surface(scene);
  }

  [[nodiscard]] double distance(const Point& at) const override {
    const Near near = look_at(at);
    const double value = near.value;
    if (!std::isfinite(value)) return value;
    const double sign = value < 0.0 ? -1.0 : 1.0;
    const double steepness = std::hypot(near.x, near.y);
    const double guess = std::abs(value) / steepness;
    // Far away the points of the surface are near enough.
    if (!(guess < 4.0 * farthest_)) return sign * distance_to_surface(at);
    const Point foot = foot_of(at);
    return sign * std::hypot(at[0] - foot[0], at[1] - foot[1]);
  }

  [[nodiscard]] Point centre() const override { return {centre_[0], centre_[1], 0.0}; }

 private:
  static constexpr int along = 256;
  [[nodiscard]] static Point point_of(const Scene& scene, int i, int j) {
    return {scene.box[0] * i / along, scene.box[1] * j / along, 0.0};
  }

  void check_finite(const Scene& scene) const {
    for (int j = 0; j <= along; ++j)
      for (int i = 0; i <= along; ++i) {
        const Point at = point_of(scene, i, j);
        if (!std::isfinite((*formula_)(at)))
          throw BadParameter("distance", formatted("\"%s\" must be finite everywhere, but is no number at (%g, %g)",
                                                   text_.c_str(), at[0], at[1]));
      }
  }

  // Points of the surface: where the sign changes from one point of the grid to the next.
  void find_surface(const Scene& scene) {
    for (int j = 0; j <= along; ++j)
      for (int i = 0; i <= along; ++i)
        for (const auto& [right, up] : {std::pair(1, 0), std::pair(0, 1)}) {
          Point inside = point_of(scene, i, j);
          Point outside = point_of(scene, i + right, j + up);
          if (((*formula_)(inside) < 0.0) == ((*formula_)(outside) < 0.0)) continue;
          if ((*formula_)(outside) < 0.0) std::swap(inside, outside);
          for (int n = 0; n < 50; ++n) {
            const Point middle = {0.5 * (inside[0] + outside[0]), 0.5 * (inside[1] + outside[1]), 0.0};
            ((*formula_)(middle) < 0.0 ? inside : outside) = middle;
          }
          check_slope(inside, scene.spacing);
          surface_.push_back(inside);
        }
  }

  // From a point of the surface on it must rise, by no jump.
  void check_slope(const Point& at, double spacing) const {
    const Near near = look_at(at);
    const double steepness = std::hypot(near.x, near.y);
    const Point beyond = {at[0] + spacing * near.x / steepness, at[1] + spacing * near.y / steepness, 0.0};
    const double rise = steepness > 0.0 ? std::abs((*formula_)(beyond)) : 0.0;
    if (steepness * spacing > 0.1 * rise && std::abs(near.value) < 0.1 * rise) return;
    throw BadParameter("distance",
                       formatted("\"%s\" must rise through 0 with a slope, but jumps or is flat at (%g, %g): "
                                 "write a formula that grows with the distance",
                                 text_.c_str(), at[0], at[1]));
  }

  [[nodiscard]] double distance_to_surface(const Point& at) const {
    double least = 2.0 * farthest_;
    double square = std::numeric_limits<double>::infinity();
    for (const Point& point : surface_)
      square = std::min(square, (at[0] - point[0]) * (at[0] - point[0]) + (at[1] - point[1]) * (at[1] - point[1]));
    return std::isfinite(square) ? std::sqrt(square) : least;
  }

  /// The formula near a point: value, slope and curvatures, by differences.
  struct Near {
    double value, x, y, xx, xy, yy;
  };
  [[nodiscard]] Near look_at(const Point& at) const {
    const auto f = formula_->around(at, step_);
    const double square = step_ * step_;
    return {f[4],
            (f[5] - f[3]) / (2.0 * step_),
            (f[7] - f[1]) / (2.0 * step_),
            (f[5] - 2.0 * f[4] + f[3]) / square,
            (f[8] - f[2] - f[6] + f[0]) / (4.0 * square),
            (f[7] - 2.0 * f[4] + f[1]) / square};
  }

  /// The point r with f(r) = 0 and r + l grad f(r) = at: by steps down to the surface, and along it by Newton's method.
  [[nodiscard]] Point foot_of(const Point& at) const {
    Point foot = at;
    for (int n = 0; n < 30; ++n) {
      const Near near = look_at(foot);
      const double square = near.x * near.x + near.y * near.y;
      if (!(square > 0.0)) break;
      const double down = -near.value / square;
      const double way_x = at[0] - foot[0] - down * near.x;
      const double way_y = at[1] - foot[1] - down * near.y;
      const double l = (way_x * near.x + way_y * near.y) / square;
      // How fast the way turns along the surface, whose direction is (-f_y, f_x), against a straight one.
      const double bend =
          (near.xx * near.y * near.y - 2.0 * near.xy * near.x * near.y + near.yy * near.x * near.x) / square;
      const double turning = std::max(0.5, 1.0 + l * bend);
      double along_it = (way_y * near.x - way_x * near.y) / square / turning;
      const double longest = 0.5 * farthest_ / std::sqrt(square);
      along_it = std::clamp(along_it, -longest, longest);
      const double step_x = down * near.x - along_it * near.y;
      const double step_y = down * near.y + along_it * near.x;
      foot = {foot[0] + step_x, foot[1] + step_y, 0.0};
      if (std::hypot(step_x, step_y) < 1e-9 * farthest_) break;
    }
    return foot;
  }

  std::string text_;
  std::vector<double> centre_{0.0, 0.0};
  std::optional<Expression> formula_;
  double step_ = 0.0;      // of differences, m
  double farthest_ = 0.0;  // as far as a distance must be right, m
  std::vector<Point> surface_;
};

}  // namespace

MESOGEN_SHAPE_PLUGIN(ShapeByExpression, "expression", "1.0.0", "Shape by a formula that is below 0 inside of it")
