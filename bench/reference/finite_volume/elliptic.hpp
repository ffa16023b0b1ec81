// Solves (shift - scale lap) x = b on a periodic square of cells: for pressure (shift 0) and implicit diffusion.
#pragma once

#include <fftw3.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

namespace finite_volume {

/// Numbers of n x n cells, i and j from 1 to n, with one layer of copies around them that stands for the periodic box.
class Field {
 public:
  Field() = default;
  explicit Field(int n) : n_(n), values_(static_cast<std::size_t>(n + 2) * static_cast<std::size_t>(n + 2), 0.0) {}

  int size() const { return n_; }
  double* row(int j) { return values_.data() + static_cast<std::ptrdiff_t>(j) * (n_ + 2); }
  const double* row(int j) const { return values_.data() + static_cast<std::ptrdiff_t>(j) * (n_ + 2); }
  double& operator()(int i, int j) { return row(j)[i]; }
  double operator()(int i, int j) const { return row(j)[i]; }

  /// Renews the layer of copies.
  void wrap() {
    for (int j = 1; j <= n_; ++j) {
      row(j)[0] = row(j)[n_];
      row(j)[n_ + 1] = row(j)[1];
    }
    for (int i = 0; i <= n_ + 1; ++i) {
      row(0)[i] = row(n_)[i];
      row(n_ + 1)[i] = row(1)[i];
    }
  }

 private:
  int n_ = 0;
  std::vector<double> values_;
};

/// Sum over all cells of f(i, j), row by row.
template <typename F>
double sum(int n, F&& f) {
  double total = 0.0;
  for (int j = 1; j <= n; ++j) {
    double line = 0.0;
    for (int i = 1; i <= n; ++i) line += f(i, j);
    total += line;
  }
  return total;
}

class EllipticSolver {
 public:
  EllipticSolver() = default;
  EllipticSolver(const EllipticSolver&) = delete;
  EllipticSolver& operator=(const EllipticSolver&) = delete;
  virtual ~EllipticSolver() = default;

  /// (shift - scale lap) x = b with the Laplacian of five cells. x holds a guess before and wraps after; with shift 0
  /// the mean of b must be 0. Returns the cycles it took.
  virtual int solve(double shift, double scale, const Field& b, Field& x) = 0;
};

/// Geometric multigrid: V cycles with red-black Gauss-Seidel before and after, means of four cells on the way down,
/// bilinear interpolation on the way up (U. Trottenberg, C. Oosterlee, A. Schuller, Multigrid (2001), ch. 2).
class Multigrid : public EllipticSolver {
 public:
  /// cells: across, of edge h (m). tolerance: of the residual, over the right side, as root mean squares.
  Multigrid(int cells, double h, double tolerance) : tolerance_(tolerance) {
    for (int n = cells;; n /= 2, h *= 2.0) {
      levels_.push_back({h, Field(n), Field(n), Field(n)});
      if (n % 2 != 0 || n <= 3) break;
    }
  }

  /// Cells across the coarsest grid, where relaxation alone must do.
  int coarsest() const { return levels_.back().x.size(); }

  int solve(double shift, double scale, const Field& b, Field& x) override {
    Level& finest = levels_.front();
    std::swap(finest.x, x);
    finest.b = b;
    finest.x.wrap();
    const int n = b.size();
    const double enough = tolerance_ * tolerance_ * sum(n, [&](int i, int j) { return b(i, j) * b(i, j); });
    int cycles = 0;
    // Rounding ends what no cycle can better: 30 are some 30 decimals.
    while (residual(shift, scale, finest) > enough && cycles < 30) {
      cycle(shift, scale, 0);
      ++cycles;
    }
    std::swap(finest.x, x);
    return cycles;
  }

 private:
  struct Level {
    double h;
    Field x, b, rest;
  };

  static void relax(double shift, double scale, Level& level) {
    const int n = level.x.size();
    const double side = scale / (level.h * level.h), inverse = 1.0 / (shift + 4.0 * side);
    for (int colour = 0; colour < 2; ++colour) {
      for (int j = 1; j <= n; ++j) {
        const double *below = level.x.row(j - 1), *above = level.x.row(j + 1), *b = level.b.row(j);
        double* x = level.x.row(j);
        for (int i = 1 + (j + colour) % 2; i <= n; i += 2) {
          x[i] = (b[i] + side * ((x[i - 1] + x[i + 1]) + (below[i] + above[i]))) * inverse;
        }
      }
      level.x.wrap();
    }
  }

