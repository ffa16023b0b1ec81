// The triangle of Reuleaux: what three discs have in common, each with its centre on the rim of both others. Its width
// is the same in every direction.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/shape.hpp"

namespace {

using namespace mesogen;

class Reuleaux final : public Shape {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.numbers("centre", centre_).unit("m").sizes({2}).required().doc("coordinates of the centre");
    list.number("width", width_).unit("m").above(0).required().doc("width in every direction");
  }

  // Inside several shapes at once is who is inside of all: the largest distance counts. Near a corner, outside, it is
  // too small: the framework goes from surface to surface there, as where solids overlap.
  [[nodiscard]] double distance(const Point& at) const override {
    const double to_corner = width_ / std::numbers::sqrt3;
    double largest = -width_;
    for (int corner = 0; corner < 3; ++corner) {
      const double angle = std::numbers::pi * (0.5 + corner / 1.5);
      const double x = at[0] - centre_[0] - to_corner * std::cos(angle);
      const double y = at[1] - centre_[1] - to_corner * std::sin(angle);
      largest = std::max(largest, std::hypot(x, y) - width_);
    }
    return largest;
  }

  [[nodiscard]] Point centre() const override { return {centre_[0], centre_[1], 0.0}; }

 private:
  std::vector<double> centre_{0.0, 0.0};
  double width_ = 1.0;
};

}  // namespace

MESOGEN_SHAPE_PLUGIN(Reuleaux, "reuleaux", "1.0.0", "Triangle of Reuleaux, of the same width in every direction")
