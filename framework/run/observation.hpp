#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "mesogen/export.hpp"
#include "output/checkpoint.hpp"
#include "output/frame.hpp"
#include "output/results.hpp"
#include "run/frame_values.hpp"
#include "run/stepper.hpp"

namespace mesogen {

/// The observers and frames of a run, and where their results go. Where ranks share a run, all of them call the same
/// functions; observers live on the first, which sees the whole state.
class MESOGEN_EXPORT Observation {
 public:
  explicit Observation(Stepper& stepper);

  /// Names all quantities to the results.
  void declare(ResultsWriter& results) const;
  /// Before the first sample of a new run.
  void start();
  /// Lets the observers follow that asked for it; after a step.
  void follow();
  /// What observer n records now.
  [[nodiscard]] Sample sample(std::size_t n);
  using TakeSample = std::function<void(const std::string& observer, const Sample& sample)>;
  /// After a step: observers that follow, and those that are due.
  void sample(const std::vector<bool>& due, const TakeSample& take);
  /// The same for the results, and a frame if it is due. Readers: the observers, then the output.
  void observe(const std::vector<bool>& due, ResultsWriter& results);
  /// After the last step and observe(): samples and the frame of all who have none of this state yet, and who they are.
  EndRecords record_end(ResultsWriter& results);

  /// A frame of what is now, taken in place of the one before, which nobody must be filling any more.
  [[nodiscard]] TakenFrame take_frame();
  /// The same with its values.
  [[nodiscard]] std::vector<FrameField> frame();

  /// What the calls into observers took, and frames as far as they held up the run; without the fields that are brought
  /// up to date for them.
  [[nodiscard]] std::vector<Counter> counters() const;

  void save(Checkpoint& checkpoint) const;
  void restore(const Checkpoint& checkpoint);

 private:
  void record(const std::vector<bool>& due, ResultsWriter& results);
  [[nodiscard]] TakenFrame take_prepared_frame();

  /// Brings what a reader reads up to date, and gathers it.
  void prepare(const std::vector<std::string>& fields);
  [[nodiscard]] const Ranks& ranks() const { return stepper_.state().ranks; }

  Stepper& stepper_;
  WholeState whole_;
  std::shared_ptr<FrameValues> frame_values_;  // with who still fills a frame
  std::int64_t first_step_ = 0;                ///< observers follow the steps after it
  std::vector<Counter> sampling_;              // of each observer
  std::vector<Counter> following_;
  Counter frames_{"output: frame", "output"};
};

}  // namespace mesogen
