#include "defect_field.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/particles/periodic.hpp"
#include "mesogen/text/formatted.hpp"

namespace mesogen::director {

namespace {

constexpr double pi = std::numbers::pi;

[[noreturn]] void refuse(const std::string& what) { throw BadParameter("defects", what); }

/// The place of a defect, folded into the box along the periodic axes: a place beyond a face is the same as one inside.
std::array<double, 2> folded(const std::vector<double>& defect, std::size_t row, const Scene& scene,
                             const std::string& unit) {
  std::array<double, 2> place{};
  for (std::size_t axis = 0; axis < place.size(); ++axis) {
    double at = defect[axis];
    std::int32_t boxes = 0;
    if (scene.periodic[axis]) wrap_into_box(scene.box[axis], at, boxes);
    if (!(at >= 0.0 && at < scene.box[axis]))
      refuse(formatted("row %zu: must lie in the box, %s from 0 to %g %s, %s, but is at %g", row + 1,
                       axis == 0 ? "x" : "y", scene.box[axis], unit.c_str(),
                       scene.periodic[axis] ? "or within 1e9 boxes of it" : "where this axis ends at walls",
                       defect[axis]));
    place[axis] = at;
  }
  return place;
}

}  // namespace

DefectField::DefectField(const Parameter::Rows& rows, double core, const Scene& scene, const std::string& length_unit)
    : width_(scene.box[0]), height_(scene.box[1]), core_(core) {
  double sum = 0.0;
  double moment_x = 0.0;
  double moment_y = 0.0;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double charge = rows[row][2];
    if (std::abs(charge) != 0.5)
      refuse(formatted("row %zu: the charge must be 0.5 or -0.5, but is %g", row + 1, charge));
    const auto [x, y] = folded(rows[row], row, scene, length_unit);
    for (std::size_t other = 0; other < row; ++other)
      if (at_same_place(defects_[other], x, y))
        refuse(formatted("rows %zu and %zu are at the same place", other + 1, row + 1));
    defects_.push_back({x, y, charge});
    sum += charge;
    moment_x += charge * x;
    moment_y += charge * y;
  }
  if (sum != 0.0) refuse(formatted("the charges must add up to 0 in a periodic box, but their sum is %g", sum));
  // The mean slope of the periodic field is 2 pi (P_y, -P_x) / (Lx Ly); a half turn across the box changes it by
  // pi / Lx or pi / Ly.
  slope_x_ = -std::round(2.0 * moment_y / height_) * pi / width_;
  slope_y_ = (std::round(2.0 * moment_x / width_) - 2.0 * moment_x / width_) * pi / height_;
}

// Also from one face of the box to the other: the field is periodic.
bool DefectField::at_same_place(const Defect& defect, double x, double y) const {
  return std::abs(std::remainder(defect.x - x, width_)) <= 1e-9 * width_ &&
         std::abs(std::remainder(defect.y - y, height_)) <= 1e-9 * height_;
}

double DefectField::angle_around(double dx, double dy) const {
  const double a = pi * dx / width_;
  const double b = pi * dy / width_;
  double angle = std::atan2(std::cos(a) * std::tanh(b), std::sin(a));
  const double cos2a = std::cos(2.0 * a);
  const double sin2a = std::sin(2.0 * a);
  for (int m = 1;; ++m) {
    // cosh 2b / cosh 2c and sinh 2b / cosh 2c with exponents that cannot overflow
    const double c = m * pi * height_ / width_;
    const double near = std::exp(2.0 * (std::abs(b) - c));
    const double far = std::exp(-2.0 * (std::abs(b) + c));
    const double scale = 1.0 / (1.0 + std::exp(-4.0 * c));
    if (near < 1e-17) return angle;
    const double cosine = (near + far) * scale;
    const double sine = std::copysign((near - far) * scale, b);
    angle += std::atan2(sin2a * sine, 1.0 - cos2a * cosine);
  }
}

DirectorValue DefectField::at(double x, double y) const {
  DirectorValue value{1.0, slope_x_ * x + slope_y_ * y};
  for (const auto& defect : defects_) {
    const double dx = x - defect.x;
    const double dy = y - defect.y;
    value.angle += defect.charge * angle_around(dx, dy);
    const double r = std::hypot(std::remainder(dx, width_), std::remainder(dy, height_));
    value.order *= r / std::sqrt(r * r + 2.0 * core_ * core_);
  }
  return value;
}

}  // namespace mesogen::director
