// A periodic box. See crash.hpp.
#include "crash.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class Crashing final : public Boundary {
 public:
  [[nodiscard]] Continuation continuation(int axis) const override {
    crash::in("continuation()");
    return axis == 0 ? Continuation::wrapped : Continuation::ghosts;
  }
  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override {
    crash::in("keep_inside()");
    Boundary::keep_inside(scene, position, images);
  }
  [[nodiscard]] AffineRule ghost_rule(const Scene& scene, const FieldKind& field,
                                      const std::array<int, 3>& boxes) const override {
    crash::in("ghost_rule()");
    return Boundary::ghost_rule(scene, field, boxes);
  }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(Crashing, "crashing", "1.0.0", "Crashes when it is told to")
