// A boundary plugin that has no form for any scene.
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {
void* create_nothing(mesogen::Precision, int) { return nullptr; }
}  // namespace

MESOGEN_PLUGIN_(boundary, "no_form", "1.0.0", "A boundary without a form", mesogen::DimensionSet{2}, &create_nothing)
