#pragma once

#include <string>
#include <vector>

#include "exec/backend.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/passes.hpp"
#include "schedule/catalogue.hpp"

namespace mesogen {

/// All linear terms of a field (see LinearTerm) together: rate += (diffusion x Laplacian - damping x field) / divisor.
struct LinearTerms {
  std::string owner;  ///< instance that declared the first, "physics.flow"
  std::string field;
  std::string rate;
  std::string divisor;  ///< empty: none
  double diffusion = 0.0;
  double damping = 0.0;
  double usual_divisor = 1.0;
};

/// Those that an instance of a plugin declared are added to all others. Throws an Error(bad_case) that names the field
/// if terms differ in their divisor.
MESOGEN_EXPORT void add_linear_terms(const std::string& instance, const PassList& passes,
                                     std::vector<LinearTerms>& all);

/// Can stabilised steps take them into account? The framework must advance the field and make its Laplacian.
MESOGEN_EXPORT bool can_be_staged(const LinearTerms& terms, const Catalogue& catalogue);

/// The pass that adds them to the rate.
Pass linear_pass(const LinearTerms& terms, const Catalogue& catalogue, const Backend& backend);

}  // namespace mesogen
