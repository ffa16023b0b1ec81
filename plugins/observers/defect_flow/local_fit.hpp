#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mesogen/neighbours/point_cells.hpp"

namespace mesogen {

/// Fields at any point, from their values at particles: there, a linear function is fitted to the values around by
/// least squares, weighted with a kernel (moving least squares, Lancaster & Salkauskas, Math. Comp. 37, 141, 1981).
/// Exact for linear fields however the particles lie, also beside a wall; second order in the spacing for others.
template <std::size_t Fields>
class LocalFit {
 public:
  using Point = std::array<double, 2>;
  using Values = std::array<double, Fields>;

  /// `values`: at each of the points. `radius`: of the kernel, m.
  LocalFit(const Scene& scene, const std::vector<Point>& points, std::vector<Values> values, double radius)
      : cells_(scene, points, radius / 3.0), values_(std::move(values)), radius_(radius) {}

  /// `weight.value(r)`: the kernel. Where no particle is near, particles farther out count, with a wider kernel.
  template <class Kernel>
  [[nodiscard]] Values at(const Point& place, const Kernel& weight) const {
    Moments moments;
    for (double widening = 1.0; moments.total <= 0.0 && !values_.empty(); widening *= 2.0) {
      cells_.within(place, widening * radius_, [&](Index j, const Point& r, double square) {
        moments.add(weight.value(std::sqrt(square) / widening), r, values_[static_cast<std::size_t>(j)]);
      });
    }
    return moments.at_centre();
  }

 private:
  /// Weighted sums over the particles around a point: of 1, r, r r, f and f r, with r as seen from it.
  struct Moments {
    double total = 0.0;
    double x = 0.0, y = 0.0;
    double xx = 0.0, xy = 0.0, yy = 0.0;
    Values f{}, fx{}, fy{};

    void add(double weight, const Point& r, const Values& value) {
      total += weight;
      x += weight * r[0];
      y += weight * r[1];
      xx += weight * r[0] * r[0];
      xy += weight * r[0] * r[1];
      yy += weight * r[1] * r[1];
      for (std::size_t n = 0; n < Fields; ++n) {
        f[n] += weight * value[n];
        fx[n] += weight * value[n] * r[0];
        fy[n] += weight * value[n] * r[1];
      }
    }

    /// What the fitted function is at r = 0. Where the particles lie on a line, or one alone, their mean.
    [[nodiscard]] Values at_centre() const {
      constexpr double flat = 1e-3;
      const double mx = x / total;
      const double my = y / total;
      const double cxx = xx / total - mx * mx;
      const double cxy = xy / total - mx * my;
      const double cyy = yy / total - my * my;
      const double determinant = cxx * cyy - cxy * cxy;
      const bool has_slope = determinant > flat * std::pow(0.5 * (cxx + cyy), 2);
      Values fitted{};
      for (std::size_t n = 0; n < Fields; ++n) {
        fitted[n] = f[n] / total;
        if (!has_slope) continue;
        const double gx = fx[n] / total - mx * f[n] / total;
        const double gy = fy[n] / total - my * f[n] / total;
        fitted[n] -= (mx * (cyy * gx - cxy * gy) + my * (cxx * gy - cxy * gx)) / determinant;
      }
      return fitted;
    }
  };

  PointCells<2> cells_;
  std::vector<Values> values_;
  double radius_;
};

}  // namespace mesogen
