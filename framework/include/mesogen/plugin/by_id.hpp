#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "mesogen/exec/blocks.hpp"
#include "mesogen/plugin/observer.hpp"

namespace mesogen {

/// What an observer sees, ordered by particle id instead of storage: entry i belongs to the same particle in every
/// sample. Sums and searches do without it: see mesogen/exec/exact_sum.hpp and mesogen/plugin/stored_positions.hpp.
class ById {
 public:
  explicit ById(const ObserverContext& context) : context_(context), place_(context.id().size()) {
    const auto id = context.id();
    for (std::size_t i = 0; i < id.size(); ++i) place_.at(static_cast<std::size_t>(id[i])) = static_cast<Index>(i);
  }

  [[nodiscard]] std::size_t count() const { return place_.size(); }

  /// Component `component` of a field.
  [[nodiscard]] std::vector<double> values(std::string_view field, int component = 0) const {
    return ordered(context_.values(field, component));
  }
  [[nodiscard]] std::vector<double> unwrapped(int axis) const { return ordered(context_.unwrapped(axis)); }
  /// Coordinates in the box, m.
  template <int Dim>
  [[nodiscard]] std::vector<std::array<double, Dim>> positions() const {
    std::vector<std::array<double, Dim>> points(place_.size());
    for (int d = 0; d < Dim; ++d) {
      const auto stored = context_.position(d);
      for_each_place([&](std::size_t i, std::size_t place) { points[i][static_cast<std::size_t>(d)] = stored[place]; });
    }
    return points;
  }

 private:
  [[nodiscard]] std::vector<double> ordered(const std::vector<double>& stored) const {
    std::vector<double> values(place_.size());
    for_each_place([&](std::size_t i, std::size_t place) { values[i] = stored[place]; });
    return values;
  }

  template <class Action>
  void for_each_place(const Action& action) const {
    const auto count = static_cast<Index>(place_.size());
#pragma omp parallel for schedule(static) if (count >= exec::parallel_from)
    for (Index i = 0; i < count; ++i)
      action(static_cast<std::size_t>(i), static_cast<std::size_t>(place_[static_cast<std::size_t>(i)]));
  }

  const ObserverContext& context_;
  std::vector<Index> place_;  // of each id, its index in storage
};

}  // namespace mesogen
