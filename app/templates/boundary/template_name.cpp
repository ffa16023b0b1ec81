// A periodic box that shows both ways to let it go on beyond its faces: along x the cell grid itself continues on the
// other side; along y, particles near a face are copied beyond the opposite one.

#include "mesogen/domain/periodic.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class TemplateNamePlugin final : public Boundary {
 public:
  [[nodiscard]] bool wraps(int axis) const override { return axis == 0; }

  // A particle that left comes back in on the other side; `images` counts the boxes that it crossed.
  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override {
    for (int d = 0; d < scene.dimension; ++d)
      wrap_into_box(scene.box[static_cast<unsigned>(d)], position[d], images[d]);
  }

  // One loop in the order of the particles, so the copies do not depend on the number of threads.
  void copies(const Scene& scene, const double* const* position, Index count, double reach,
              Copies& out) const override {
    out.source.clear();
    out.offset.clear();
    const double height = scene.box[1];
    for (Index i = 0; i < count; ++i) {
      if (position[1][i] < reach) add(out, i, height);
      if (position[1][i] >= height - reach) add(out, i, -height);
    }
  }

 private:
  static void add(Copies& out, Index source, double above) {
    out.source.push_back(source);
    out.offset.push_back({0.0, above, 0.0});
  }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(TemplateNamePlugin, "template_name", "1.0.0", "Periodic box: wrapped along x, copies along y")
