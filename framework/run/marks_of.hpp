#pragma once

#include "mesogen/export.hpp"
#include "run/setup.hpp"
#include "time/marks.hpp"

namespace mesogen {

/// The marks of a run of this case. Its readers are the observers in order, then the output.
MESOGEN_EXPORT Marks marks_of(const Setup& setup);

}  // namespace mesogen
