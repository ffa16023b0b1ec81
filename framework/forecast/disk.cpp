#include "forecast/disk.hpp"

#include <fmt/format.h>

#include <cmath>

#include "forecast/memory.hpp"
#include "forecast/steps.hpp"

namespace mesogen {

namespace {

constexpr double left_free = 0.1;  // of what is available

/// What a run writes, and what of it fits a disk.
class Written {
 public:
  explicit Written(const Setup& setup)
      : output_(setup.source.output),
        end_(setup.source.time.end),
        time_unit_(setup.source.units.time),
        frames_(frames_stored(setup)),
        frame_(frame_bytes(setup)),
        kept_(checkpoints_kept(setup)),
        others_(checkpoints_stored(setup) - kept_),
        checkpoint_(checkpoint_bytes(setup)) {}

  [[nodiscard]] double most() const { return 2.0 * frames_ * frame_ + (kept_ + others_) * checkpoint_; }
  [[nodiscard]] double at_end() const { return frames_ * frame_ + (kept_ + others_) * checkpoint_; }
  [[nodiscard]] bool mostly_kept() const { return kept_ * checkpoint_ > 2.0 * frames_ * frame_; }

  [[nodiscard]] std::string text() const {
    return fmt::format(
        "{:.6g} frames of {:.3g} MB and {:.6g} checkpoints of {:.3g} MB need {:.3g} GB of disk (frames are there twice "
        "while they are packed at the end)",
        frames_, frame_ / 1e6, kept_ + others_, checkpoint_ / 1e6, most() / 1e9);
  }

  /// The interval between frames that fits beside the checkpoints; empty if none does.
  [[nodiscard]] std::string fewer_frames(double free) const {
    const double fit = std::floor((room(free) - (kept_ + others_) * checkpoint_) / (2.0 * frame_));
    if (fit < 2.0) return {};
    return fmt::format("an interval of {:.3g} {} or more fits", 1.01 * end_ / (fit - 1.0), time_unit_);
  }

  /// How many checkpoints that are kept for good fit beside the frames; empty if that does not help.
  [[nodiscard]] std::string fewer_kept(double free) const {
    const double fit = std::floor((room(free) - 2.0 * frames_ * frame_ - others_ * checkpoint_) / checkpoint_);
    if (fit < 0.0 || fit >= kept_) return {};
    const double multiples = fit - static_cast<double>(output_.checkpoint_times.size());
    if (output_.checkpoint_every && multiples >= 0.0)
      return fmt::format("output.checkpoint_every = {:.3g} or more fits", 1.01 * end_ / (multiples + 1.0));
    return fmt::format("no more than {:.6g} checkpoints kept for good fit", fit);
  }

 private:
  static double room(double free) { return (1.0 - left_free) * free; }

  const Case::Output& output_;
  double end_;
  std::string time_unit_;
  double frames_;
  double frame_;
  double kept_;
  double others_;
  double checkpoint_;
};

}  // namespace

double bytes_on_disk(const Setup& setup) { return Written(setup).at_end(); }

double most_on_disk(const Setup& setup) { return Written(setup).most(); }

std::optional<Excess> beyond_disk(const Setup& setup, double free) {
  const Written written(setup);
  if (!(free > 0.0) || written.most() <= free) return std::nullopt;
  const bool kept = written.mostly_kept();
  std::string remedy = kept ? written.fewer_kept(free) : written.fewer_frames(free);
  if (remedy.empty()) remedy = "make room, or take fewer particles or fields";
  const bool every = setup.source.output.checkpoint_every.has_value();
  const std::string key = !kept ? "interval" : every ? "checkpoint_every" : "checkpoint_times";
  return Excess{"output." + key, fmt::format("{}, but {:.3g} GB are free; {}", written.text(), free / 1e9, remedy)};
}

}  // namespace mesogen
