#include "output/sample_store.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen::output {

namespace {

[[noreturn]] void refuse(const std::string& observer, const std::string& text) {
  throw Error(ExitCode::run_failed, "observers." + observer + ": " + text + "; this is a fault of its plugin");
}

/// How many rows a value has. Throws if it does not fit the declaration.
std::size_t rows_of(const std::string& observer, const QuantitySeries& series, const std::vector<double>& values,
                    std::int64_t step) {
  const std::string where = series.quantity.name + " of the sample at step " + std::to_string(step);
  if (values.size() % series.columns() != 0)
    refuse(observer, where + " has " + std::to_string(values.size()) + " numbers, which do not fill rows of " +
                         std::to_string(series.columns()));
  const std::size_t rows = values.size() / series.columns();
  if (series.quantity.columns == 0 && rows != 1)
    refuse(observer, where + " has " + std::to_string(rows) + " numbers, but was declared as one");
  if (!series.quantity.varying && !series.rows.empty() && rows != series.rows.front())
    refuse(observer, where + " has " + std::to_string(rows) + " rows, the samples before have " +
                         std::to_string(series.rows.front()) + ": declare it as varying");
  return rows;
}

/// Forgets the samples later than a step.
void drop(ObserverSeries& series, std::int64_t step) {
  const auto last = std::ranges::upper_bound(series.steps, step);
  const auto kept = static_cast<std::size_t>(last - series.steps.begin());
  series.steps.resize(kept);
  series.times.resize(kept);
  for (auto& [name, quantity] : series.quantities) {
    quantity.rows.resize(kept);
    quantity.values.resize(std::accumulate(quantity.rows.begin(), quantity.rows.end(), std::size_t{0}) *
                           quantity.columns());
  }
}

}  // namespace

std::size_t QuantitySeries::most_rows() const { return rows.empty() ? 0 : *std::ranges::max_element(rows); }

std::vector<double> QuantitySeries::padded() const {
  const std::size_t width = most_rows() * columns();
  if (width * rows.size() == values.size()) return values;
  std::vector<double> result(width * rows.size(), std::numeric_limits<double>::quiet_NaN());
  auto from = values.begin();
  for (std::size_t sample = 0; sample < rows.size(); ++sample) {
    const auto to = from + static_cast<std::ptrdiff_t>(rows[sample] * columns());
    std::copy(from, to, result.begin() + static_cast<std::ptrdiff_t>(sample * width));
    from = to;
  }
  return result;
}

void SampleStore::declare(const std::string& observer, const Quantity& quantity) {
  ObserverSeries& series = observers_[observer];
  const auto found = series.quantities.find(quantity.name);
  if (found == series.quantities.end()) {
    if (!series.steps.empty())
      throw Error(ExitCode::bad_case, "observers." + observer + ": the results to be continued have no " +
                                          quantity.name + "; start a new run to record it");
    series.quantities[quantity.name].quantity = quantity;
    return;
  }
  Quantity& known = found->second.quantity;
  if (known.columns != quantity.columns || known.varying != quantity.varying)
    throw Error(ExitCode::bad_case, "observers." + observer + ": " + quantity.name +
                                        " has another shape in the results to be continued; start a new run");
  known = quantity;
}

bool SampleStore::add(const std::string& observer, const Sample& sample, std::int64_t step, double time) {
  const auto found = observers_.find(observer);
  if (found == observers_.end()) throw std::logic_error("no quantity of observer " + observer + " was declared");
  ObserverSeries& series = found->second;
  if (!series.steps.empty() && step == series.steps.back()) return false;
  if (!series.steps.empty() && step < series.steps.back())
    throw std::logic_error("samples of observer " + observer + " must come in the order of steps");

  for (const auto& [name, values] : sample.values())
    if (!series.quantities.contains(name)) refuse(observer, "sets " + name + ", which it did not declare");
  std::map<std::string, std::size_t> rows;
  for (const auto& [name, quantity] : series.quantities) {
    const auto value = sample.values().find(name);
    if (value == sample.values().end())
      refuse(observer, "its sample at step " + std::to_string(step) + " lacks " + name + ", which it declared");
    rows[name] = rows_of(observer, quantity, value->second, step);
  }
  // Nothing is kept of a sample that was refused.
  for (auto& [name, quantity] : series.quantities) {
    const std::vector<double>& values = sample.values().find(name)->second;
    quantity.rows.push_back(rows[name]);
    quantity.values.insert(quantity.values.end(), values.begin(), values.end());
  }
  series.steps.push_back(step);
  series.times.push_back(time);
  return true;
}

void SampleStore::drop_after(std::int64_t step) {
  for (auto& [name, series] : observers_) drop(series, step);
}

void SampleStore::drop_after(std::int64_t step, const std::string& observer) {
  if (const auto found = observers_.find(observer); found != observers_.end()) drop(found->second, step);
}

void SampleStore::restore(const std::string& observer, ObserverSeries series) {
  observers_[observer] = std::move(series);
}

}  // namespace mesogen::output
