#include <omp.h>

#include <limits>

#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class Unfit final : public Initial {
 public:
  void parameters(ParameterList& list) override {
    list.text("fault", fault_)
        .choices({"none", "not_finite", "leftover", "threads", "no_doc", "nothing", "twins", "derived", "position",
                  "undeclared", "component"})
        .doc("what is wrong");
  }

  void plan(InitialPlan& plan) const override {
    if (fault_ == "nothing") return;
    auto& field = plan.sets("heat", Rank::scalar).unit("K");
    if (fault_ != "no_doc") field.doc("temperature");
    if (fault_ == "twins") plan.sets("heat", Rank::scalar).doc("again");
    if (fault_ == "derived") plan.sets("heat_laplacian", Rank::scalar).doc("what the framework makes");
    if (fault_ == "position") plan.sets("position", Rank::vector).doc("where the particles are");
  }

  void set(InitialState& state) const override {
    if (fault_ == "nothing") return;
    if (fault_ == "undeclared") (void)state.component("cold");
    if (fault_ == "component") (void)state.component("heat", 1);
    const auto heat = state.component("heat");
    for (double& value : heat) {
      value = 1.0;
      if (fault_ == "leftover") value += sets_;
      if (fault_ == "threads") value += omp_get_max_threads();
    }
    if (fault_ == "not_finite") heat[17] = std::numeric_limits<double>::quiet_NaN();
    ++sets_;
  }

 private:
  std::string fault_ = "none";
  static inline int sets_ = 0;
};

}  // namespace

MESOGEN_INITIAL_PLUGIN(Unfit, "unfit_initial", "1.0.0", "Wrong on purpose")
