#include "domain/wall_values.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

#include "mesogen/exec/first_failure.hpp"

namespace mesogen {

namespace {

// Below this ratio of pivots the particles around a point do not span a linear function.
constexpr double degenerate = 1e-8;

template <int Dim>
using Vector = Eigen::Matrix<double, Dim + 1, 1>;
template <int Dim>
using Matrix = Eigen::Matrix<double, Dim + 1, Dim + 1>;

/// A particle near a mirror point.
template <int Dim>
struct Seen {
  Index particle;
  Vector<Dim> basis;  // 1, and the way to the particle in smoothing lengths
  double kernel;
};

/// Coefficients a so that sum_j (a . basis_j) W_j f_j is the value at the point, exact for linear f.
template <int Dim>
Vector<Dim> coefficients(const Matrix<Dim>& moment) {
  const Eigen::LDLT<Matrix<Dim>> factored(moment);
  if (factored.vectorD().minCoeff() > degenerate * factored.vectorD().maxCoeff())
    return factored.solve(Vector<Dim>::Unit(0));
  Vector<Dim> mean = Vector<Dim>::Zero();
  if (moment(0, 0) > 0.0) mean[0] = 1.0 / moment(0, 0);
  return mean;
}

/// All particles, no dummies, that the kernel reaches from a point.
template <class Real, int Dim, class Function>
void look_from(const std::array<double, 3>& point, const CellGrid& grid, const Neighbours<Real, Dim>& neighbours,
               const Function& function, double length, std::vector<Seen<Dim>>& seen) {
  const CellGrid::Cell cell = grid.nearest_inside(point);
  int centre[Dim];
  for (int d = 0; d < Dim; ++d) centre[d] = cell[d];
  Segment<Real, Dim> segment[Neighbours<Real, Dim>::most_segments];
  const int segments = neighbours.segments(centre, segment);
  const double farthest = static_cast<double>(neighbours.radius) / length;
  seen.clear();
  for (int s = 0; s < segments; ++s) {
    if (segment[s].begin >= neighbours.particle_count) continue;
    for (Index j = segment[s].begin; j < segment[s].end; ++j) {
      Seen<Dim> one{j, Vector<Dim>::Unit(0), 0.0};
      for (int d = 0; d < Dim; ++d) {
        const double origin = grid.tile_origin(d, cell[d]) + static_cast<double>(segment[s].offset[d]);
        one.basis[d + 1] = (static_cast<double>(neighbours.local[d][j]) + origin - point[d]) / length;
      }
      const double square = one.basis.template tail<Dim>().squaredNorm();
      if (square >= farthest * farthest) continue;
      one.kernel = function.value(length * std::sqrt(square));
      if (one.kernel > 0.0) seen.push_back(one);
    }
  }
}

}  // namespace

void WallValues::refresh(const Neighbourhood& neighbourhood, const Scene& scene, const sph::SmoothingKernel& kernel,
                         const Boundary& boundary, Field& field) {
  const Dummies& dummies = neighbourhood.dummies();
  const bool single = scene.precision == Precision::single_precision;
  if (sorted_version_ != neighbourhood.sorted_version()) extension_.clear();
  if (version_ != neighbourhood.version()) {
    if (scene.dimension == 2) {
      single ? find_weights<float, 2>(neighbourhood, kernel) : find_weights<double, 2>(neighbourhood, kernel);
    } else {
      single ? find_weights<float, 3>(neighbourhood, kernel) : find_weights<double, 3>(neighbourhood, kernel);
    }
    version_ = neighbourhood.version();
    sorted_version_ = neighbourhood.sorted_version();
  }
  const int components = field.components();
  auto [at, is_new] = extension_.try_emplace(field.name());
  if (is_new) {
    at->second.resize(dummies.position.size() * static_cast<std::size_t>(components));
    boundary.extend(scene, field.name(), components, dummies, at->second);
  }
  if (single) {
    apply(at->second, field.view<float>(), components, scene.particle_count);
  } else {
    apply(at->second, field.view<double>(), components, scene.particle_count);
  }
}

template <class Real, int Dim>
void WallValues::find_weights(const Neighbourhood& neighbourhood, const sph::SmoothingKernel& kernel) {
  const auto& mirrors = neighbourhood.dummies().mirror;
  Neighbours<Real, Dim> neighbours{};
  neighbourhood.fill(neighbours);
  const auto count = static_cast<std::ptrdiff_t>(mirrors.size());
  weights_.resize(mirrors.size());
  exec::FirstFailure failure;
  sph::with_kernel_function<double>(kernel, [&](const auto& function) {
#pragma omp parallel
    {
      std::vector<Seen<Dim>> seen;
#pragma omp for schedule(static)
      for (std::ptrdiff_t n = 0; n < count; ++n) {
        try {
          look_from(mirrors[static_cast<std::size_t>(n)], neighbourhood.grid(), neighbours, function,
                    kernel.smoothing_length, seen);
          Matrix<Dim> moment = Matrix<Dim>::Zero();
          for (const Seen<Dim>& one : seen) moment += one.kernel * one.basis * one.basis.transpose();
          const Vector<Dim> coefficient = coefficients<Dim>(moment);
          auto& weights = weights_[static_cast<std::size_t>(n)];
          weights.clear();
          for (const Seen<Dim>& one : seen) weights.push_back({one.particle, one.kernel * coefficient.dot(one.basis)});
        } catch (...) {
          failure.keep();
        }
      }
    }
  });
  failure.rethrow();
}

template <class Real>
void WallValues::apply(const std::vector<Extension>& extension, FieldView<Real> field, int components,
                       Index count) const {
  const auto dummies = static_cast<Index>(weights_.size());
#pragma omp parallel for schedule(static)
  for (Index n = 0; n < dummies; ++n)
    for (int c = 0; c < components; ++c) {
      double value = 0.0;
      for (const Weight& weight : weights_[static_cast<std::size_t>(n)])
        value += weight.value * static_cast<double>(field(c, weight.particle));
      const Extension& rule = extension[static_cast<std::size_t>(n * components + c)];
      field(c, count + n) = static_cast<Real>(rule.factor * value + rule.summand);
    }
}

}  // namespace mesogen
