#include "mesogen/mesh/fourier_transform.hpp"

#include <fftw3.h>

#include <algorithm>
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

/// FFTW in one precision.
template <class Real>
struct Fftw;

template <>
struct Fftw<double> {
  using Number = fftw_complex;
  using Plan = fftw_plan;
  static constexpr auto plan_row = fftw_plan_dft_1d;
  static constexpr auto plan_columns = fftw_plan_many_dft;
  static constexpr auto execute = fftw_execute_dft;
  static constexpr auto destroy = fftw_destroy_plan;
};

template <>
struct Fftw<float> {
  using Number = fftwf_complex;
  using Plan = fftwf_plan;
  static constexpr auto plan_row = fftwf_plan_dft_1d;
  static constexpr auto plan_columns = fftwf_plan_many_dft;
  static constexpr auto execute = fftwf_execute_dft;
  static constexpr auto destroy = fftwf_destroy_plan;
};

// Columns that are transformed together: one cache line of complex numbers in single precision, two in double.
constexpr int together = 8;

template <class Real>
typename Fftw<Real>::Number* raw(ComplexNumber<Real>* modes) {
  return reinterpret_cast<typename Fftw<Real>::Number*>(modes);
}

/// Transforms along an axis beyond the first.
template <class Real>
struct ColumnPlans {
  int count = 0;       // points along the axis
  int rows_apart = 0;  // rows from one of them to the next: so many bundles of columns lie side by side
  typename Fftw<Real>::Plan full[2] = {nullptr, nullptr};
  typename Fftw<Real>::Plan rest[2] = {nullptr, nullptr};
};

}  // namespace

template <class Real>
struct FourierTransform<Real>::Plans {
  using Fft = Fftw<Real>;
  using Number = ComplexNumber<Real>;

  int points;  // in a row
  int rows;
  int kept;
  typename Fft::Plan row[2] = {nullptr, nullptr};
  std::vector<ColumnPlans<Real>> axes;  // the second, the third

  ~Plans() {
    for (int direction : {0, 1}) {
      Fft::destroy(row[direction]);
      for (const auto& axis : axes)
        for (const auto plan : {axis.full[direction], axis.rest[direction]})
          if (plan != nullptr) Fft::destroy(plan);
    }
  }

  /// Two rows of complex numbers, to transform one into the other.
  [[nodiscard]] FieldsOnGrid<Real> line() const { return FieldsOnGrid<Real>(Grid<1>{{2 * points}, {1.0}}, 2); }

  // Two rows of real numbers are transformed as one of complex numbers, a + i b. Of its transform Z, that of a is the
  // part with A(-k) = conj A(k), and i times that of b the other. In FFTW this is twice as fast as transforms of real
  // rows.
  void forward(const Real* a, const Real* b, FieldsOnGrid<Real>& line, Number* of_a, Number* of_b) const {
    Real* const from = line.row(0, 0);
    for (int x = 0; x < points; ++x) {
      from[2 * x] = a[x];
      from[2 * x + 1] = b[x];
    }
    const Number* const z = line.modes(1, 0);
    Fft::execute(row[0], raw(line.modes(0, 0)), raw(line.modes(1, 0)));
    const Real half = Real(0.5) / (Real(points) * Real(rows));
    for (int n = 0; n < kept; ++n) {
      const Number here = z[n];
      const Number there = z[n == 0 ? 0 : points - n];
      of_a[n] = {half * (here.real() + there.real()), half * (here.imag() - there.imag())};
      of_b[n] = {half * (here.imag() + there.imag()), half * (there.real() - here.real())};
    }
  }
  void backward(const Number* of_a, const Number* of_b, FieldsOnGrid<Real>& line, Real* a, Real* b) const {
    Number* const z = line.modes(0, 0);
    for (int n = 1; n < kept; ++n) {
      z[n] = {of_a[n].real() - of_b[n].imag(), of_a[n].imag() + of_b[n].real()};
      z[points - n] = {of_a[n].real() + of_b[n].imag(), of_b[n].real() - of_a[n].imag()};
    }
    std::fill(z + kept, z + std::max(kept, points - kept + 1), Number(0));
    // These are their own conjugates.
    z[0] = {of_a[0].real(), of_b[0].real()};
    if (2 * (kept - 1) == points) z[kept - 1] = {of_a[kept - 1].real(), of_b[kept - 1].real()};
    Fft::execute(row[1], raw(z), raw(line.modes(1, 0)));
    const Real* const to = line.row(1, 0);
    for (int x = 0; x < points; ++x) {
      a[x] = to[2 * x];
      b[x] = to[2 * x + 1];
    }
  }

