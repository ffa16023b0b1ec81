#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include "mesogen/export.hpp"

namespace mesogen {

/// Tells how far a run is: on a terminal one line, rewritten; elsewhere a line now and then.
class MESOGEN_EXPORT Progress {
 public:
  enum class Style { silent, plain, terminal };
  /// Wall-clock seconds from any origin.
  using Clock = std::function<double()>;

  Progress(std::ostream& out, Style style);
  Progress(std::ostream& out, Style style, Clock clock);

  /// Silent if quiet, else by whether the file descriptor (1 stdout, 2 stderr) is a terminal.
  static Style style_for(int descriptor, bool quiet);

  /// The run stands at (time, step), simulated time in `time_unit`, and will go on to `end`.
  void start(double time, std::int64_t step, double end, const std::string& time_unit = "s");
  /// After each step. Writes seldom enough to cost nothing.
  void update(double time, std::int64_t step);
  /// After the last step, also of a run that was interrupted: leaves a complete line.
  void finish(double time, std::int64_t step);

 private:
  void measure(double now, double time, std::int64_t step);
  [[nodiscard]] std::string line(double time) const;
  void write(const std::string& text);
  [[nodiscard]] double percent(double time) const;

  std::ostream& out_;
  Style style_;
  Clock clock_;
  std::string time_unit_;
  double start_ = 0.0;
  double end_ = 0.0;
  double begun_ = 0.0;         ///< wall time
  double measured_ = 0.0;      ///< wall time of the last measurement
  double written_ = 0.0;       ///< wall time of the last line
  double written_time_ = 0.0;  ///< simulated time of the last line
  double measured_time_ = 0.0;
  std::int64_t first_step_ = 0;
  std::int64_t measured_step_ = 0;
  double steps_per_second_ = 0.0;
  double speed_ = 0.0;  ///< simulated seconds per wall second
};

/// "3 h 05 min", "4 min 12 s", "8 s"
MESOGEN_EXPORT std::string duration_text(double seconds);

}  // namespace mesogen
