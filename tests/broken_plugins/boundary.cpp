// A boundary that breaks one promise, which a definition names.
#include "mesogen/plugin/boundary.hpp"

#include <limits>
#include <stdexcept>

#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class Misbehaving final : public Boundary {
 public:
  [[nodiscard]] bool wraps(int axis) const override { return axis == 0; }

  void keep_inside(const Scene&, double*, std::int32_t*) const override {
#ifdef KEEP_INSIDE
    throw std::runtime_error("nobody expects this");
#endif
  }
  void copies(const Scene&, const double* const*, Index, double, Copies& out) const override {
#ifdef COPIES
    throw 42;
#endif
    out = {};
#if defined(BOTH) || defined(NO_OFFSET) || defined(NO_SOURCE)
    out.source.push_back(0);
    out.offset.push_back({0.0, 1.0, 0.0});
#endif
#ifdef NO_OFFSET
    out.offset.clear();
#endif
#ifdef NO_SOURCE
    out.source[0] = -1;
#endif
  }
  void dummies(const Scene& scene, double, Dummies& out) const override {
    out.position.push_back({0.25, -0.01, 0.0});
    out.mirror.push_back({0.25, 0.01, 0.0});
#ifdef DUMMY_INSIDE
    out.position[0][1] = 0.125 * scene.box[1];
#endif
#ifdef MIRROR_ASTRAY
    out.mirror[0][1] = 1e300;
#endif
#ifdef DUMMY_NOWHERE
    out.position[0][0] = std::numeric_limits<double>::quiet_NaN();
#endif
#ifdef NO_MIRROR
    out.mirror.clear();
#endif
    (void)scene;
  }
  void extend(const Scene&, std::string_view, int, const Dummies&, std::vector<Extension>& rules) const override {
#ifdef RULES_LOST
    rules.clear();
#endif
#ifdef RULE_NOT_FINITE
    rules[0].factor = std::numeric_limits<double>::infinity();
#endif
    (void)rules;
#ifdef EXTEND
    throw std::out_of_range("no such field");
#endif
  }
};

}  // namespace

MESOGEN_BOUNDARY_PLUGIN(Misbehaving, NAME, "1.0.0", "Breaks a promise")
