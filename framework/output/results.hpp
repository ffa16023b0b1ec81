#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/observer.hpp"
#include "output/results_content.hpp"

namespace mesogen {

/// The results of a run, results.h5: H5MD 1.1 (de Buyl, Colberg, Hoefling, Comput. Phys. Commun. 185, 1546 (2014)).
///
/// Another thread writes a frame while the run goes on; one frame at a time, so that memory is bounded. Whenever the
/// process dies, results.h5 is a valid file. It holds every frame that was added before a call of wait(), flush() or
/// finish() that has returned; add_frame() begins with such a call. No file is ever changed in place: each frame is a
/// file of its own under frames/, and results.h5, small and virtual (its particle datasets are views of the frames), is
/// written anew beside the old one and renamed over it. finish() packs everything into one self-contained results.h5.
///
/// Steps must not decrease. All functions throw Error(run_failed) if the disk is full, the folder is gone, ...; what
/// was written before stays readable. A frame that could not be written is told of once, by the next call of
/// add_frame(), wait(), check(), flush() or finish(), and is then no part of the results.
///
/// Not every build of HDF5 stands two threads at a time. So until wait() or flush() returns, the run that added a frame
/// does nothing else with HDF5; checkpoints are written after a flush() anyway.
class MESOGEN_EXPORT ResultsWriter {
 public:
  using Options = ResultsOptions;

  /// Begins the results of a new run in a folder that holds none.
  static ResultsWriter create(Options options);
  /// Continues results, finished ones too: drops all samples and frames later than `last_step`, of `forgotten` also
  /// those at that step, and keeps the rest. With last_step < 0 nothing is kept, and results.h5 may be missing. Throws
  /// Error(bad_case) if the folder's results cannot be read or belong to a different run.
  static ResultsWriter resume(Options options, std::int64_t last_step, const EndRecords& forgotten = {});
  /// Of a rank that writes nothing: it takes no samples and no frames, and all else does nothing.
  static ResultsWriter silent();
  [[nodiscard]] bool writes() const { return !options_.folder.empty(); }
  /// Are the results in a folder those of a run that has come to its end? False if they cannot be read.
  [[nodiscard]] static bool are_finished(const std::filesystem::path& folder);

  /// Needed before the first sample, on resuming too. Throws Error(bad_case) if resumed samples have another shape.
  void declare_observable(const std::string& observer, const Quantity& quantity);
  /// Kept in memory until flush(). Every declared quantity must be there, nothing else. A sample at the step of the
  /// observer's last one is ignored.
  void add_sample(const std::string& observer, const Sample& sample, std::int64_t step, double time);
  /// Begins to write a frame, and with it all samples until now, once the frame before is on disk. The fields are the
  /// same in each frame; one of them is `position`. A frame at the step of the last one is ignored.
  void add_frame(TakenFrame frame, std::int64_t step, double time);
  /// The same of values that are there.
  void add_frame(std::vector<FrameField> fields, std::int64_t step, double time);
  /// The last frame is on disk when it returns.
  void wait();
  /// Throws if the last frame could not be written, as far as that is known; waits for nothing.
  void check();
  /// All frames and samples are on disk when it returns. Call it before each checkpoint.
  void flush();
  /// Packs the run into one file, with what it took, and removes frames/. Uses the memory of one field of one frame.
  void finish(std::optional<RunCost> cost = {});

  /// With the one that is being written, as in all that follows.
  [[nodiscard]] std::int64_t frame_count() const { return static_cast<std::int64_t>(content_.frames.size()); }
  /// Step of the last frame; -1 if there is none.
  [[nodiscard]] std::int64_t last_frame_step() const {
    return content_.frames.empty() ? -1 : content_.frames.back().step;
  }
  /// Step of the last sample of an observer; -1 if there is none.
  [[nodiscard]] std::int64_t last_sample_step(const std::string& observer) const;

 private:
  explicit ResultsWriter(Options options);
  void write_views();

  Options options_;
  output::ResultsContent content_;  ///< with the frame that is being written
  bool changed_ = true;             ///< something is not in results.h5, nor being written there
  bool finished_ = false;           ///< packed; takes nothing any more
  std::future<void> writing_;       ///< of the last frame, until somebody has waited; its destructor waits too
};

}  // namespace mesogen