  void transform_columns(const ColumnPlans<Real>& axis, int direction, FieldsOnGrid<Real>& modes, int fields) const {
    const int groups = (kept + together - 1) / together;
    const int bundles = rows / axis.count;
#pragma omp parallel for collapse(3) schedule(static) if (fields * rows * kept >= parallel_threshold)
    for (int field = 0; field < fields; ++field) {
      for (int b = 0; b < bundles; ++b) {
        for (int g = 0; g < groups; ++g) {
          const int first_row = b / axis.rows_apart * axis.rows_apart * axis.count + b % axis.rows_apart;
          auto* const from = raw(modes.modes(field, first_row) + g * together);
          const bool whole = (g + 1) * together <= kept;
          Fft::execute(whole ? axis.full[direction] : axis.rest[direction], from, from);
        }
      }
    }
  }
};

// Plans are estimated, not measured: what is measured differs from run to run, and the rounding with it. All lines that
// a plan is used for are aligned as those that it is made with.
template <class Real>
FourierTransform<Real>::FourierTransform(std::array<int, 3> points, int dimension, int kept, FieldsOnGrid<Real> room)
    : plans_(std::make_unique<Plans>()) {
  Plans& plans = *plans_;
  plans.points = points[0];
  plans.rows = points[1] * points[2];
  plans.kept = kept;
  const auto stride = static_cast<int>(room.row_stride() / 2);
  auto* const modes = raw(room.modes(0, 0));
  auto line = plans.line();
  for (const int direction : {0, 1})
    plans.row[direction] = Fftw<Real>::plan_row(points[0], raw(line.modes(0, 0)), raw(line.modes(1, 0)),
                                                direction == 0 ? FFTW_FORWARD : FFTW_BACKWARD, FFTW_ESTIMATE);
  int rows_apart = 1;
  for (int d = 1; d < dimension; ++d) {
    ColumnPlans<Real> axis;
    axis.count = points[d];
    axis.rows_apart = rows_apart;
    const auto plan = [&](int many, int sign) -> typename Fftw<Real>::Plan {
      if (many == 0) return nullptr;
      const int apart = rows_apart * stride;
      return Fftw<Real>::plan_columns(1, &axis.count, many, modes, nullptr, apart, 1, modes, nullptr, apart, 1, sign,
                                      FFTW_ESTIMATE);
    };
    for (const int direction : {0, 1}) {
      const int sign = direction == 0 ? FFTW_FORWARD : FFTW_BACKWARD;
      axis.full[direction] = plan(kept >= together ? together : 0, sign);
      axis.rest[direction] = plan(kept % together, sign);
    }
    plans.axes.push_back(axis);
    rows_apart *= points[d];
  }
}

template <class Real>
FourierTransform<Real>::~FourierTransform() = default;

template <class Real>
void FourierTransform<Real>::forward(const FieldsOnGrid<Real>& values, FieldsOnGrid<Real>& modes, int fields) {
  const Plans& plans = *plans_;
#pragma omp parallel if (fields * plans.rows * plans.points >= parallel_threshold)
  {
    auto line = plans.line();
#pragma omp for collapse(2) schedule(static)
    for (int field = 0; field < fields; ++field) {
      for (int row = 0; row < plans.rows; row += 2) {
        const int next = std::min(row + 1, plans.rows - 1);
        plans.forward(values.row(field, row), values.row(field, next), line, modes.modes(field, row),
                      modes.modes(field, next));
      }
    }
  }
  for (const auto& axis : plans.axes) plans.transform_columns(axis, 0, modes, fields);
}

template <class Real>
void FourierTransform<Real>::backward(FieldsOnGrid<Real>& modes, FieldsOnGrid<Real>& values, int fields) {
  const Plans& plans = *plans_;
  for (auto axis = plans.axes.rbegin(); axis != plans.axes.rend(); ++axis)
    plans.transform_columns(*axis, 1, modes, fields);
#pragma omp parallel if (fields * plans.rows * plans.points >= parallel_threshold)
  {
    auto line = plans.line();
#pragma omp for collapse(2) schedule(static)
    for (int field = 0; field < fields; ++field) {
      for (int row = 0; row < plans.rows; row += 2) {
        const int next = std::min(row + 1, plans.rows - 1);
        plans.backward(modes.modes(field, row), modes.modes(field, next), line, values.row(field, row),
                       values.row(field, next));
      }
    }
  }
}

template class FourierTransform<float>;
template class FourierTransform<double>;

}  // namespace mesogen::mesh
