// All points within a radius of a line between two points: a rod with round ends, a racetrack.

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/shape.hpp"

namespace {

using namespace mesogen;

class Capsule final : public Shape {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.numbers("from", from_).unit("m").sizes({2}).required().doc("centre of one round end");
    list.numbers("to", to_).unit("m").sizes({2}).required().doc("centre of the other");
    list.number("radius", radius_).unit("m").above(0).required().doc("radius of the ends: half the width");
  }

  [[nodiscard]] double distance(const Point& at) const override {
    const double along_x = to_[0] - from_[0];
    const double along_y = to_[1] - from_[1];
    const double square = along_x * along_x + along_y * along_y;
    const double x = at[0] - from_[0];
    const double y = at[1] - from_[1];
    const double share = square > 0.0 ? std::clamp((x * along_x + y * along_y) / square, 0.0, 1.0) : 0.0;
    return std::hypot(x - share * along_x, y - share * along_y) - radius_;
  }

  [[nodiscard]] Point centre() const override { return {0.5 * (from_[0] + to_[0]), 0.5 * (from_[1] + to_[1]), 0.0}; }

 private:
  std::vector<double> from_{0.0, 0.0};
  std::vector<double> to_{1.0, 0.0};
  double radius_ = 1.0;
};

}  // namespace

MESOGEN_SHAPE_PLUGIN(Capsule, "capsule", "1.0.0", "All points within a radius of a line: a rod with round ends")
