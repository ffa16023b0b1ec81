#pragma once

#include <vector>

#include "mesogen/plugin/advice.hpp"

/// Advice about nematics, for PassList::advice. Each function appends to `list` what it finds.
namespace mesogen::nematics {

/// Advice if the particles resolve the cores of defects too coarsely or more finely than needed.
void advise_on_cores(const AdviceContext& context, std::vector<Suggestion>& list);

/// Advice if the order does not last. The section of the context is that of the nematic, with the keys bulk.A and
/// bulk.C.
void advise_on_order(const AdviceContext& context, std::vector<Suggestion>& list);

/// Advice if the activity is below the threshold of the instability in this box. The section of the context has the key
/// `activity`.
void advise_on_activity(const AdviceContext& context, std::vector<Suggestion>& list);

}  // namespace mesogen::nematics
