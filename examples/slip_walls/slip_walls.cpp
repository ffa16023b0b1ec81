// Walls without friction across y, periodic along x: the fluid glides along them. Like the plugin `walls`, but the
// velocity along the wall goes on as it is and only its normal component turns round.

#include <algorithm>
#include <cmath>

#include "mesogen/domain/periodic.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class SlipWalls final : public Boundary {
 public:
  [[nodiscard]] bool periodic(int axis) const override { return axis != 1; }
  [[nodiscard]] bool wraps(int axis) const override { return axis != 1; }

  // Called for every particle now and then: those that passed a wall are reflected by it.
  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override {
    wrap_into_box(scene.box[0], position[0], images[0]);
    const double height = scene.box[1];
    if (position[1] < 0.0 && position[1] > -height) position[1] = -position[1];
    if (position[1] > height && position[1] < 2.0 * height) position[1] = 2.0 * height - position[1];
  }

  // The lattice of the particles goes on behind the walls, as far as the kernel reaches.
  void dummies(const Scene& scene, double reach, Dummies& out) const override {
    const auto columns = static_cast<int>(std::lround(scene.box[0] / scene.spacing));
    const auto layers = static_cast<int>(std::ceil(reach / scene.spacing));
    for (int layer = 0; layer < layers; ++layer)
      for (int column = 0; column < columns; ++column) {
        const double x = (column + 0.5) * scene.box[0] / columns;
        const double depth = (layer + 0.5) * scene.spacing;
        out.position.push_back({x, -depth, 0.0});
        out.mirror.push_back({x, depth, 0.0});
        out.position.push_back({x, scene.box[1] + depth, 0.0});
        out.mirror.push_back({x, scene.box[1] - depth, 0.0});
      }
  }

  // Everything has its mirror image behind the wall (the default) but the velocity through it.
  void extend(const Scene&, std::string_view field, int components, const Dummies& dummies,
              std::vector<Extension>& extension) const override {
    if (field != "velocity") return;
    for (std::size_t n = 0; n < dummies.position.size(); ++n)
      extension[n * static_cast<std::size_t>(components) + 1].factor = -1.0;
  }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(SlipWalls, "slip_walls", "1.0.0", "Walls without friction across y, periodic along x")
