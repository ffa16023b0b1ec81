#pragma once

#include <vector>

#include "mesogen/nematics/director_grid.hpp"
#include "mesogen/plugin/parameters.hpp"

namespace mesogen::nematics {

/// How an observer finds defects: two parameters that all such observers share, and the search itself.
struct DefectSearch {
  double merge_distance = 1.5;    ///< in particle spacings
  double smoothing_length = 1.0;  ///< in particle spacings

  void parameters(ParameterList& list);
  /// Returns the defects of the field `order_tensor`, without close pairs of opposite charges.
  [[nodiscard]] std::vector<Defect> find(const ObserverContext& context) const;
};

}  // namespace mesogen::nematics
