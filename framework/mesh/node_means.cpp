#include "mesogen/mesh/node_means.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesogen/exec/counting_sort.hpp"
#include "mesogen/neighbours/point_cells.hpp"
#include "mesogen/sph/kernel_function.hpp"

namespace mesogen::mesh {

namespace {

using Pack = exec::Pack<double>;
constexpr auto lanes = static_cast<int>(Pack::size());

using Values = std::array<double, 2>;

/// The nodes of a row, and as many beyond its ends as particles reach.
struct RowOfNodes {
  int count;
  double spacing;
  double reach;  // of a particle, m
  int beyond;    // nodes beyond each end
  double first;  // coordinate of the first of all, m

  RowOfNodes(const Nodes& nodes, double radius)
      : count(nodes.count[0]),
        spacing(nodes.spacing[0]),
        reach(radius),
        beyond(static_cast<int>(radius / spacing) + 2),
        first(nodes.first[0] - beyond * spacing) {}

  /// The first node that a particle reaches.
  [[nodiscard]] int first_node(double x) const { return static_cast<int>((x - reach - first) / spacing); }
  /// How many packs of nodes it reaches at most.
  [[nodiscard]] int packs() const { return (static_cast<int>(2.0 * reach / spacing) + 2 + lanes - 1) / lanes; }
};

struct Carried {
  double y;
  int node;      // the first that it reaches
  double along;  // from there to the particle, m
  double value[2];
};

/// Particles sorted by the band of the box, as high as a row of nodes, in which they are.
class Bands {
 public:
  Bands(const Carriers& particles, int count, double height, const RowOfNodes& row) : count_(count), height_(height) {
    const auto& x = particles.position[0];
    const auto& y = particles.position[1];
    sorted_.resize(y.size());
    begin_ = exec::counting_sort(
        static_cast<Index>(y.size()), static_cast<std::size_t>(count),
        [&](Index i) {
          const double band = y[static_cast<std::size_t>(i)] / height;
          return band > 0.0 ? static_cast<int>(std::min(band, count - 1.0)) : 0;
        },
        [&](Index i, Index to) {
          const auto n = static_cast<std::size_t>(i);
          const int node = row.first_node(x[n]);
          sorted_[static_cast<std::size_t>(to)] = {
              y[n], node, x[n] - (row.first + node * row.spacing), {particles.field(0, i), particles.field(1, i)}};
        });
  }

  /// Calls visit(particle, distance along y from `y` to it) for all in the bands within `reach`.
  template <class Visit>
  void around(double y, double reach, bool periodic, const Visit& visit) const {
    const auto last = static_cast<int>(std::floor((y + reach) / height_));
    for (auto band = static_cast<int>(std::floor((y - reach) / height_)); band <= last; ++band) {
      const int image = (band >= 0 ? band : band - count_ + 1) / count_;
      if (image != 0 && !periodic) continue;
      const auto at = static_cast<std::size_t>(band - image * count_);
      const double origin = y - image * count_ * height_;
      for (auto n = static_cast<std::size_t>(begin_[at]); n < static_cast<std::size_t>(begin_[at + 1]); ++n)
        visit(sorted_[n], sorted_[n].y - origin);
    }
  }

 private:
  int count_;
  double height_;
  std::vector<Carried> sorted_;
  std::vector<Index> begin_;  // of each band
};

/// Weighted sums at the nodes of one row.
class Sums {
 public:
  explicit Sums(const RowOfNodes& row) : count_(row.count), beyond_(row.beyond), packs_(row.packs()) {
    for (auto& sum : sum_) sum.resize(static_cast<std::size_t>(count_ + 2 * beyond_ + packs_ * lanes));
    for (int lane = 0; lane < lanes; ++lane) lane_[lane] = lane * row.spacing;
    pack_length_ = lanes * row.spacing;
  }

  void clear() {
    for (auto& sum : sum_) std::fill(sum.begin(), sum.end(), 0.0);
  }

  /// A particle at the distance `across` from the row. Weights are zero at nodes that it does not reach.
  template <class Kernel>
  void add(const Carried& particle, double across, const Kernel& kernel) {
    const Pack square(std::max(across * across, 1e-200));  // above 0: a root is found through its inverse
    for (int n = 0; n < packs_; ++n) {
      const Pack along = lane_ + (n * pack_length_ - particle.along);
      const Pack weight = kernel.value(exec::find_root(Pack(along * along + square)));
      const int i = particle.node + n * lanes;
      accumulate(sum_[0], i, weight);
      accumulate(sum_[1], i, weight * particle.value[0]);
      accumulate(sum_[2], i, weight * particle.value[1]);
    }
  }

