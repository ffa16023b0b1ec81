// The mean speed <|u|> of the particles, and the highest that it has been.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "mesogen/exec/exact_sum.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class TemplateNamePlugin final : public Observer {
 public:
  // Without this line: in any dimension.
  static constexpr DimensionSet dimensions{2};

  // What the observer reads and records. Keys of its section in a case would be named in parameters(), as in a physics
  // plugin.
  void plan(const Scene&, ObserverPlan& plan) override {
    plan.reads("velocity");
    plan.scalar("mean_speed").unit("m/s").doc("mean of |u|");
    plan.scalar("highest").unit("m/s").doc("highest mean speed of all samples so far");
  }

  // Summed exactly: the order of storage changes during a run, but the sum must always have the same bits.
  void sample(const ObserverContext& context, Sample& sample) override {
    const FieldReader u = context.field("velocity");
    exec::ExactSum sum;
    for (Index i = 0; i < context.count(); ++i) sum.add(std::hypot(u(0, i), u(1, i)));
    const double mean = sum.value() / context.count();
    highest_ = std::max(highest_, mean);
    sample.set("mean_speed", mean);
    sample.set("highest", highest_);
  }

  // Checkpoints save what the observer gathers from sample to sample; otherwise a resumed run starts without it. An
  // observer that keeps nothing needs neither function.
  [[nodiscard]] std::map<std::string, std::vector<double>> save() const override { return {{"highest", {highest_}}}; }
  void restore(const std::map<std::string, std::vector<double>>& saved) override {
    highest_ = saved.at("highest").at(0);
  }

 private:
  double highest_ = 0.0;
};

}  // namespace

MESOGEN_OBSERVER_PLUGIN(TemplateNamePlugin, "template_name", "1.0.0", "Mean speed of the particles, and its highest")
