#include <omp.h>

#include <limits>

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dim>
class Unfit final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.text("fault", fault_)
        .choices({"none", "undeclared_read", "undeclared_write", "optional", "not_finite", "leftover", "threads",
                  "overflow", "limit", "memory", "nameless", "no_body", "no_doc", "twins", "idle", "adds_constant",
                  "adds_stress"})
        .doc("what is wrong");
  }

  void publish(Scene& scene) const override {
    if (fault_ == "adds_constant") scene.constants["unfit"] += 1.0;
    if (fault_ == "adds_stress") scene.scales.stress += 1.0;
  }

  void declare(const Scene&, PassList& list) override {
    auto& field = list.field("unfit", Rank::scalar).unit("m");
    if (fault_ != "no_doc") field.doc("made by the unfit plugin");
    auto& pass = list.pass("work").reads({"density"}).reads_if_present({"colour"});
    if (fault_ != "idle") pass.writes({"unfit"});
    if (fault_ == "twins") list.pass("work").accumulates({"acceleration"}).run([](const PassContext&) {});
    if (fault_ != "no_body") pass.run([this](const PassContext& context) { work(context); });
    list.step_limit(StepCause::other, fault_ == "nameless" ? "" : "nothing",
                    [this](const Scene&) { return fault_ == "limit" ? -1.0 : 1.0; });
  }

 private:
  void work(const PassContext& context) {
    if (fault_ == "undeclared_read") (void)context.read<Real>("velocity");
    if (fault_ == "undeclared_write") (void)context.write<Real>("density");
    if (fault_ == "optional" && context.has("colour")) (void)context.write<Real>("colour");
    const auto density = context.read<Real>("density");
    const auto unfit = context.write<Real>("unfit");
    for (Index i = 0; i < context.count(); ++i) {
      Real value = density(i);
      if (fault_ == "not_finite" && context.id()[i] == 17) value = std::numeric_limits<Real>::quiet_NaN();
      if (fault_ == "leftover") value += Real(runs_);
      if (fault_ == "threads") value += Real(omp_get_max_threads());
      if (fault_ == "memory") value += Real(own_runs_);
      if (fault_ == "overflow") value *= Real(1e30) * Real(1e30);
      unfit(i) = value;
    }
    ++runs_;
    ++own_runs_;
  }

  std::string fault_ = "none";
  static inline int runs_ = 0;
  int own_runs_ = 0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Unfit, "unfit_physics", "1.0.0", "Wrong on purpose")
