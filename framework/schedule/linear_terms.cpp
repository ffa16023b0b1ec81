#include "schedule/linear_terms.hpp"

#include <algorithm>
#include <cmath>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "mesogen/plugin/context.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

template <class Real>
void add(const PassContext& context, const Backend& backend, const LinearTerms& terms, int components) {
  exec::LinearArguments<Real> arguments{};
  arguments.linear =
      linear_coefficients<Real>(terms, 1.0, [&](const std::string& field) { return context.read<Real>(field); });
  arguments.value = context.read<Real>(terms.field);
  if (terms.diffusion.any()) arguments.laplacian = context.read<Real>(terms.field + "_laplacian");
  arguments.rate = context.write<Real>(terms.rate);
  arguments.components = components;
  backend.fields<Real>().add_linear(arguments, context.count());
}

LinearCoefficient& coefficient_of(LinearTerms& terms, const LinearTerm& term) {
  if (term.kind == LinearTerm::Kind::diffusion) return terms.diffusion;
  return term.axis.empty() ? terms.damping : terms.damping_along_axis;
}

/// Adds a term to those of its kind.
void join(LinearTerms& all, const LinearTerm& term, const std::string& instance) {
  LinearCoefficient& sum = coefficient_of(all, term);
  if (!sum.any()) {
    sum = {term.coefficient, term.scale, term.usual_scale};
    if (!term.axis.empty()) all.axis = term.axis;
    return;
  }
  if (sum.scale != term.scale || (!term.axis.empty() && term.axis != all.axis))
    throw Error(ExitCode::bad_case, all.owner + " and " + instance + " both " +
                                        (term.kind == LinearTerm::Kind::diffusion ? "diffuse" : "damp") + " '" +
                                        term.field +
                                        "', and vary in different ways: remove one of them, or give both one number");
  sum.number += term.coefficient * (sum.usual_scale / term.usual_scale);
}

}  // namespace

std::vector<std::string> LinearTerms::fields() const {
  std::vector<std::string> all;
  for (const std::string& name : {divisor, axis, diffusion.scale, damping.scale, damping_along_axis.scale})
    if (!name.empty()) all.push_back(name);
  return all;
}

void add_linear_terms(const std::string& instance, const PassList& passes, std::vector<LinearTerms>& all) {
  for (const LinearTerm& term : passes.linear_terms()) {
    if (!(term.coefficient >= 0.0) || !std::isfinite(term.coefficient))
      throw Error(ExitCode::plugin_refused, instance + " declares a linear term of '" + term.field +
                                                "' with coefficient " + rounded_text(term.coefficient) +
                                                ": it must be at least 0");
    if (term.coefficient == 0.0) continue;
    auto at = std::ranges::find_if(
        all, [&](const LinearTerms& one) { return one.field == term.field && one.rate == term.rate; });
    if (at == all.end()) {
      all.push_back({instance, term.field, term.rate, term.divisor, term.usual_divisor, {}, {}, {}});
      at = all.end() - 1;
    }
    if (at->divisor != term.divisor)
      throw Error(ExitCode::bad_case, at->owner + " and " + instance + " divide the linear terms of '" + term.field +
                                          "' by '" + at->divisor + "' and by '" + term.divisor +
                                          "': remove one of the plugins");
    join(*at, term, instance);
  }
}

bool can_be_staged(const LinearTerms& terms, const Catalogue& catalogue) {
  const Catalogue::Entry* const entry = catalogue.find(terms.field);
  return entry != nullptr && terms.usual_divisor > 0.0 && has_rate(entry->declaration.advance) &&
         entry->declaration.rate == terms.rate && catalogue.find(terms.field + "_laplacian") == nullptr;
}

Pass linear_pass(const LinearTerms& terms, const Catalogue& catalogue, const Backend& backend) {
  Pass pass;
  pass.name = !terms.damps()           ? "diffusion of " + terms.field
              : !terms.diffusion.any() ? "damping of " + terms.field
                                       : "diffusion and damping of " + terms.field;
  pass.reads({terms.field}).accumulates({terms.rate});
  if (!terms.damps()) pass.conserves_momentum();
  if (terms.diffusion.any()) pass.reads({terms.field + "_laplacian"});
  for (const std::string& field : terms.fields()) pass.reads({field});
  const int components = catalogue.components(terms.field);
  pass.run([=, &backend](const PassContext& context) {
    dispatch(context.scene().precision, [&]<class Real>() { add<Real>(context, backend, terms, components); });
  });
  return pass;
}

}  // namespace mesogen
