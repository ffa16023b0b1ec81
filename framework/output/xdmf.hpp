#pragma once

#include <string>

#include "mesogen/export.hpp"
#include "output/results_content.hpp"
#include "output/results_file.hpp"

namespace mesogen::output {

/// results.xdmf: tells ParaView what results.h5 and its frames hold: the particles as points at each stored time, and
/// the edges of the box. Both of its readers open it, "XDMF Reader" and "Xdmf3 Reader" (tried with 5.11).
MESOGEN_EXPORT std::string xdmf_text(const ResultsOptions& options, const ResultsContent& content, Layout layout);

}  // namespace mesogen::output
