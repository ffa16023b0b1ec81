#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "case/case.hpp"
#include "case/problems.hpp"
#include "mesogen/export.hpp"
#include "run/setup.hpp"
#include "time/marks.hpp"

/// What of its case may change while a run goes on: keys with which the run so far is a run of the changed case as
/// well. Everything else needs a branch.
namespace mesogen {

/// Their names: "time.end", ...
MESOGEN_EXPORT const std::vector<std::string>& resumable_keys();

/// Adds a problem for each override ("key=value") of another key. `folder`: of the run, for the message.
MESOGEN_EXPORT void check_resumed_keys(const std::vector<std::string>& changes, const std::string& folder,
                                       Problems& problems);

/// Adds a problem for each change that the run, which has come so far, contradicts.
MESOGEN_EXPORT void check_resumed_values(const Case& before, const Case& after, const Arrival& now, Problems& problems);

/// Does what the case prescribes depend on the time, and so on how long the run is?
[[nodiscard]] bool depends_on_end(const Setup& setup);

/// Adds a problem for each prescribed number that gets larger in the longer run than in that which began.
void check_resumed_values(const Setup& before, const Setup& after, const std::string& folder, Problems& problems);

/// A resolved case without those keys: the same text, the same run so far.
MESOGEN_EXPORT std::string without_resumable_keys(std::string_view resolved_text);

}  // namespace mesogen
