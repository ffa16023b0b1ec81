#include "mesogen/domain/periodic.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// Periodic box without copies: the cell grid itself continues on the other side, so a pair across a face is found as
/// its nearest image.
class PeriodicWrap final : public Boundary {
 public:
  [[nodiscard]] bool wraps(int) const override { return true; }

  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override {
    for (int d = 0; d < scene.dimension; ++d)
      wrap_into_box(scene.box[static_cast<unsigned>(d)], position[d], images[d]);
  }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(PeriodicWrap, "periodic_wrap", "1.0.0", "Periodic box, nearest images, no copies")
