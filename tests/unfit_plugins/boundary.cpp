#include <atomic>

#include "mesogen/particles/periodic.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// Ghosts beyond all faces, unless there is a fault.
class Unfit final : public Boundary {
 public:
  void parameters(ParameterList& list) override {
    list.text("fault", fault_)
        .choices({"none", "lost", "uncounted", "restless", "missing", "twice", "rule", "again"})
        .doc("what is wrong");
  }
  [[nodiscard]] Continuation continuation(int axis) const override {
    return fault_ == "missing" && axis == 1 ? Continuation::none : Continuation::ghosts;
  }

  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override {
    if (fault_ == "lost") return;
    for (int d = 0; d < scene.dimension; ++d) {
      std::int32_t crossed = 0;
      wrap_into_box(scene.box[static_cast<unsigned>(d)], position[d], crossed);
      if (fault_ != "uncounted") images[d] += crossed;
      if (fault_ == "restless" && position[d] > 0.25 && position[d] < 0.75) position[d] = 1.0 - position[d] * 0.9;
    }
  }

  /// A wall particle where a fluid particle is.
  [[nodiscard]] std::vector<WallParticle> wall_particles(const Scene& scene, double) const override {
    if (fault_ != "twice") return {};
    const double at = scene.spacing / 2.0;
    return {{.position = {at, at, 0.0}, .mirror = {at, 3.0 * at, 0.0}, .normal = {0.0, 1.0, 0.0}}};
  }

  [[nodiscard]] AffineRule ghost_rule(const Scene&, const FieldKind& field, const std::array<int, 3>&) const override {
    AffineRule rule(field);
    if (fault_ == "rule") rule.matrix(0, 0) = 2.0;
    static std::atomic<int> asked = 0;
    if (fault_ == "again" && field.rank == Rank::vector) rule.summand(0) = 0.001 * ++asked;
    return rule;
  }

 private:
  std::string fault_ = "none";
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(Unfit, "unfit_boundary", "1.0.0", "Wrong on purpose")
