#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/observer.hpp"

namespace mesogen::output {

/// All samples of one quantity.
struct QuantitySeries {
  Quantity quantity;
  std::vector<std::size_t> rows;  ///< of each sample; 1 for a scalar
  std::vector<double> values;     ///< behind each other, each sample row by row

  [[nodiscard]] std::size_t columns() const { return quantity.columns == 0 ? 1 : quantity.columns; }
  /// The most rows that a sample has.
  [[nodiscard]] std::size_t most_rows() const;
  /// Samples x most_rows() x columns, padded with NaN.
  [[nodiscard]] std::vector<double> padded() const;
};

/// All samples of one observer.
struct ObserverSeries {
  std::vector<std::int64_t> steps;
  std::vector<double> times;  ///< s
  std::map<std::string, QuantitySeries> quantities;
};

/// The samples of a run, held in memory: they are small beside the frames.
class MESOGEN_EXPORT SampleStore {
 public:
  void declare(const std::string& observer, const Quantity& quantity);
  /// False if there is a sample at this step already.
  bool add(const std::string& observer, const Sample& sample, std::int64_t step, double time);
  /// Forgets samples later than a step.
  void drop_after(std::int64_t step);
  /// The same of one observer.
  void drop_after(std::int64_t step, const std::string& observer);
  [[nodiscard]] const std::map<std::string, ObserverSeries>& observers() const { return observers_; }
  /// Takes over samples read from a file.
  void restore(const std::string& observer, ObserverSeries series);

 private:
  std::map<std::string, ObserverSeries> observers_;
};

}  // namespace mesogen::output
