#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// Periodic box with ghosts: particles near a face are repeated beyond the opposite one, those near an edge or corner
/// once for each of its faces and their combinations.
class PeriodicGhosts final : public Boundary {
 public:
  [[nodiscard]] Continuation continuation(int) const override { return Continuation::ghosts; }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(PeriodicGhosts, "periodic_ghosts", "1.0.0", "Periodic box, ghosts beyond each face")