  /// Means at all nodes; 0 / 0 where no particle is near. In a periodic row the nodes beyond an end are those at the
  /// other.
  void means(bool periodic, Values* to) {
    for (auto& sum : sum_) {
      if (!periodic) continue;
      for (int i = 0; i < beyond_; ++i) {
        const int before = (i - beyond_ % count_ + count_) % count_;
        sum[static_cast<std::size_t>(beyond_ + before)] += sum[static_cast<std::size_t>(i)];
        sum[static_cast<std::size_t>(beyond_ + i % count_)] += sum[static_cast<std::size_t>(beyond_ + count_ + i)];
      }
    }
    for (int i = 0; i < count_; ++i) {
      const auto at = static_cast<std::size_t>(beyond_ + i);
      to[i] = {sum_[1][at] / sum_[0][at], sum_[2][at] / sum_[0][at]};
    }
  }

 private:
  static void accumulate(std::vector<double>& sum, int i, const Pack& what) {
    double* const to = sum.data() + i;
    Pack there;
    exec::load(to, there);
    exec::store(there + what, to);
  }

  int count_;
  int beyond_;
  int packs_;
  double pack_length_;                      // m
  Pack lane_;                               // distance of the lanes from the first, m
  std::array<std::vector<double>, 3> sum_;  // of weights, and of weights times either value
};

template <class Kernel>
Values mean_around(const std::array<double, 2>& place, const PointCells<2>& cells, const Kernel& kernel, double radius,
                   const FieldReader& field) {
  double weights = 0.0;
  Values sum{};
  for (double widening = 1.0;; widening *= 2.0) {
    cells.within(place, widening * radius, [&](Index j, const auto&, double square) {
      const double weight = kernel.value(std::sqrt(square) / widening);
      weights += weight;
      for (std::size_t c = 0; c < 2; ++c) sum[c] += weight * field(static_cast<int>(c), j);
    });
    if (!(weights <= 0.0)) return {sum[0] / weights, sum[1] / weights};
  }
}

bool is_left_out(const Nodes& nodes, std::size_t n) { return !nodes.left_out.empty() && nodes.left_out[n] != 0; }

template <class Kernel>
void look_farther(const Scene& scene, const Nodes& nodes, const Carriers& particles, const Kernel& kernel,
                  double radius, std::vector<Values>& means) {
  const auto& [x, y] = particles.position;
  if (x.empty()) return;
  std::vector<std::array<double, 2>> points(x.size());
  for (std::size_t n = 0; n < points.size(); ++n) points[n] = {x[n], y[n]};
  const PointCells<2> cells(scene, points, radius / 3.0);
  const auto count = static_cast<Index>(means.size());
#pragma omp parallel for schedule(static)
  for (Index n = 0; n < count; ++n) {
    Values& mean = means[static_cast<std::size_t>(n)];
    if (!std::isnan(mean[0]) || is_left_out(nodes, static_cast<std::size_t>(n))) continue;
    const std::array place{nodes.first[0] + n % nodes.count[0] * nodes.spacing[0],
                           nodes.first[1] + n / nodes.count[0] * nodes.spacing[1]};
    mean = mean_around(place, cells, kernel, radius, particles.field);
  }
}

bool add_up(const Scene& scene, const Nodes& nodes, const Carriers& particles, const sph::SmoothingKernel& kernel,
            std::vector<Values>& means) {
  const auto columns = static_cast<std::size_t>(nodes.count[0]);
  const double radius = kernel.radius();
  const RowOfNodes row(nodes, radius);
  const Bands bands(particles, nodes.count[1], nodes.spacing[1], row);
  bool unknown = false;
  sph::with_kernel_function<double>(kernel, [&](const auto& function) {
#pragma omp parallel reduction(|| : unknown)
    {
      Sums sums(row);
#pragma omp for schedule(static)
      for (int j = 0; j < nodes.count[1]; ++j) {
        sums.clear();
        bands.around(nodes.first[1] + j * nodes.spacing[1], radius, scene.periodic[1],
                     [&](const Carried& particle, double across) {
                       if (across * across <= radius * radius) sums.add(particle, across, function);
                     });
        Values* const here = &means[static_cast<std::size_t>(j) * columns];
        sums.means(scene.periodic[0], here);
        unknown = unknown || std::any_of(here, here + columns, [](const Values& mean) { return std::isnan(mean[0]); });
      }
    }
  });
  return unknown;
}

}  // namespace

std::vector<Values> node_means(const Scene& scene, const Nodes& nodes, const Carriers& particles,
                               const sph::SmoothingKernel& kernel) {
  std::vector<Values> means(static_cast<std::size_t>(nodes.count[0]) * static_cast<std::size_t>(nodes.count[1]));
  const bool unknown = add_up(scene, nodes, particles, kernel, means);
  if (unknown)
    sph::with_kernel_function<double>(
        kernel, [&](const auto& function) { look_farther(scene, nodes, particles, function, kernel.radius(), means); });
  for (std::size_t n = 0; n < means.size(); ++n)
    if (is_left_out(nodes, n)) means[n].fill(std::numeric_limits<double>::quiet_NaN());
  return means;
}

}  // namespace mesogen::mesh
