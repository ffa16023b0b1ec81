// A periodic box. See crash.hpp.
#include "crash.hpp"
#include "mesogen/domain/periodic.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class Crashing final : public Boundary {
 public:
  [[nodiscard]] bool wraps(int axis) const override {
    crash::in("wraps()");
    return axis == 0;
  }
  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override {
    crash::in("keep_inside()");
    for (int d = 0; d < scene.dimension; ++d)
      wrap_into_box(scene.box[static_cast<unsigned>(d)], position[d], images[d]);
  }
  void copies(const Scene& scene, const double* const* position, Index count, double reach,
              Copies& out) const override {
    crash::in("copies()");
    out = {};
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

MESOGEN_BOUNDARY_PLUGIN(Crashing, "crashing", "1.0.0", "Crashes when it is told to")
