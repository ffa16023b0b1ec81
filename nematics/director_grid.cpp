#include "mesogen/nematics/director_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "mesogen/neighbours/point_cells.hpp"
#include "mesogen/plugin/by_id.hpp"
#include "mesogen/sph/kernel_function.hpp"

namespace mesogen::nematics {

namespace {

constexpr double pi = std::numbers::pi;

/// a + b s + c t + d s t, with which a function is interpolated between four corners.
struct Bilinear {
  double a, b, c, d;
  Bilinear(double f00, double f10, double f01, double f11)
      : a(f00), b(f10 - f00), c(f01 - f00), d(f11 - f10 - f01 + f00) {}
};

/// How far (s, t) lies outside the unit square.
double distance_outside(double s, double t) { return std::max({0.0, -s, s - 1.0, -t, t - 1.0}); }

/// Mean of the values around a place. Where no particle is near, it looks for some farther out, with a wider kernel.
template <class Kernel>
OrderTensor mean_around(const std::array<double, 2>& place, const PointCells<2>& cells, const Kernel& kernel,
                        double radius, const std::vector<OrderTensor>& values) {
  double weights = 0.0;
  OrderTensor sum;
  for (double widening = 1.0; weights <= 0.0 && !values.empty(); widening *= 2.0) {
    cells.within(place, widening * radius, [&](Index j, const auto&, double square) {
      const double weight = kernel.value(std::sqrt(square) / widening);
      const OrderTensor& value = values[static_cast<std::size_t>(j)];
      weights += weight;
      sum.q11 += weight * value.q11;
      sum.q12 += weight * value.q12;
    });
  }
  return {sum.q11 / weights, sum.q12 / weights};
}

std::vector<OrderTensor> order_tensors(const ObserverContext& context) {
  const ById particles(context);
  const auto q11 = particles.values("order_tensor", 0);
  const auto q12 = particles.values("order_tensor", 1);
  std::vector<OrderTensor> tensors(particles.count());
  for (std::size_t i = 0; i < tensors.size(); ++i) tensors[i] = {q11[i], q12[i]};
  return tensors;
}

sph::SmoothingKernel averaging(const ObserverContext& context, double smoothing_length) {
  sph::SmoothingKernel kernel = context.kernel();
  kernel.smoothing_length = smoothing_length * context.scene().spacing;
  kernel.scale = 1.0;  // the weights are divided by their sum
  return kernel;
}

}  // namespace

DirectorGrid::DirectorGrid(const Scene& scene, const std::vector<std::array<double, 2>>& points,
                           const std::vector<OrderTensor>& values, const sph::SmoothingKernel& kernel) {
  for (std::size_t d = 0; d < 2; ++d) {
    nodes_[d] = std::max(3, static_cast<int>(std::lround(scene.box[d] / scene.spacing)));
    width_[d] = scene.box[d] / nodes_[d];
    plaquettes_[d] = scene.periodic[d] ? nodes_[d] : nodes_[d] - 1;
    first_[d] = scene.periodic[d] ? 0.0 : 0.5 * width_[d];
  }
  tensor_.resize(static_cast<std::size_t>(nodes_[0]) * static_cast<std::size_t>(nodes_[1]));
  const PointCells<2> cells(scene, points, kernel.radius() / 3.0);
  sph::with_kernel_function<double>(kernel, [&](const auto& function) {
#pragma omp parallel for schedule(static)
    for (int j = 0; j < nodes_[1]; ++j) {
      for (int i = 0; i < nodes_[0]; ++i)
        tensor_[node(i, j)] = mean_around({first_[0] + i * width_[0], first_[1] + j * width_[1]}, cells, function,
                                          kernel.radius(), values);
    }
  });
}

DirectorGrid::DirectorGrid(const ObserverContext& context, double smoothing_length)
    : DirectorGrid(context.scene(), ById(context).positions<2>(), order_tensors(context),
                   averaging(context, smoothing_length)) {}

std::size_t DirectorGrid::node(int i, int j) const {
  const auto along = [this](int at, std::size_t d) {
    const bool goes_on = plaquettes_[d] == nodes_[d];
    return static_cast<std::size_t>(goes_on ? (at + nodes_[d]) % nodes_[d] : std::clamp(at, 0, nodes_[d] - 1));
  };
  return along(j, 1) * static_cast<std::size_t>(nodes_[0]) + along(i, 0);
}

std::vector<Defect> DirectorGrid::defects() const {
  std::vector<double> phase(tensor_.size());  // twice the director's angle
  for (std::size_t n = 0; n < tensor_.size(); ++n) phase[n] = std::atan2(tensor_[n].q12, tensor_[n].q11);
  const auto turn = [&](std::size_t from, std::size_t to) {
    const double change = phase[to] - phase[from];
    return change - 2.0 * pi * std::round(change / (2.0 * pi));
  };
  std::vector<double> turn_x(tensor_.size());
  std::vector<double> turn_y(tensor_.size());
  for (int j = 0; j < nodes_[1]; ++j) {
    for (int i = 0; i < nodes_[0]; ++i) {
      turn_x[node(i, j)] = turn(node(i, j), node(i + 1, j));
      turn_y[node(i, j)] = turn(node(i, j), node(i, j + 1));
    }
  }
  std::vector<Defect> found;
  for (int j = 0; j < plaquettes_[1]; ++j) {
    for (int i = 0; i < plaquettes_[0]; ++i) {
      const double total = turn_x[node(i, j)] + turn_y[node(i + 1, j)] - turn_x[node(i, j + 1)] - turn_y[node(i, j)];
      const long turns = std::isfinite(total) ? std::lround(total / (2.0 * pi)) : 0;
      // Two turns around one plaquette need four edges of exactly half a turn; then there are two defects in it.
      for (long k = 0; k < std::labs(turns); ++k) {
        Defect defect;
        defect.charge = turns > 0 ? 0.5 : -0.5;
        const auto [s, t] = zero(i, j);
        defect.position = {std::fmod(first_[0] + (i + s) * width_[0], nodes_[0] * width_[0]),
                           std::fmod(first_[1] + (j + t) * width_[1], nodes_[1] * width_[1])};
        defect.orientation = orientation(i, j, defect.charge);
        found.push_back(defect);
      }
    }
  }
  return found;
}

std::array<double, 2> DirectorGrid::zero(int i, int j) const {
  const OrderTensor& q00 = tensor_[node(i, j)];
  const OrderTensor& q10 = tensor_[node(i + 1, j)];
  const OrderTensor& q01 = tensor_[node(i, j + 1)];
  const OrderTensor& q11 = tensor_[node(i + 1, j + 1)];
  const Bilinear f(q00.q11, q10.q11, q01.q11, q11.q11);
  const Bilinear g(q00.q12, q10.q12, q01.q12, q11.q12);
  // s = -(f.a + f.c t) / (f.b + f.d t) put into g = 0 leaves a quadratic equation for t.
  const double square = f.c * g.d - g.c * f.d;
  const double linear = f.a * g.d + f.c * g.b - g.a * f.d - g.c * f.b;
  const double constant = f.a * g.b - g.a * f.b;
  const double root = std::sqrt(std::max(0.0, linear * linear - 4.0 * square * constant));
  const double half = -0.5 * (linear + std::copysign(root, linear));
  std::array<double, 2> best{0.5, 0.5};
  double best_distance = 1.0;  // rounding may put the zero a little outside; the centre stands for anything worse
  for (const double t : {half / square, constant / half}) {
    const double f_slope = f.b + f.d * t;
    const double g_slope = g.b + g.d * t;
    const double s = std::abs(f_slope) > std::abs(g_slope) ? -(f.a + f.c * t) / f_slope : -(g.a + g.c * t) / g_slope;
    if (!std::isfinite(s) || !std::isfinite(t)) continue;
    const double distance = distance_outside(s, t);
    if (distance < best_distance) {
      best = {std::clamp(s, 0.0, 1.0), std::clamp(t, 0.0, 1.0)};
      best_distance = distance;
    }
  }
  return best;
}

double DirectorGrid::orientation(int i, int j, double charge) const {
  OrderTensor by_x;
  OrderTensor by_y;
  for (int b = -1; b <= 1; ++b) {
    for (int a = -1; a <= 1; ++a) {
      const OrderTensor& q00 = tensor_[node(i + a, j + b)];
      const OrderTensor& q10 = tensor_[node(i + a + 1, j + b)];
      const OrderTensor& q01 = tensor_[node(i + a, j + b + 1)];
      const OrderTensor& q11 = tensor_[node(i + a + 1, j + b + 1)];
      by_x.q11 += (q10.q11 + q11.q11 - q00.q11 - q01.q11) / width_[0];
      by_x.q12 += (q10.q12 + q11.q12 - q00.q12 - q01.q12) / width_[0];
      by_y.q11 += (q01.q11 + q11.q11 - q00.q11 - q10.q11) / width_[1];
      by_y.q12 += (q01.q12 + q11.q12 - q00.q12 - q10.q12) / width_[1];
    }
  }
  const double sign = charge > 0.0 ? 1.0 : -1.0;
  return charge / (1.0 - charge) * std::atan2(sign * by_x.q12 - by_y.q11, by_x.q11 + sign * by_y.q12);
}

std::vector<Defect> without_close_pairs(const std::vector<Defect>& defects, const Scene& scene, double distance) {
  std::vector<std::array<double, 2>> points;
  points.reserve(defects.size());
  for (const auto& defect : defects) points.push_back(defect.position);
  const PointCells<2> cells(scene, points, distance);
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;  // distance squared, +1/2, -1/2
  for (std::size_t i = 0; i < defects.size(); ++i) {
    if (defects[i].charge < 0.0) continue;
    cells.within(points[i], distance, [&](Index j, const auto&, double square) {
      if (defects[static_cast<std::size_t>(j)].charge < 0.0) pairs.emplace_back(square, i, static_cast<std::size_t>(j));
    });
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> gone(defects.size(), false);
  for (const auto& [square, plus, minus] : pairs) {
    if (gone[plus] || gone[minus]) continue;
    gone[plus] = gone[minus] = true;
  }
  std::vector<Defect> kept;
  for (std::size_t i = 0; i < defects.size(); ++i) {
    if (!gone[i]) kept.push_back(defects[i]);
  }
  return kept;
}

double pair_distance(const std::vector<Defect>& defects, const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();  // squared
  for (const auto& plus : defects) {
    if (plus.charge < 0.0) continue;
    for (const auto& minus : defects) {
      if (minus.charge > 0.0) continue;
      double square = 0.0;
      for (std::size_t d = 0; d < 2; ++d) {
        const double along = plus.position[d] - minus.position[d];
        square += std::pow(scene.periodic[d] ? std::remainder(along, scene.box[d]) : along, 2);
      }
      smallest = std::min(smallest, square);
    }
  }
  return std::isfinite(smallest) ? std::sqrt(smallest) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace mesogen::nematics
