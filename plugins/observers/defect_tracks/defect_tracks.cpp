/// Which defect is which from sample to sample: their paths, speeds, births and deaths.
///
/// The defects of a sample are matched with those of the last one, each charge by itself, so that the sum of their
/// squared displacements is smallest (Crocker & Grier, J. Colloid Interface Sci. 179, 298, 1996): the exact optimum
/// (assignment.hpp). A displacement is the shortest one, across the faces where the box is periodic. One beyond the
/// cutoff is none: the old track ended, a new one began, and the sum counts the squared cutoff for the two.
///
/// Defects come and go in pairs, so births and deaths count those of charge +1/2. What happens between two samples is
/// not seen: an interval in which defects move by more than part of their distance confuses them.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "assignment.hpp"
#include "mesogen/nematics/defect_search.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace mesogen {
namespace {

using nematics::Defect;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A defect that is followed.
struct Track {
  double id = 0.0;
  std::array<double, 2> path{};  ///< m, without jumps at the faces
  double charge = 0.0;
  double orientation = 0.0;  ///< rad
  double born = 0.0;         ///< s, time of the first sample that has it
  // Since the last sample:
  std::array<double, 2> velocity{none, none};  ///< m/s
  double axial_velocity = none;                ///< m/s, along the mean of both orientations, toward the head

  static constexpr std::size_t saved_numbers = 6;
};

/// From a place to another, m: the shortest way.
std::array<double, 2> displacement(const std::array<double, 2>& from, const std::array<double, 2>& to,
                                   const Scene& scene) {
  std::array<double, 2> way{};
  for (std::size_t d = 0; d < 2; ++d) {
    way[d] = to[d] - from[d];
    if (scene.periodic[d]) way[d] = std::remainder(way[d], scene.box[d]);
  }
  return way;
}

/// Mean of what is not NaN; NaN without any.
class Mean {
 public:
  void add(double value) {
    if (std::isnan(value)) return;
    sum_ += value;
    count_ += 1.0;
  }
  [[nodiscard]] double value() const { return sum_ / count_; }

 private:
  double sum_ = 0.0;
  double count_ = 0.0;
};

class DefectTracks final : public Observer {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.number_or("max_displacement", max_displacement_, "auto")
        .unit("m")
        .above(0.0)
        .doc(
            "largest distance that a defect can move between two samples; a defect farther away counts as another one. "
            "Choose the largest speed times the interval, but less than half the distance of defects of the same "
            "charge. auto: a quarter of the mean distance of defects, sqrt(area / number), or 5 spacings if that is "
            "more");
    search_.parameters(list);
  }

  void plan(const Scene& /*scene*/, ObserverPlan& plan) override {
    plan.reads("order_tensor");
    auto& table = plan.table("tracks", 8);
    table.unit("1, m, m, 1, rad, m/s, m/s, s")
        .doc(
            "one row per defect: id; x, y without jumps at the faces; charge; orientation (as of the observer "
            "`defects`); velocity vx, vy (displacement since the last sample divided by the time; NaN at the first "
            "sample of the defect); age since its first sample");
    table.varying = true;
    plan.scalar("births").doc("pairs created since the last sample: +1/2 defects that appeared");
    plan.scalar("deaths").doc("pairs annihilated since the last sample: +1/2 defects that vanished");
    plan.scalar("created").doc("sum of births over all samples so far");
    plan.scalar("annihilated").doc("sum of deaths over all samples so far");
    plan.scalar("lifetime")
        .unit("s")
        .doc(
            "mean time from the first to the last sample of a defect, over all defects that vanished so far; NaN if "
            "none did");
    plan.scalar("speed_plus")
        .unit("m/s")
        .doc("mean speed of +1/2 defects since the last sample; NaN if there are none");
    plan.scalar("speed_minus")
        .unit("m/s")
        .doc("mean speed of -1/2 defects since the last sample; NaN if there are none");
    plan.scalar("axial_velocity_plus")
        .unit("m/s")
        .doc("mean velocity of +1/2 defects along their own axis, positive toward the head; NaN if there are none");
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    const Scene& scene = context.scene();
    const auto defects = search_.find(context);
    double births = 0.0;
    double deaths = 0.0;
    follow_tracks(defects, scene, context.time(), births, deaths);
    created_ += births;
    annihilated_ += deaths;
    std::vector<double> rows;
    std::array<Mean, 2> speed;  // of +1/2, of -1/2
    Mean axial;
    for (const Track& track : tracks_) {
      const auto [vx, vy] = track.velocity;
      rows.insert(rows.end(), {track.id, track.path[0], track.path[1], track.charge, track.orientation, vx, vy,
                               context.time() - track.born});
      speed[track.charge > 0.0 ? 0 : 1].add(std::hypot(vx, vy));
      if (track.charge > 0.0) axial.add(track.axial_velocity);
    }
    sample.set("tracks", std::move(rows));
    sample.set("births", births);
    sample.set("deaths", deaths);
    sample.set("created", created_);
    sample.set("annihilated", annihilated_);
    sample.set("lifetime", lifetimes_ / ended_);
    sample.set("speed_plus", speed[0].value());
    sample.set("speed_minus", speed[1].value());
    sample.set("axial_velocity_plus", axial.value());
  }

