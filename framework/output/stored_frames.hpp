#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "output/results_content.hpp"

namespace mesogen {

/// The frames of a run, finished or not, to be read again.
class MESOGEN_EXPORT StoredFrames {
 public:
  /// Of the results in options.folder. Throws Error(bad_case) if they cannot be read or belong to a different run.
  explicit StoredFrames(const ResultsOptions& options);
  ~StoredFrames();

  [[nodiscard]] std::size_t count() const { return stamps_.size(); }
  [[nodiscard]] const output::FrameStamp& stamp(std::size_t frame) const { return stamps_.at(frame); }
  /// Null if the frames do not hold this field.
  [[nodiscard]] const output::FieldShape* find(const std::string& field) const;
  [[nodiscard]] const std::vector<output::FieldShape>& fields() const { return fields_; }
  /// Particles x components, row by row, by particle id. Throws Error(bad_case) if they cannot be read.
  [[nodiscard]] std::vector<double> read(std::size_t frame, const output::FieldShape& field) const;

 private:
  struct Source;
  std::filesystem::path folder_;
  std::size_t particles_;
  std::vector<output::FieldShape> fields_;
  std::vector<output::FrameStamp> stamps_;
  std::unique_ptr<Source> source_;
};

}  // namespace mesogen
