#include "schedule/linear_terms.hpp"

#include <algorithm>
#include <cmath>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "mesogen/plugin/context.hpp"
#include "particles/field_loops.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

template <class Real>
void add(const PassContext& context, const Backend& backend, const LinearTerms& terms, int components) {
  exec::LinearArguments<Real> arguments{};
  arguments.value = context.read<Real>(terms.field);
  if (terms.diffusion > 0.0) arguments.laplacian = context.read<Real>(terms.field + "_laplacian");
  if (!terms.divisor.empty()) arguments.divisor = context.read<Real>(terms.divisor);
  arguments.rate = context.write<Real>(terms.rate);
  arguments.diffusion = Real(terms.diffusion);
  arguments.damping = Real(terms.damping);
  arguments.components = components;
  backend.fields<Real>().add_linear(arguments, context.count());
}

}  // namespace

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
      all.push_back({instance, term.field, term.rate, term.divisor, 0.0, 0.0, term.usual_divisor});
      at = all.end() - 1;
    }
    if (at->divisor != term.divisor)
      throw Error(ExitCode::bad_case, at->owner + " and " + instance + " divide the linear terms of '" + term.field +
                                          "' by '" + at->divisor + "' and by '" + term.divisor +
                                          "': remove one of the plugins");
    (term.kind == LinearTerm::Kind::diffusion ? at->diffusion : at->damping) += term.coefficient;
  }
}

bool can_be_staged(const LinearTerms& terms, const Catalogue& catalogue) {
  const Catalogue::Entry* const entry = catalogue.find(terms.field);
  return entry != nullptr && terms.usual_divisor > 0.0 && has_rate(entry->declaration.advance) &&
         entry->declaration.rate == terms.rate && catalogue.find(terms.field + "_laplacian") == nullptr;
}

Pass linear_pass(const LinearTerms& terms, const Catalogue& catalogue, const Backend& backend) {
  Pass pass;
  pass.name = terms.damping == 0.0     ? "diffusion of " + terms.field
              : terms.diffusion == 0.0 ? "damping of " + terms.field
                                       : "diffusion and damping of " + terms.field;
  pass.reads({terms.field}).accumulates({terms.rate});
  if (terms.damping == 0.0) pass.conserves_momentum();
  if (terms.diffusion > 0.0) pass.reads({terms.field + "_laplacian"});
  if (!terms.divisor.empty()) pass.reads({terms.divisor});
  const int components = catalogue.components(terms.field);
  pass.run([=, &backend](const PassContext& context) {
    dispatch(context.scene().precision, [&]<class Real>() { add<Real>(context, backend, terms, components); });
  });
  return pass;
}

}  // namespace mesogen
