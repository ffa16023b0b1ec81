#include "forecast/timing.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "diagnostics/resources.hpp"
#include "forecast/memory.hpp"
#include "output/checkpoint_file.hpp"
#include "output/frame.hpp"
#include "run/marks_of.hpp"
#include "run/observation.hpp"
#include "run/stepper.hpp"

namespace mesogen {

namespace {

constexpr int fewest_steps = 3;
constexpr int most_steps = 1000;
constexpr double long_step = 0.1;         // s: nobody wants to wait for many of them
constexpr double bytes_per_second = 3e8;  // of a disk
constexpr double seconds_per_file = 5e-3;

template <class Action>
double seconds(Action&& action) {
  const auto from = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
}

/// The median of some tries: a single one may be interrupted by whatever else the machine does.
template <class Action>
double median_of(int tries, Action&& action) {
  std::vector<double> all(static_cast<std::size_t>(tries));
  for (double& one : all) one = action();
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

/// The first steps of a run, each part by itself. None goes beyond the end: a run that ends sooner begins once more.
/// What an explicit step costs does not depend on its size: it then goes on in steps so short that it does not end
/// again. A stabilised step takes stages by its size: such a run begins as often as it ends.
class Rehearsal {
 public:
  Rehearsal(Setup& setup, const std::function<std::unique_ptr<Setup>()>& set_up_again)
      : setup_(&setup), set_up_again_(set_up_again) {
    make_parts();
  }

  void start() {
    stepper_->start();
    observation_->start();
    observe(everybody(true));
  }

  /// One step, with these readers due at its end; s.
  double step(const std::vector<bool>& due) {
    if (stepper_->state().time >= end()) begin_again();
    return seconds([&] {
      const double now = stepper_->state().time;
      // As in the run, where steps end on the marks: shorter ones take fewer stages.
      stepper_->advance(setup_->scene.stabilised_steps ? stepper_->next_step(marks_of(*setup_), end())
                                                       : stepper_->next_step(std::min(end(), now + longest_)),
                        due);
      observe(due);
      stepper_->state().backend.finish();
    });
  }

  /// One step alone; s.
  double step() { return step(everybody(false)); }

  /// A step with nobody but reader n due; s.
  double step_for(std::size_t n) {
    auto due = everybody(false);
    due[n] = true;
    return step(due);
  }

  double sorting() {
    return seconds([&] {
      stepper_->state().order.sort_anew();
      stepper_->state().backend.finish();
    });
  }

  /// Making the bytes of a checkpoint; s.
  double checkpoint() {
    return seconds([&] {
      Checkpoint checkpoint;
      stepper_->save(checkpoint);
      observation_->save(checkpoint);
      (void)output::encode_checkpoint(checkpoint, 0);
    });
  }

  /// Has it ended so often that it had better be enough?
  [[nodiscard]] bool ended_often() const { return begun_again_ >= 3; }
  [[nodiscard]] std::size_t readers() const { return setup_->observers.size() + 1; }
  [[nodiscard]] std::int64_t sortings() { return sorted_before_ + stepper_->state().neighbourhood.sortings(); }
  /// Processor time of stepping and of all else, but for beginning again; s.
  [[nodiscard]] double cpu() const { return cpu_seconds() - cpu_of_beginning_again_; }
  [[nodiscard]] double skin() { return stepper_->state().neighbourhood.skin(); }
  [[nodiscard]] double fastest() const { return stepper_->motion().fastest; }

 private:
  [[nodiscard]] std::vector<bool> everybody(bool due) const {
    std::vector<bool> all(setup_->observers.size() + 1, due);
    return all;
  }

  [[nodiscard]] double end() const { return setup_->source.time.end; }

  void make_parts() {
    stepper_ = std::make_unique<Stepper>(*setup_);
    observation_ = std::make_unique<Observation>(*stepper_);
  }

  // With plugins that are new, since these have seen the end of a run.
  void begin_again() {
    const double cpu_before = cpu_seconds();
    sorted_before_ = sortings();
    observation_.reset();
    stepper_.reset();
    again_ = set_up_again_();
    setup_ = again_.get();
    make_parts();
    ++begun_again_;
    if (!setup_->scene.stabilised_steps) longest_ = end() / (most_steps + 10.0 * static_cast<double>(readers()));
    start();
    sorted_before_ -= stepper_->state().neighbourhood.sortings();
    cpu_of_beginning_again_ += cpu_seconds() - cpu_before;
  }

  void observe(const std::vector<bool>& due) {
    observation_->sample(due, [](const std::string&, const Sample&) {});
    if (due.back()) (void)output::encode_frame(observation_->frame(), {}, setup_->scene.dimension);
  }

  std::unique_ptr<Setup> again_;
  Setup* setup_;
  const std::function<std::unique_ptr<Setup>()>& set_up_again_;
  std::unique_ptr<Stepper> stepper_;
  std::unique_ptr<Observation> observation_;
  int begun_again_ = 0;
  std::int64_t sorted_before_ = 0;
  double cpu_of_beginning_again_ = 0.0;
  double longest_ = HUGE_VAL;  // of steps, s
};

/// Particles are sorted anew when one has strayed by half the skin.
double count_sortings(double steps, double step_size, double speed, double skin) {
  if (!(speed > 0.0) || !std::isfinite(step_size)) return 0.0;
  return steps / std::max(1.0, std::floor(skin / 2.0 / (speed * step_size)) + 1.0);
}

}  // namespace

TimeForecast forecast_time(Setup& setup, const std::function<std::unique_ptr<Setup>()>& set_up_again,
                           const StepForecast& steps, double start_up, double budget) {
  TimeForecast time;
  time.threads = omp_get_max_threads();
  Rehearsal run(setup, set_up_again);
  time.start = start_up + seconds([&] { run.start(); });
  const double fastest = run.fastest();
  run.step();
  run.sorting();
  // Who needs no neighbours sorts now and then only: that is among the steps, and where readers ask for it.
  const bool sorts = setup.graph->sums_pairs();
  if (sorts) time.sorting = median_of(5, [&] { return run.sorting(); });
  run.step();

  // Steps that happen to sort count for their number, without the sorting.
  const std::int64_t sorted = run.sortings();
  double stepping = 0.0;
  const double cpu_before = run.cpu();
  while (time.timed_steps < fewest_steps ||
         (stepping < budget && time.timed_steps < most_steps && !run.ended_often())) {
    stepping += run.step();
    ++time.timed_steps;
  }
  const double processors = (run.cpu() - cpu_before) / stepping;
  const double sorting = static_cast<double>(run.sortings() - sorted) * time.sorting;
  time.step = std::max(stepping - sorting, stepping / 2.0) / time.timed_steps;

  for (std::size_t n = 0; n < run.readers(); ++n) {
    run.step_for(n);
    const double with = median_of(time.step < long_step ? 3 : 1, [&] { return run.step_for(n); });
    const double extra = std::max(0.0, with - time.step);
    time.observing += extra * times_due(setup, n, steps.expected);
  }
  const double count = steps.expected;
  // The expected speed is the largest that there will be; on the way to it the flow is slower.
  const double speed = std::max(fastest, setup.scene.expected_speed() / 2.0);
  const Transport& flow = setup.graph->transport();
  if (sorts && !flow.velocity.empty() && !flow.fixed)
    time.sortings = count_sortings(count, setup.source.time.end / count, speed, run.skin());
  const double computing = count * time.step + time.sortings * time.sorting + time.observing;

  const double checkpoints =
      checkpoints_stored(setup) + std::floor(computing / setup.source.output.checkpoint_interval);
  const double a_checkpoint = run.checkpoint() + checkpoint_bytes(setup) / bytes_per_second + seconds_per_file;
  // Each frame is written by itself, then read and written once more into the results.
  const double a_frame = 3.0 * frame_bytes(setup) / bytes_per_second + 3.0 * seconds_per_file;
  time.writing = checkpoints * a_checkpoint + frames_stored(setup) * a_frame;
  time.wall = time.start + computing + time.writing;
  time.cpu = processors * time.wall;
  return time;
}

}  // namespace mesogen
