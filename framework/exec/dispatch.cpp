#include "mesogen/exec/dispatch.hpp"

#include <string>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen::detail {

void refuse_dimension(int dimension, const DimensionSet& known) {
  throw Error(ExitCode::bad_case,
              "there is no code for " + std::to_string(dimension) + " dimensions, only for " + known.text());
}

}  // namespace mesogen::detail
