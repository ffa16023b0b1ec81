#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "mesogen/plugin/observer.hpp"

namespace mesogen {

/// What an observer sees, ordered by particle id instead of storage. Entry i belongs to the same particle in every
/// sample, and sums do not depend on the order in which particles are stored.
class ById {
 public:
  explicit ById(const ObserverContext& context) : context_(context), place_(context.id().size()) {
    const auto id = context.id();
    for (std::size_t i = 0; i < id.size(); ++i) place_.at(static_cast<std::size_t>(id[i])) = i;
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
      for (std::size_t i = 0; i < place_.size(); ++i) points[i][static_cast<std::size_t>(d)] = stored[place_[i]];
    }
    return points;
  }

 private:
  [[nodiscard]] std::vector<double> ordered(const std::vector<double>& stored) const {
    std::vector<double> values(place_.size());
    for (std::size_t i = 0; i < place_.size(); ++i) values[i] = stored[place_[i]];
    return values;
  }

  const ObserverContext& context_;
  std::vector<std::size_t> place_;  // of each id, its index in storage
};

}  // namespace mesogen
