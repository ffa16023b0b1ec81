/// Paths of a few particles, and how far each has travelled.
///
/// `path` is where a particle is, without jumps at the faces of the box; `distance` is the length of its way there, one
/// straight piece a step.
#include <algorithm>
#include <cmath>
#include <optional>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "mesogen/exec/random.hpp"
#include "mesogen/neighbours/point_cells.hpp"
#include "mesogen/plugin/by_id.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/places.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace mesogen {
namespace {

/// The particles nearest to points that cover the box evenly: those of a Kronecker sequence, x_k = frac(1/2 + k alpha),
/// with alpha_d = g^-(d+1) and g^(Dim+1) = g + 1, the generalised golden ratio (Roberts 2018). The first points are the
/// same for any number.
template <int Dim>
std::vector<std::int64_t> evenly_chosen(std::size_t count, const Scene& scene,
                                        const std::vector<std::array<double, Dim>>& points) {
  double golden = 1.5;
  for (int n = 0; n < 100; ++n) golden = std::pow(1.0 + golden, 1.0 / (Dim + 1));
  const PointCells<Dim> cells(scene, points, scene.spacing);
  std::vector<bool> taken(points.size(), false);
  std::vector<std::int64_t> chosen;
  while (chosen.size() < count) {
    std::array<double, Dim> target{};
    for (int d = 0; d < Dim; ++d) {
      const double x = 0.5 + static_cast<double>(chosen.size()) * std::pow(golden, -(d + 1));
      target[static_cast<std::size_t>(d)] = (x - std::floor(x)) * scene.box[static_cast<std::size_t>(d)];
    }
    std::optional<std::pair<double, Index>> nearest;
    for (double radius = scene.spacing; !nearest; radius *= 2.0) {
      cells.within(target, radius, [&](Index i, const auto&, double square) {
        if (taken[static_cast<std::size_t>(i)]) return;
        const std::pair candidate(square, i);
        if (!nearest || candidate < *nearest) nearest = candidate;
      });
    }
    taken[static_cast<std::size_t>(nearest->second)] = true;
    chosen.push_back(nearest->second);
  }
  return chosen;
}

/// `count` different particles, each set as likely as any other; the same for the same seed.
std::vector<std::int64_t> randomly_chosen(std::size_t count, std::int64_t seed, std::size_t particles) {
  constexpr std::int64_t stream = 0x70617468;  // "path": numbers that nobody else draws
  std::vector<std::pair<std::uint64_t, std::int64_t>> lots(particles);
  for (std::size_t i = 0; i < particles; ++i) {
    const auto id = static_cast<std::int64_t>(i);
    lots[i] = {exec::random_bits(seed, id, stream), id};
  }
  std::sort(lots.begin(), lots.end());
  std::vector<std::int64_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(lots[i].second);
  return chosen;
}

class Pathlines final : public Observer {
 public:
  void parameters(ParameterList& list) override {
    list.numbers("particles", particles_)
        .at_least(0.0)
        .doc("ids of the particles, which are their numbers in the initial order; empty: `count` particles are chosen");
    list.integer("count", count_).at_least(1.0).doc("number of particles to choose");
    list.text("choice", choice_)
        .choices({"even", "random"})
        .doc("even: spread evenly over the box; random: at random, by `seed`");
    list.integer("seed", seed_).at_least(0.0).doc("seed of the random choice");
  }

  void plan(const Scene& scene, ObserverPlan& plan) override {
    check(scene);
    plan.follow_every_step();
    plan.traces_particles();
    plan.table("path", static_cast<std::size_t>(scene.dimension))
        .unit("m")
        .doc("one row per particle: its position, without jumps at the faces of the box");
    plan.table("distance", 1).unit("m").doc("one row per particle: length of its path since the start");
    plan.table("id", 1).doc("one row per particle: its id");
  }

  void start(const ObserverContext& context) override {
    const ById particles(context);
    const auto count = static_cast<std::size_t>(count_);
    if (!particles_.empty()) {
      id_.assign(particles_.begin(), particles_.end());
    } else if (choice_ == "random") {
      id_ = randomly_chosen(count, seed_, particles.count());
    } else {
      id_ = dispatch<AllDimensions>(context.scene().dimension, [&]<int Dim>() {
        return evenly_chosen<Dim>(count, context.scene(), particles.positions<Dim>());
      });
    }
    path_ = current_path(context);
    distance_.assign(id_.size(), 0.0);
  }

  void follow(const ObserverContext& context) override {
    const auto now = current_path(context);
    const std::size_t dimension = now.size() / id_.size();
    for (std::size_t i = 0; i < id_.size(); ++i) {
      double square = 0.0;
      for (std::size_t d = 0; d < dimension; ++d)
        square += std::pow(now[i * dimension + d] - path_[i * dimension + d], 2);
      distance_[i] += std::sqrt(square);
    }
    path_ = now;
  }

  void sample(const ObserverContext&, Sample& sample) override {
    sample.set("path", path_);
    sample.set("distance", distance_);
    sample.set("id", std::vector<double>(id_.begin(), id_.end()));
  }

  [[nodiscard]] std::map<std::string, std::vector<double>> save() const override {
    return {{"id", std::vector<double>(id_.begin(), id_.end())}, {"path", path_}, {"distance", distance_}};
  }

  void restore(const std::map<std::string, std::vector<double>>& saved) override {
    id_.assign(saved.at("id").begin(), saved.at("id").end());
    path_ = saved.at("path");
    distance_ = saved.at("distance");
  }

 private:
  void check(const Scene& scene) const {
    const auto fail = [](const std::string& text) { throw Error(ExitCode::bad_case, "pathlines: " + text); };
    const std::string number = std::to_string(scene.particle_count);
    if (particles_.empty() && count_ > scene.particle_count)
      fail("`count` is " + std::to_string(count_) + ", but there are only " + number + " particles");
    auto sorted = particles_;
    std::sort(sorted.begin(), sorted.end());
    for (const double id : sorted) {
      if (id != std::floor(id) || id < 0.0 || id >= scene.particle_count)
        fail("`particles` are whole numbers from 0 to " + std::to_string(scene.particle_count - 1) + ", not " +
             text_of(id));
    }
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) fail("`particles` names particle " + text_of(*twice) + " more than once");
  }

  static std::string text_of(double id) {
    return id == std::floor(id) && std::abs(id) < 1e15 ? std::to_string(static_cast<std::int64_t>(id))
                                                       : std::to_string(id);
  }

  /// Row-major: a row a chosen particle, a column an axis.
  std::vector<double> current_path(const ObserverContext& context) {
    const auto& places = places_.find(id_, context.id());
    const auto dimension = static_cast<std::size_t>(context.scene().dimension);
    std::vector<double> path(id_.size() * dimension);
    for (std::size_t d = 0; d < dimension; ++d) {
      const auto along = context.unwrapped_at(static_cast<int>(d), places);
      for (std::size_t i = 0; i < id_.size(); ++i) path[i * dimension + d] = along[i];
    }
    return path;
  }

  std::vector<double> particles_;
  std::int64_t count_ = 16;
  std::string choice_ = "even";
  std::int64_t seed_ = 1;

  std::vector<std::int64_t> id_;
  std::vector<double> path_;      // at the last step, row-major
  std::vector<double> distance_;  // so far
  Places places_;
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::Pathlines, "pathlines", "1.0.0", "Paths of chosen particles and distance travelled")
