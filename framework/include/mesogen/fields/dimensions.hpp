#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "mesogen/export.hpp"

namespace mesogen {

/// Dimensions of space as template arguments.
template <int... Dims>
using Dimensions = std::integer_sequence<int, Dims...>;

/// The dimensions that there are: code may be written and tested for all of them.
using AllDimensions = Dimensions<2, 3>;

/// The dimensions that Mesogen is built for: the only list of them. To add one, add it here and to the explicit
/// instantiations in `framework/sph/passes`, and raise MESOGEN_ABI.
using BuiltDimensions = Dimensions<2>;

/// A set of dimensions as plain data: DimensionSet{2, 3}.
class MESOGEN_EXPORT DimensionSet {
 public:
  constexpr DimensionSet(std::initializer_list<int> dimensions) {
    for (const int dimension : dimensions) bits_ |= bit(dimension);
  }
  template <int... Dims>
  constexpr explicit DimensionSet(Dimensions<Dims...> /*dimensions*/) : DimensionSet({Dims...}) {}

  [[nodiscard]] constexpr bool contains(int dimension) const { return (bits_ & bit(dimension)) != 0; }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  /// Those that are in both.
  [[nodiscard]] constexpr DimensionSet common(const DimensionSet& other) const {
    DimensionSet both = *this;
    both.bits_ &= other.bits_;
    return both;
  }
  /// In ascending order.
  [[nodiscard]] std::vector<int> list() const;
  /// "2", "2 and 3"; empty for an empty set.
  [[nodiscard]] std::string text() const;

  friend constexpr bool operator==(const DimensionSet&, const DimensionSet&) = default;

 private:
  static constexpr int most = 31;
  static constexpr std::uint32_t bit(int dimension) {
    return dimension < 0 || dimension > most ? 0U : std::uint32_t{1} << static_cast<unsigned>(dimension);
  }
  std::uint32_t bits_ = 0;
};

inline constexpr DimensionSet built_dimensions{BuiltDimensions{}};

}  // namespace mesogen
