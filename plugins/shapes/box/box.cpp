// A rectangle that may be turned and have rounded corners.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/shape.hpp"

namespace {

using namespace mesogen;

class Box final : public Shape {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.numbers("centre", centre_).unit("m").sizes({2}).required().doc("coordinates of the centre");
    list.numbers("size", size_).unit("m").sizes({2}).above(0).required().doc("lengths of the edges");
    list.number("rotation", rotation_).unit("degree").doc("angle by which it is turned, counterclockwise");
    list.number("rounding", rounding_).unit("m").at_least(0).doc("radius of the corners");
  }

  void prepare(const Scene&) override {
    if (2.0 * rounding_ > std::min(size_[0], size_[1]))
      throw BadParameter("rounding", "is more than half of the shorter edge: take at most " +
                                         std::to_string(0.5 * std::min(size_[0], size_[1])));
    const double angle = rotation_ * std::numbers::pi / 180.0;
    cosine_ = std::cos(angle);
    sine_ = std::sin(angle);
  }

  // Of a smaller box with sharp corners, less the radius of the corners.
  [[nodiscard]] double distance(const Point& at) const override {
    const double x = at[0] - centre_[0];
    const double y = at[1] - centre_[1];
    const double beyond_x = std::abs(cosine_ * x + sine_ * y) - 0.5 * size_[0] + rounding_;
    const double beyond_y = std::abs(cosine_ * y - sine_ * x) - 0.5 * size_[1] + rounding_;
    const double outside = std::hypot(std::max(beyond_x, 0.0), std::max(beyond_y, 0.0));
    return outside + std::min(std::max(beyond_x, beyond_y), 0.0) - rounding_;
  }

  [[nodiscard]] Point centre() const override { return {centre_[0], centre_[1], 0.0}; }

 private:
  std::vector<double> centre_{0.0, 0.0};
  std::vector<double> size_{1.0, 1.0};
  double rotation_ = 0.0;
  double rounding_ = 0.0;
  double cosine_ = 1.0;
  double sine_ = 0.0;
};

}  // namespace

MESOGEN_SHAPE_PLUGIN(Box, "box", "1.0.0", "Rectangle, turned by an angle, with sharp or rounded corners")
