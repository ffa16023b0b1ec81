#pragma once

#include <vector>

#include "mesogen/nematics/director_grid.hpp"
#include "mesogen/plugin/parameters.hpp"

namespace mesogen::nematics {

/// How an observer looks for defects: two parameters that all who look for them share, and what is found with them.
struct DefectSearch {
  double merge_distance = 1.5;    ///< particle spacings
  double smoothing_length = 1.0;  ///< particle spacings

  void parameters(ParameterList& list);
  /// The defects of the field `order_tensor`, without close pairs of opposite charges.
  [[nodiscard]] std::vector<Defect> find(const ObserverContext& context) const;
};

}  // namespace mesogen::nematics
