#pragma once

#include <string>

#include "mesogen/export.hpp"
#include "output/results_content.hpp"

namespace mesogen::output {

/// results.xdmf: tells ParaView how results.h5 is to be seen, as points at each stored time. Hyperslabs are read by its
/// "XDMF Reader" (tried with 5.11), not by its "Xdmf3 Reader".
MESOGEN_EXPORT std::string xdmf_text(const ResultsOptions& options, const ResultsContent& content);

}  // namespace mesogen::output