  /// Leaves b - (shift - scale lap) x in level.rest; returns the sum of its squares.
  static double residual(double shift, double scale, Level& level) {
    const int n = level.x.size();
    const double side = scale / (level.h * level.h), middle = shift + 4.0 * side;
    double total = 0.0;
    for (int j = 1; j <= n; ++j) {
      const double *below = level.x.row(j - 1), *above = level.x.row(j + 1), *x = level.x.row(j), *b = level.b.row(j);
      double *rest = level.rest.row(j), line = 0.0;
      for (int i = 1; i <= n; ++i) {
        rest[i] = b[i] - middle * x[i] + side * ((x[i - 1] + x[i + 1]) + (below[i] + above[i]));
        line += rest[i] * rest[i];
      }
      total += line;
    }
    return total;
  }

  /// One V cycle from this level down; the residual is up to date.
  void cycle(double shift, double scale, std::size_t depth) {
    Level& fine = levels_[depth];
    const int n = fine.x.size();
    const bool local = 8.0 * scale < shift * fine.h * fine.h;  // diffusion within a cell: relaxation alone is quick
    if (local || depth + 1 == levels_.size()) {
      for (int sweep = 0; sweep < (local ? 2 : 2 * n); ++sweep) relax(shift, scale, fine);
      return;
    }
    relax(shift, scale, fine);
    residual(shift, scale, fine);
    Level& coarse = levels_[depth + 1];
    const int half = n / 2;
    for (int j = 1; j <= half; ++j) {
      const double *low = fine.rest.row(2 * j - 1), *high = fine.rest.row(2 * j);
      for (int i = 1; i <= half; ++i) {
        const int right = 2 * i, left = right - 1;
        coarse.b(i, j) = 0.25 * (low[left] + low[right] + high[left] + high[right]);
        coarse.x(i, j) = 0.0;
      }
    }
    coarse.x.wrap();
    cycle(shift, scale, depth + 1);
    for (int j = 1; j <= n; ++j) {
      const double* near = coarse.x.row((j + 1) / 2);
      const double* far = coarse.x.row(j % 2 == 0 ? j / 2 + 1 : (j - 1) / 2);
      double* x = fine.x.row(j);
      for (int i = 1; i <= half; ++i) {
        const double middle = 3.0 * near[i] + far[i];
        const int right = 2 * i, left = right - 1;
        x[left] += (3.0 * middle + 3.0 * near[i - 1] + far[i - 1]) / 16.0;
        x[right] += (3.0 * middle + 3.0 * near[i + 1] + far[i + 1]) / 16.0;
      }
    }
    fine.x.wrap();
    relax(shift, scale, fine);
  }

  std::vector<Level> levels_;
  double tolerance_;
};

/// The same equations, exactly, by fast Fourier transforms: only a periodic box of even cells allows it.
class Fourier : public EllipticSolver {
 public:
  Fourier(int cells, double h)
      : n_(cells), half_(cells / 2 + 1), values_(real(n_ * n_)), spectrum_(real(2 * half_ * n_)) {
    auto* modes = reinterpret_cast<fftw_complex*>(spectrum_.get());
    forward_.reset(fftw_plan_dft_r2c_2d(n_, n_, values_.get(), modes, FFTW_MEASURE));
    backward_.reset(fftw_plan_dft_c2r_2d(n_, n_, modes, values_.get(), FFTW_MEASURE));
    for (int k = 0; k < n_; ++k) square_.push_back((2.0 - 2.0 * std::cos(2.0 * std::numbers::pi * k / n_)) / (h * h));
  }

  int solve(double shift, double scale, const Field& b, Field& x) override {
    for (int j = 0; j < n_; ++j) {
      for (int i = 0; i < n_; ++i) values_[index(j, n_) + i] = b(i + 1, j + 1);
    }
    fftw_execute(forward_.get());
    for (int ky = 0; ky < n_; ++ky) {
      double* line = spectrum_.get() + 2 * index(ky, half_);
      for (int kx = 0; kx < half_; ++kx) {
        const double symbol = shift + scale * (square_[index(kx, 1)] + square_[index(ky, 1)]);
        const double factor = symbol > 0.0 ? 1.0 / (symbol * n_ * n_) : 0.0;
        const int real_part = 2 * kx;
        line[real_part] *= factor;
        line[real_part + 1] *= factor;
      }
    }
    fftw_execute(backward_.get());
    for (int j = 0; j < n_; ++j) {
      for (int i = 0; i < n_; ++i) x(i + 1, j + 1) = values_[index(j, n_) + i];
    }
    x.wrap();
    return 1;
  }

 private:
  struct Free {
    void operator()(double* memory) const { fftw_free(memory); }
    void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
  };
  using Memory = std::unique_ptr<double[], Free>;
  using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, Free>;

  static std::ptrdiff_t index(int line, int width) { return static_cast<std::ptrdiff_t>(line) * width; }
  static Memory real(int count) { return Memory(fftw_alloc_real(static_cast<std::size_t>(count))); }

  int n_, half_;
  Memory values_, spectrum_;
  Plan forward_, backward_;
  std::vector<double> square_;  // -lap of each wave along an axis, 1/m^2
};

}  // namespace finite_volume
