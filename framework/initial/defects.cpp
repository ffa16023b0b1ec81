#include "initial/defects.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "mesogen/domain/periodic.hpp"

namespace mesogen {

namespace {
constexpr double pi = std::numbers::pi;
}

std::string fold_defects(Case& source, const std::array<bool, 3>& periodic) {
  auto& rows = source.director.defects;
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double given = rows[row][axis];
      const double size = source.domain.size[axis];
      std::int32_t boxes = 0;
      if (periodic[axis]) wrap_into_box(size, rows[row][axis], boxes);
      if (rows[row][axis] >= 0.0 && rows[row][axis] < size) continue;
      return fmt::format("row {}: must lie in the box, {} from 0 to {} {}, {}, but is at {}", row + 1,
                         axis == 0 ? "x" : "y", size, source.units.length,
                         periodic[axis] ? "or within 1e9 boxes of it" : "where this axis ends at walls", given);
    }
  return {};
}

DefectField::DefectField(const Case& source)
    : width_(source.domain.size[0]), height_(source.domain.size[1]), core_(source.director.core) {
  double moment_x = 0.0;
  double moment_y = 0.0;
  for (const auto& row : source.director.defects) {
    defects_.push_back({row[0], row[1], row[2]});
    moment_x += row[2] * row[0];
    moment_y += row[2] * row[1];
  }
  // The mean slope of the periodic field is 2 pi (P_y, -P_x) / (Lx Ly); a half turn across the box changes it by
  // pi / Lx or pi / Ly.
  slope_x_ = -std::round(2.0 * moment_y / height_) * pi / width_;
  slope_y_ = (std::round(2.0 * moment_x / width_) - 2.0 * moment_x / width_) * pi / height_;
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

}  // namespace mesogen
