#pragma once

#include <vector>

#include "mesogen/plugin/advice.hpp"

/// Advice about nematics, for PassList::advice. Each function appends to `list` what it finds.
namespace mesogen::nematics {

/// Advice if the particles resolve the cores of defects too coarsely or more finely than needed.
void advise_on_cores(const AdviceContext& context, std::vector<Suggestion>& list);

/// Advice if the order does not last. The context's section is the nematic's, with the keys bulk.A and bulk.C.
void advise_on_order(const AdviceContext& context, std::vector<Suggestion>& list);

/// Advice if the activity is too low for the instability in this box. The context's section has the key activity.
void advise_on_activity(const AdviceContext& context, std::vector<Suggestion>& list);

}  // namespace mesogen::nematics
