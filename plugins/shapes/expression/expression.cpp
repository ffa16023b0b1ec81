// A shape by a formula f that is below 0 inside of it and above 0 outside, such as x^2 / 4 + y^2 - 1. The formula need
// not be a distance: the nearest point of f = 0 is found by steps along the slope of f and along the surface.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
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
            "like a distance: \"x^2 / 4 + y^2 - 1\"");
    list.numbers("centre", centre_)
        .unit("m")
        .sizes({2})
        .doc("the point around which it turns; by default that of the box");
  }

  void prepare(const Scene& scene) override {
    try {
      formula_.emplace(text_, scene);
    } catch (const Error& error) {
      throw BadParameter("distance", "\"" + text_ + "\": " + error.what());
    }
    check_finite(scene);
    if (centre_.empty()) centre_ = {0.5 * scene.box[0], 0.5 * scene.box[1]};
    step_ = 1e-4 * scene.spacing;
    farthest_ = scene.support;
    check_slope(scene);
  }

  [[nodiscard]] double distance(const Point& at) const override {
    const double value = (*formula_)(at);
    if (!std::isfinite(value)) return value;
    const double sign = value < 0.0 ? -1.0 : 1.0;
    const Point slope = slope_at(at);
    const double steepness = std::hypot(slope[0], slope[1]);
    const double guess = std::abs(value) / steepness;
    // Far away, or where the formula is flat, the sign is enough.
    if (!(guess < 4.0 * farthest_)) return sign * std::max(2.0 * farthest_, std::isfinite(guess) ? guess : 0.0);
    Point foot = at;
    for (int n = 0; n < 30; ++n)
      if (approach(at, foot) < 1e-9 * farthest_) break;
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

  // Where the sign changes from one point to the next, the surface must be near.
  void check_slope(const Scene& scene) const {
    const double apart = std::hypot(scene.box[0], scene.box[1]) / along;
    for (int j = 0; j <= along; ++j)
      for (int i = 0; i < along; ++i) {
        const Point at = point_of(scene, i, j);
        if (((*formula_)(at) < 0.0) == ((*formula_)(point_of(scene, i + 1, j)) < 0.0)) continue;
        if (std::abs(distance(at)) > 2.0 * apart)
          throw BadParameter("distance", formatted("\"%s\" must rise through 0 with a slope, but jumps or is flat near "
                                                   "(%g, %g): write a formula that grows with the distance",
                                                   text_.c_str(), at[0], at[1]));
      }
  }

  [[nodiscard]] Point slope_at(const Point& at) const {
    Point slope{};
    for (std::size_t d = 0; d < 2; ++d) {
      Point there = at;
      there[d] = at[d] + step_;
      slope[d] = (*formula_)(there);
      there[d] = at[d] - step_;
      slope[d] = (slope[d] - (*formula_)(there)) / (2.0 * step_);
    }
    return slope;
  }

  /// Brings a point nearer to the foot of `at` on the surface; returns how far it went.
  double approach(const Point& at, Point& foot) const {
    const Point before = foot;
    const Point slope = slope_at(foot);
    const double square = slope[0] * slope[0] + slope[1] * slope[1];
    if (!(square > 0.0)) return 0.0;
    const double down = (*formula_)(foot) / square;
    for (std::size_t d = 0; d < 2; ++d) foot[d] -= down * slope[d];
    // Along the surface towards `at`; half of the way, as the surface may be bent as much as that is far.
    const double across = ((at[0] - foot[0]) * slope[0] + (at[1] - foot[1]) * slope[1]) / square;
    for (std::size_t d = 0; d < 2; ++d) foot[d] += 0.5 * (at[d] - foot[d] - across * slope[d]);
    return std::hypot(foot[0] - before[0], foot[1] - before[1]);
  }

  std::string text_;
  std::vector<double> centre_;
  std::optional<Expression> formula_;
  double step_ = 0.0;      // of differences, m
  double farthest_ = 0.0;  // as far as a distance must be right, m
};

}  // namespace

MESOGEN_SHAPE_PLUGIN(ShapeByExpression, "expression", "1.0.0", "Shape by a formula that is below 0 inside of it")
