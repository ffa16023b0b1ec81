#pragma once

#include <string>
#include <vector>

#include "exec/backend.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/passes.hpp"
#include "particles/field_loops.hpp"
#include "schedule/catalogue.hpp"

namespace mesogen {

/// A coefficient of linear terms: the number where the field `scale` has its usual value, and in proportion to it
/// elsewhere.
struct LinearCoefficient {
  double number = 0.0;
  std::string scale = {};  ///< empty: uniform
  double usual_scale = 1.0;

  [[nodiscard]] bool any() const { return number > 0.0; }
};

/// All linear terms of a field (see LinearTerm) together:
///     rate += (diffusion x Laplacian - damping x field - damping_along_axis x n (n . field)) / divisor,   n the axis.
struct LinearTerms {
  std::string owner;  ///< instance that declared the first, "physics.flow"
  std::string field;
  std::string rate;
  std::string divisor;  ///< empty: none
  double usual_divisor = 1.0;
  LinearCoefficient diffusion, damping, damping_along_axis;
  std::string axis = {};  ///< empty: none

  [[nodiscard]] bool damps() const { return damping.any() || damping_along_axis.any(); }
  /// The fields that the coefficients depend on.
  [[nodiscard]] std::vector<std::string> fields() const;
};

/// Those that an instance of a plugin declared are added to all others. Throws an Error(bad_case) that names the field
/// if terms differ in their divisor.
MESOGEN_EXPORT void add_linear_terms(const std::string& instance, const PassList& passes,
                                     std::vector<LinearTerms>& all);

/// Can stabilised steps take them into account? The framework must advance the field and make its Laplacian.
MESOGEN_EXPORT bool can_be_staged(const LinearTerms& terms, const Catalogue& catalogue);

/// As loops take them. `times`: of the coefficients; `view`: of a field, by its name.
template <class Real, class View>
exec::LinearCoefficients<Real> linear_coefficients(const LinearTerms& terms, double times, const View& view) {
  exec::LinearCoefficients<Real> all{};
  if (!terms.divisor.empty()) all.divisor = view(terms.divisor);
  if (!terms.axis.empty()) all.axis = view(terms.axis);
  const auto scaled = [&](const LinearCoefficient& one) {
    exec::ScaledCoefficient<Real> coefficient{Real(times * one.number), {}, Real(one.usual_scale)};
    if (!one.scale.empty()) coefficient.scale = view(one.scale);
    return coefficient;
  };
  all.diffusion = scaled(terms.diffusion);
  all.damping = scaled(terms.damping);
  all.damping_along_axis = scaled(terms.damping_along_axis);
  return all;
}

/// The pass that adds them to the rate.
Pass linear_pass(const LinearTerms& terms, const Catalogue& catalogue, const Backend& backend);

}  // namespace mesogen
