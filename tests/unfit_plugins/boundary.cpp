#include <omp.h>

#include <algorithm>

#include "mesogen/domain/periodic.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// Copies beyond all faces, unless there is a fault.
class Unfit final : public Boundary {
 public:
  void parameters(ParameterList& list) override {
    list.text("fault", fault_)
        .choices({"none", "lost", "uncounted", "restless", "corners", "twice", "inside", "carry_over", "threads"})
        .doc("what is wrong");
  }
  [[nodiscard]] bool wraps(int) const override { return false; }

  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override {
    if (fault_ == "lost") return;
    for (int d = 0; d < scene.dimension; ++d) {
      std::int32_t crossed = 0;
      wrap_into_box(scene.box[static_cast<unsigned>(d)], position[d], crossed);
      if (fault_ != "uncounted") images[d] += crossed;
      if (fault_ == "restless" && position[d] > 0.25 && position[d] < 0.75) position[d] = 1.0 - position[d] * 0.9;
    }
  }

  void copies(const Scene& scene, const double* const* position, Index count, double reach,
              Copies& out) const override {
    out.source.clear();
    out.offset.clear();
    for (Index i = 0; i < count; ++i)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          if (x == 0 && y == 0) continue;
          if (fault_ == "corners" && x != 0 && y != 0) continue;
          const double at_x = position[0][i] + x * scene.box[0];
          const double at_y = position[1][i] + y * scene.box[1];
          if (at_x < -reach || at_x >= scene.box[0] + reach || at_y < -reach || at_y >= scene.box[1] + reach) continue;
          const double factor = fault_ == "inside" ? 0.5 : 1.0;
          for (int n = 0; n < (fault_ == "twice" ? 2 : 1); ++n) {
            out.source.push_back(i);
            out.offset.push_back({x * factor * scene.box[0], y * factor * scene.box[1], 0.0});
          }
        }
    if (fault_ == "threads" && omp_get_max_threads() > 1) {
      std::reverse(out.source.begin(), out.source.end());
      std::reverse(out.offset.begin(), out.offset.end());
    }
  }

  void carry_over(const Scene&, std::string_view, int, const Copies&, std::vector<Extension>& rules) const override {
    for (Extension& rule : rules) rule.factor = fault_ == "carry_over" ? 2.0 : 1.0;
  }

 private:
  std::string fault_ = "none";
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(Unfit, "unfit_boundary", "1.0.0", "Wrong on purpose")
