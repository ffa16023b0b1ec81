#include "mesogen/nematics/director_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "mesogen/mesh/node_means.hpp"
#include "mesogen/neighbours/point_cells.hpp"

namespace mesogen::nematics {

namespace {

/// a + b s + c t + d s t, with which a function is interpolated between four corners.
struct Bilinear {
  double a, b, c, d;
  Bilinear(double f00, double f10, double f01, double f11)
      : a(f00), b(f10 - f00), c(f01 - f00), d(f11 - f10 - f01 + f00) {}
};

/// How far (s, t) lies outside the unit square.
double distance_outside(double s, double t) { return std::max({0.0, -s, s - 1.0, -t, t - 1.0}); }

/// How often the direction of Q passes that of negative Q11 on the short way from `a` to `b`, counterclockwise. The
/// turns along the edges of a plaquette add up to whole ones: to as many as are counted here.
int passages(const OrderTensor& a, const OrderTensor& b) {
  if ((a[1] >= 0.0) == (b[1] >= 0.0)) return 0;
  const double turn = a[0] * b[1] - a[1] * b[0];  // its sign is that of the short way
  if (a[1] >= 0.0) return turn > 0.0 ? 1 : 0;
  return turn < 0.0 ? -1 : 0;
}

bool is_finite(const OrderTensor& q) { return std::isfinite(q[0]) && std::isfinite(q[1]); }

}  // namespace

DirectorGrid::DirectorGrid(const ObserverContext& context, double smoothing_length) {
  const Scene& scene = context.scene();
  for (std::size_t d = 0; d < 2; ++d) {
    nodes_[d] = std::max(3, static_cast<int>(std::lround(scene.box[d] / scene.spacing)));
    width_[d] = scene.box[d] / nodes_[d];
    plaquettes_[d] = scene.periodic[d] ? nodes_[d] : nodes_[d] - 1;
    first_[d] = scene.periodic[d] ? 0.0 : 0.5 * width_[d];
  }
  sph::SmoothingKernel kernel = context.kernel();
  kernel.smoothing_length = smoothing_length * scene.spacing;
  kernel.scale = 1.0;  // the weights are divided by their sum
  const std::array position{context.position(0), context.position(1)};
  tensor_ = mesh::node_means(scene, {nodes_, width_, first_, nodes_in_solids(scene)},
                             {position, context.field("order_tensor")}, kernel);
}

// Nodes a little way in a solid keep a mean, so that plaquettes reach the surface: no defect before it is missed.
std::vector<char> DirectorGrid::nodes_in_solids(const Scene& scene) const {
  std::vector<char> inside;
  if (!scene.solids) return inside;
  inside.resize(static_cast<std::size_t>(nodes_[0]) * static_cast<std::size_t>(nodes_[1]));
  const double deep = 0.75 * scene.spacing;
#pragma omp parallel for schedule(static)
  for (int j = 0; j < nodes_[1]; ++j)
    for (int i = 0; i < nodes_[0]; ++i)
      inside[node(i, j)] =
          scene.depth_in_solid({first_[0] + i * width_[0], first_[1] + j * width_[1], 0.0}) > deep ? 1 : 0;
  return inside;
}

std::size_t DirectorGrid::node(int i, int j) const {
  const auto along = [this](int at, std::size_t d) {
    const bool goes_on = plaquettes_[d] == nodes_[d];
    return static_cast<std::size_t>(goes_on ? (at + nodes_[d]) % nodes_[d] : std::clamp(at, 0, nodes_[d] - 1));
  };
  return along(j, 1) * static_cast<std::size_t>(nodes_[0]) + along(i, 0);
}

std::vector<Defect> DirectorGrid::defects() const {
  std::vector<std::vector<Defect>> of_row(static_cast<std::size_t>(plaquettes_[1]));
#pragma omp parallel for schedule(static)
  for (int j = 0; j < plaquettes_[1]; ++j) of_row[static_cast<std::size_t>(j)] = defects_of_row(j);
  std::vector<Defect> found;
  for (const auto& some : of_row) found.insert(found.end(), some.begin(), some.end());
  return found;
}

std::vector<Defect> DirectorGrid::defects_of_row(int j) const {
  std::vector<Defect> found;
  const OrderTensor* const lower = &tensor_[node(0, j)];
  const OrderTensor* const upper = &tensor_[node(0, j + 1)];
  for (int i = 0; i < plaquettes_[0]; ++i) {
    const int next = i + 1 < nodes_[0] ? i + 1 : 0;
    const int turns = passages(lower[i], lower[next]) + passages(lower[next], upper[next]) -
                      passages(upper[i], upper[next]) - passages(lower[i], upper[i]);
    if (turns == 0) continue;
    if (!is_finite(lower[i]) || !is_finite(lower[next]) || !is_finite(upper[i]) || !is_finite(upper[next])) continue;
    // Two turns around one plaquette need four edges of exactly half a turn; then there are two defects in it.
    for (int k = 0; k < std::abs(turns); ++k) {
      Defect defect;
      defect.charge = turns > 0 ? 0.5 : -0.5;
      const auto [s, t] = zero(i, j);
      defect.position = {std::fmod(first_[0] + (i + s) * width_[0], nodes_[0] * width_[0]),
                         std::fmod(first_[1] + (j + t) * width_[1], nodes_[1] * width_[1])};
      defect.orientation = orientation(i, j, defect.charge);
      found.push_back(defect);
    }
  }
  return found;
}

std::array<double, 2> DirectorGrid::zero(int i, int j) const {
  const OrderTensor& q00 = tensor_[node(i, j)];
  const OrderTensor& q10 = tensor_[node(i + 1, j)];
  const OrderTensor& q01 = tensor_[node(i, j + 1)];
  const OrderTensor& q11 = tensor_[node(i + 1, j + 1)];
  const Bilinear f(q00[0], q10[0], q01[0], q11[0]);
  const Bilinear g(q00[1], q10[1], q01[1], q11[1]);
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
  OrderTensor by_x{};
  OrderTensor by_y{};
  for (int b = -1; b <= 1; ++b) {
    for (int a = -1; a <= 1; ++a) {
      const OrderTensor& q00 = tensor_[node(i + a, j + b)];
      const OrderTensor& q10 = tensor_[node(i + a + 1, j + b)];
      const OrderTensor& q01 = tensor_[node(i + a, j + b + 1)];
      const OrderTensor& q11 = tensor_[node(i + a + 1, j + b + 1)];
      if (!is_finite(q00) || !is_finite(q10) || !is_finite(q01) || !is_finite(q11)) continue;  // in a solid
      by_x[0] += (q10[0] + q11[0] - q00[0] - q01[0]) / width_[0];
      by_x[1] += (q10[1] + q11[1] - q00[1] - q01[1]) / width_[0];
      by_y[0] += (q01[0] + q11[0] - q00[0] - q10[0]) / width_[1];
      by_y[1] += (q01[1] + q11[1] - q00[1] - q10[1]) / width_[1];
    }
  }
  const double sign = charge > 0.0 ? 1.0 : -1.0;
  return charge / (1.0 - charge) * std::atan2(sign * by_x[1] - by_y[0], by_x[0] + sign * by_y[1]);
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
  std::vector<std::array<double, 2>> plus;
  std::vector<std::array<double, 2>> minus;
  for (const auto& defect : defects) (defect.charge > 0.0 ? plus : minus).push_back(defect.position);
  if (plus.empty() || minus.empty()) return std::numeric_limits<double>::quiet_NaN();
  double smallest = std::numeric_limits<double>::infinity();  // squared
  const double apart = std::sqrt(scene.box[0] * scene.box[1] / static_cast<double>(defects.size()));
  const PointCells<2> cells(scene, minus, apart);
  for (double radius = apart; std::isinf(smallest); radius *= 2.0)
    for (const auto& point : plus)
      cells.within(point, radius, [&](Index, const auto&, double square) { smallest = std::min(smallest, square); });
  return std::sqrt(smallest);
}

}  // namespace mesogen::nematics