  [[nodiscard]] std::map<std::string, std::vector<double>> save() const override {
    std::vector<double> numbers;
    for (const Track& track : tracks_)
      numbers.insert(numbers.end(),
                     {track.id, track.path[0], track.path[1], track.charge, track.orientation, track.born});
    return {{"tracks", numbers}, {"totals", {last_time_, next_id_, created_, annihilated_, lifetimes_, ended_}}};
  }

  void restore(const std::map<std::string, std::vector<double>>& saved) override {
    const auto& numbers = saved.at("tracks");
    tracks_.clear();
    for (std::size_t n = 0; n + Track::saved_numbers <= numbers.size(); n += Track::saved_numbers) {
      Track track;
      track.id = numbers[n];
      track.path = {numbers[n + 1], numbers[n + 2]};
      track.charge = numbers[n + 3];
      track.orientation = numbers[n + 4];
      track.born = numbers[n + 5];
      tracks_.push_back(track);
    }
    const auto& totals = saved.at("totals");
    last_time_ = totals.at(0);
    next_id_ = totals.at(1);
    created_ = totals.at(2);
    annihilated_ = totals.at(3);
    lifetimes_ = totals.at(4);
    ended_ = totals.at(5);
  }

 private:
  /// Moves tracks to the defects that continue them, ends those that none continues, begins new ones. Tracks stay in
  /// the order of their ids.
  void follow_tracks(const std::vector<Defect>& defects, const Scene& scene, double time, double& births,
                     double& deaths) {
    const bool first = std::isnan(last_time_);
    const double cutoff = cutoff_for(std::max(defects.size(), tracks_.size()), scene);
    std::vector<const Defect*> next(tracks_.size(), nullptr);  // continues each track
    std::vector<bool> known(defects.size(), false);
    for (const double charge : {0.5, -0.5}) match(charge, defects, scene, cutoff, next, known);
    std::vector<Track> living;
    for (std::size_t n = 0; n < tracks_.size(); ++n) {
      if (next[n] != nullptr) {
        living.push_back(moved(tracks_[n], *next[n], scene, time - last_time_));
        continue;
      }
      lifetimes_ += last_time_ - tracks_[n].born;
      ended_ += 1.0;
      if (tracks_[n].charge > 0.0) deaths += 1.0;
    }
    for (std::size_t n = 0; n < defects.size(); ++n) {
      if (known[n]) continue;
      Track track;
      track.id = next_id_++;
      track.path = defects[n].position;
      track.charge = defects[n].charge;
      track.orientation = defects[n].orientation;
      track.born = time;
      living.push_back(track);
      if (!first && track.charge > 0.0) births += 1.0;
    }
    tracks_ = std::move(living);
    last_time_ = time;
  }

  void match(double charge, const std::vector<Defect>& defects, const Scene& scene, double cutoff,
             std::vector<const Defect*>& next, std::vector<bool>& known) const {
    std::vector<std::size_t> before;
    std::vector<std::size_t> now;
    for (std::size_t n = 0; n < tracks_.size(); ++n)
      if (tracks_[n].charge == charge) before.push_back(n);
    for (std::size_t n = 0; n < defects.size(); ++n)
      if (defects[n].charge == charge) now.push_back(n);
    Costs costs{before.size(), now.size(), {}};
    for (const std::size_t track : before) {
      for (const std::size_t defect : now) {
        const auto [x, y] = displacement(tracks_[track].path, defects[defect].position, scene);
        costs.cost.push_back(x * x + y * y);
      }
    }
    const auto chosen = best_assignment(costs, cutoff * cutoff);
    for (std::size_t n = 0; n < before.size(); ++n) {
      if (chosen[n] == unassigned) continue;
      next[before[n]] = &defects[now[chosen[n]]];
      known[now[chosen[n]]] = true;
    }
  }

  [[nodiscard]] double cutoff_for(std::size_t count, const Scene& scene) const {
    if (max_displacement_) return *max_displacement_;
    const double apart = std::sqrt(scene.box[0] * scene.box[1] / static_cast<double>(std::max<std::size_t>(count, 1)));
    return std::max(0.25 * apart, 5.0 * scene.spacing);
  }

  static Track moved(Track track, const Defect& to, const Scene& scene, double duration) {
    const auto way = displacement(track.path, to.position, scene);
    // The direction from tail to head half way: of the sum of both.
    const double x = -std::cos(track.orientation) - std::cos(to.orientation);
    const double y = -std::sin(track.orientation) - std::sin(to.orientation);
    for (std::size_t d = 0; d < 2; ++d) {
      track.path[d] += way[d];
      track.velocity[d] = duration > 0.0 ? way[d] / duration : none;
    }
    track.axial_velocity = (track.velocity[0] * x + track.velocity[1] * y) / std::hypot(x, y);
    track.orientation = to.orientation;
    return track;
  }

  std::optional<double> max_displacement_;
  nematics::DefectSearch search_;

  std::vector<Track> tracks_;  // at the last sample, by id
  double last_time_ = none;    // of the last sample, s; NaN: there was none
  double next_id_ = 0.0;
  double created_ = 0.0;
  double annihilated_ = 0.0;
  double lifetimes_ = 0.0;  // of tracks that ended, s; their sum and number
  double ended_ = 0.0;
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::DefectTracks, "defect_tracks", "1.0.0",
                        "Defects followed over time: paths, speeds, births and deaths")
