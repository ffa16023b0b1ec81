#pragma once

#include <vector>

#include "mesogen/plugin/advice.hpp"

/// Advice about nematics, for PassList::advice.
namespace mesogen::nematics {

/// How well the defects' cores are resolved by the particles.
void advise_on_cores(const AdviceContext& context, std::vector<Suggestion>& list);

/// Whether the order lasts. `section` is that of the nematic, with the keys bulk.A and bulk.C.
void advise_on_order(const AdviceContext& context, std::vector<Suggestion>& list);

/// Whether the activity is above the threshold of the instability in this box. `section` has the key activity.
void advise_on_activity(const AdviceContext& context, std::vector<Suggestion>& list);

}  // namespace mesogen::nematics
