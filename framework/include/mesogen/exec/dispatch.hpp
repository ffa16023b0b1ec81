#pragma once

#include <utility>

#include "mesogen/export.hpp"
#include "mesogen/fields/dimensions.hpp"
#include "mesogen/fields/rank.hpp"

/// From a precision and a dimension that are known at run time to code that is compiled for them, in one spot:
///
///     dispatch(scene.precision, scene.dimension, [&]<class Real, int Dim>() { fill<Real, Dim>(grid); });
///
/// The action returns the same type for all arguments. A dimension that Mesogen is not built for is an Error.
namespace mesogen {

namespace detail {

/// Throws the Error of a dimension for which there is no code.
[[noreturn]] MESOGEN_EXPORT void refuse_dimension(int dimension, const DimensionSet& known);

template <int First, int... Others, class Action>
decltype(auto) dispatch_among(Dimensions<First, Others...> /*known*/, const DimensionSet& all, int dimension,
                              Action& action) {
  if constexpr (sizeof...(Others) > 0) {
    if (dimension != First) return dispatch_among(Dimensions<Others...>{}, all, dimension, action);
  } else {
    if (dimension != First) refuse_dimension(dimension, all);
  }
  return action.template operator()<First>();
}

}  // namespace detail

/// Calls action<Real>().
template <class Action>
decltype(auto) dispatch(Precision precision, Action&& action) {
  if (precision == Precision::single_precision) return action.template operator()<float>();
  return action.template operator()<double>();
}

/// Calls action<Dim>(). Code that needs none of the framework's loops, such as that of an observer, may know more
/// dimensions than Mesogen is built for: dispatch<AllDimensions>(dimension, action).
template <class Known = BuiltDimensions, class Action>
decltype(auto) dispatch(int dimension, Action&& action) {
  return detail::dispatch_among(Known{}, DimensionSet(Known{}), dimension, action);
}

/// Calls action<Real, Dim>().
template <class Action>
decltype(auto) dispatch(Precision precision, int dimension, Action&& action) {
  return dispatch(dimension, [&]<int Dim>() -> decltype(auto) {
    return dispatch(precision, [&]<class Real>() -> decltype(auto) { return action.template operator()<Real, Dim>(); });
  });
}

}  // namespace mesogen
