#include <cmath>
#include <vector>

#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/shape.hpp"

namespace {

/// A ring: all points whose distance from a circle is at most half of its width.
class TemplateNamePlugin final : public mesogen::Shape {
 public:
  static constexpr mesogen::DimensionSet dimensions{2};

  void parameters(mesogen::ParameterList& list) override {
    list.numbers("centre", centre_).unit("m").sizes({2}).doc("centre of the ring");
    list.number("radius", radius_).unit("m").above(0).doc("radius of the circle in its middle");
    list.number("width", width_).unit("m").above(0).doc("width of the ring");
  }

  // Below 0 inside the shape, above 0 outside.
  [[nodiscard]] double distance(const Point& at) const override {
    const double from_centre = std::hypot(at[0] - centre_[0], at[1] - centre_[1]);
    return std::abs(from_centre - radius_) - 0.5 * width_;
  }

  [[nodiscard]] Point centre() const override { return {centre_[0], centre_[1], 0.0}; }

 private:
  std::vector<double> centre_{0.5, 0.5};
  double radius_ = 0.3;
  double width_ = 0.2;
};

}  // namespace

MESOGEN_SHAPE_PLUGIN(TemplateNamePlugin, "template_name", "1.0.0", "Ring of a width about a circle")
