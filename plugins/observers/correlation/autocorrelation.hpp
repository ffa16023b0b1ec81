#pragma once

// Autocorrelation of a periodic field from the squares of its Fourier modes (Wiener and Khinchin).

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mesogen/mesh/grid.hpp"

namespace mesogen::correlation {

/// C(r) = <f(x) f(x + r)> / <f^2> of a field without its mean, over all x of the box:
///
///     C(r) = sum_k |f_k|^2 exp(i k r) / sum_k |f_k|^2,   k != 0.
///
/// Along an axis that is a sum over the wave numbers along it, of what all modes of one wave number hold; over all
/// directions of r, exp(i k r) becomes J0(|k| r) in two dimensions and sin(|k| r) / (|k| r) in three. So both are known
/// at any r without error, but for that of the modes.
template <int Dim>
class Autocorrelation {
 public:
  /// `power`: |f_k|^2 of each stored mode, summed over components; all 0: nothing is correlated, and C is NaN.
  Autocorrelation(const mesh::Grid<Dim>& grid, const std::vector<double>& power) {
    for (std::size_t d = 0; d < Dim; ++d) {
      base_[d] = grid.wave_number(static_cast<int>(d), 1);
      along_[d].assign(static_cast<std::size_t>(grid.points[d]) / 2 + 1, 0.0);
    }
    std::vector<Ring> all;
    std::size_t mode = 0;
    for (int row = 0; row < grid.row_count(); ++row) {
      std::array<int, Dim> at{};
      grid.row_coordinates(row, at);
      for (at[0] = 0; at[0] < grid.modes_in_row(); ++at[0], ++mode) {
        if (mode == 0 || power[mode] == 0.0) continue;
        // Of a mode and its mirror image only one is stored, but along the plane between the two.
        const double share = (at[0] == 0 || 2 * at[0] == grid.points[0] ? 1.0 : 2.0) * power[mode];
        double square = 0.0;
        for (std::size_t d = 0; d < Dim; ++d) {
          const int waves = std::min(at[d], grid.points[d] - at[d]);
          along_[d][static_cast<std::size_t>(waves)] += share;
          square += std::pow(waves * base_[d], 2);
        }
        all.emplace_back(std::sqrt(square), share);
        total_ += share;
      }
    }
    gather(all);
  }

  /// Mean over the axes of C(r e) with e along each.
  [[nodiscard]] double along_axes(double r) const {
    double sum = 0.0;
    for (std::size_t d = 0; d < Dim; ++d)
      for (std::size_t n = 0; n < along_[d].size(); ++n)
        sum += along_[d][n] * std::cos(static_cast<double>(n) * base_[d] * r);
    return sum / (Dim * total_);
  }

  /// Mean square of what the modes hold, without the mean.
  [[nodiscard]] double mean_square() const { return total_; }

  /// Mean over all directions of r.
  [[nodiscard]] double radial(double r) const {
    double sum = 0.0;
    for (const auto& [k, share] : rings_) sum += share * mean_wave(k * r);
    return sum / total_;
  }

 private:
  using Ring = std::pair<double, double>;  // a length of the wave vector, 1/m, and what its modes hold

  // exp(i k r) over all directions. POSIX's j0, since that of the standard library takes a time that grows with x.
  static double mean_wave(double x) {
    if constexpr (Dim == 2) return ::j0(x);
    return x == 0.0 ? 1.0 : std::sin(x) / x;
  }

  // Modes of one length as one: several times fewer in a square box. Their lengths differ by rounding.
  void gather(std::vector<Ring>& all) {
    std::stable_sort(all.begin(), all.end(), [](const Ring& a, const Ring& b) { return a.first < b.first; });
    for (const Ring& ring : all) {
      if (rings_.empty() || ring.first > rings_.back().first * (1.0 + 1e-12)) {
        rings_.push_back(ring);
      } else {
        rings_.back().second += ring.second;
      }
    }
  }

  std::array<double, Dim> base_{};                // smallest wave number along each axis, 1/m
  std::array<std::vector<double>, Dim> along_{};  // by the number of waves along an axis
  std::vector<Ring> rings_;
  double total_ = 0.0;
};

/// Where C first comes down to `level`: looked for in the table of its values at 0, step, 2 step, ..., then found to
/// rounding. NaN where it does not.
template <class Function>
double first_crossing(const Function& c, const std::vector<double>& table, double step, double level) {
  for (std::size_t n = 1; n < table.size(); ++n) {
    if (!(table[n - 1] > level && table[n] <= level)) continue;
    double above = static_cast<double>(n - 1) * step;
    double below = static_cast<double>(n) * step;
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (above + below);
      (c(middle) > level ? above : below) = middle;
    }
    return below;
  }
  return std::nan("");
}

}  // namespace mesogen::correlation
