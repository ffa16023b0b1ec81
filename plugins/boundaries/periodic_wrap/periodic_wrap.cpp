#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// Periodic box without ghosts: the cell grid itself continues on the other side, so a pair across a face is found as
/// its nearest image.
class PeriodicWrap final : public Boundary {
 public:
  [[nodiscard]] Continuation continuation(int) const override { return Continuation::wrapped; }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(PeriodicWrap, "periodic_wrap", "1.0.0", "Periodic box, nearest images, no ghosts")
