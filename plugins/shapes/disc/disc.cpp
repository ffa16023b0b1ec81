// A disc; in three dimensions a ball.

#include <cmath>
#include <vector>

#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/shape.hpp"

namespace {

using namespace mesogen;

class Disc final : public Shape {
 public:
  void parameters(ParameterList& list) override {
    const std::vector<int> built = built_dimensions.list();
    list.numbers("centre", centre_)
        .unit("m")
        .sizes({built.begin(), built.end()})
        .required()
        .doc("coordinates of the centre");
    list.number("radius", radius_).unit("m").above(0).required().doc("radius");
  }

  [[nodiscard]] double distance(const Point& at) const override {
    const Point centre = this->centre();
    return std::hypot(at[0] - centre[0], at[1] - centre[1], at[2] - centre[2]) - radius_;
  }

  [[nodiscard]] Point centre() const override {
    return {centre_[0], centre_[1], centre_.size() > 2 ? centre_[2] : 0.0};
  }

 private:
  std::vector<double> centre_{0.0, 0.0};
  double radius_ = 1.0;
};

}  // namespace

MESOGEN_SHAPE_PLUGIN(Disc, "disc", "1.0.0", "Disc of a radius about a centre")
