#include "mesogen/fields/dimensions.hpp"

namespace mesogen {

std::vector<int> DimensionSet::list() const {
  std::vector<int> all;
  for (int dimension = 0; dimension <= most; ++dimension)
    if (contains(dimension)) all.push_back(dimension);
  return all;
}

std::string DimensionSet::text() const {
  std::string text;
  for (const int dimension : list()) text += (text.empty() ? "" : " and ") + std::to_string(dimension);
  return text;
}

}  // namespace mesogen
