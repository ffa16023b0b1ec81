#include "mesogen/mesh/fourier_transform.hpp"

#include <fftw3.h>

#include <cmath>
#include <vector>

namespace mesogen::mesh {

int fast_size(double wanted) {
  const auto is_fast = [](int n) {
    for (const int factor : {2, 3, 5})
      while (n % factor == 0) n /= factor;
    return n == 1;
  };
  int best = 8;
  for (int n = 8; n < 2.0 * wanted + 8.0; n += 2)
    if (is_fast(n) && std::abs(n - wanted) < std::abs(best - wanted)) best = n;
  return best;
}

namespace {

// Columns that are transformed together: a cache line's worth of complex numbers, and as many again.
constexpr int columns = 8;

fftw_complex* raw(Complex* modes) { return reinterpret_cast<fftw_complex*>(modes); }

/// Transforms along an axis beyond the first, whose points lie `stride` apart.
struct ColumnPlans {
  int count = 0;   // points along the axis
  int stride = 0;  // modes between two of them: so many columns lie side by side
  int outer = 0;   // how often such a bundle of columns comes
  fftw_plan full[2] = {nullptr, nullptr};
  fftw_plan rest[2] = {nullptr, nullptr};

  void execute(int direction, Complex* modes) const {
    const int groups = (stride + columns - 1) / columns;
    const std::ptrdiff_t bundle = static_cast<std::ptrdiff_t>(count) * stride;
#pragma omp parallel for collapse(2) schedule(static) if (outer * bundle >= parallel_threshold)
    for (int o = 0; o < outer; ++o) {
      for (int g = 0; g < groups; ++g) {
        Complex* const from = modes + o * bundle + static_cast<std::ptrdiff_t>(g) * columns;
        const bool whole = (g + 1) * columns <= stride;
        fftw_execute_dft(whole ? full[direction] : rest[direction], raw(from), raw(from));
      }
    }
  }
};

}  // namespace

struct FourierTransform::Plans {
  std::array<int, 3> points;
  int modes_in_row;
  int rows;
  fftw_plan row_forward = nullptr;
  fftw_plan row_backward = nullptr;
  std::vector<ColumnPlans> axes;  // the second, the third

  ~Plans() {
    for (fftw_plan plan : {row_forward, row_backward}) fftw_destroy_plan(plan);
    for (const ColumnPlans& axis : axes)
      for (int direction : {0, 1})
        for (fftw_plan plan : {axis.full[direction], axis.rest[direction]})
          if (plan != nullptr) fftw_destroy_plan(plan);
  }
};

// Plans are estimated, not measured: what is measured differs from run to run, and the rounding with it. They are made
// for any alignment, since lines begin anywhere.
FourierTransform::FourierTransform(std::array<int, 3> points, int dimension) : plans_(std::make_unique<Plans>()) {
  constexpr unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
  Plans& plans = *plans_;
  plans.points = points;
  plans.modes_in_row = points[0] / 2 + 1;
  plans.rows = points[1] * points[2];
  const std::size_t modes = static_cast<std::size_t>(plans.modes_in_row) * static_cast<std::size_t>(plans.rows);
  std::vector<double> values(static_cast<std::size_t>(points[0]));
  std::vector<Complex> scratch(modes);
  plans.row_forward = fftw_plan_dft_r2c_1d(points[0], values.data(), raw(scratch.data()), flags);
  plans.row_backward = fftw_plan_dft_c2r_1d(points[0], raw(scratch.data()), values.data(), flags);
  int stride = plans.modes_in_row;
  for (int d = 1; d < dimension; ++d) {
    ColumnPlans axis;
    axis.count = points[d];
    axis.stride = stride;
    axis.outer = static_cast<int>(modes / static_cast<std::size_t>(stride * points[d]));
    const auto plan = [&](int many, int sign) -> fftw_plan {
      if (many == 0) return nullptr;
      return fftw_plan_many_dft(1, &axis.count, many, raw(scratch.data()), nullptr, stride, 1, raw(scratch.data()),
                                nullptr, stride, 1, sign, flags);
    };
    for (const int direction : {0, 1}) {
      const int sign = direction == 0 ? FFTW_FORWARD : FFTW_BACKWARD;
      axis.full[direction] = plan(stride >= columns ? columns : 0, sign);
      axis.rest[direction] = plan(stride % columns, sign);
    }
    plans.axes.push_back(axis);
    stride *= points[d];
  }
}

FourierTransform::~FourierTransform() = default;

void FourierTransform::forward(const double* values, Complex* modes) {
  const Plans& plans = *plans_;
  const double scale = 1.0 / (static_cast<double>(plans.points[0]) * plans.rows);
#pragma omp parallel for schedule(static) if (plans.rows * plans.modes_in_row >= parallel_threshold)
  for (int row = 0; row < plans.rows; ++row) {
    Complex* const to = modes + static_cast<std::ptrdiff_t>(row) * plans.modes_in_row;
    // FFTW leaves what it reads as it is when a transform goes elsewhere, as this one does.
    fftw_execute_dft_r2c(plans.row_forward,
                         const_cast<double*>(values) + static_cast<std::ptrdiff_t>(row) * plans.points[0], raw(to));
    for (int n = 0; n < plans.modes_in_row; ++n) to[n] *= scale;
  }
  for (const ColumnPlans& axis : plans.axes) axis.execute(0, modes);
}

void FourierTransform::backward(Complex* modes, double* values) {
  const Plans& plans = *plans_;
  for (auto axis = plans.axes.rbegin(); axis != plans.axes.rend(); ++axis) axis->execute(1, modes);
#pragma omp parallel for schedule(static) if (plans.rows * plans.modes_in_row >= parallel_threshold)
  for (int row = 0; row < plans.rows; ++row)
    fftw_execute_dft_c2r(plans.row_backward, raw(modes + static_cast<std::ptrdiff_t>(row) * plans.modes_in_row),
                         values + static_cast<std::ptrdiff_t>(row) * plans.points[0]);
}

}  // namespace mesogen::mesh
