// Remembers where it started, as the first of observers would, and does not save it. See crash.hpp.
#include <memory>

#include "crash.hpp"
#include "mesogen/plugin/by_id.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class Crashing final : public Observer {
 public:
  Crashing() { crash::in("constructor"); }
  ~Crashing() override { crash::in("destructor"); }
  void parameters(ParameterList&) override { crash::in("parameters()"); }
  void plan(const Scene&, ObserverPlan& plan) override {
    crash::in("plan()");
    plan.reads("velocity");
    plan.scalar("moved").unit("m").doc("how far particle 0 has come since the start, along x");
    if (crash::asked("CRASH_IN") == "follow()") plan.follow_every_step();
  }
  void start(const ObserverContext& context) override {
    crash::in("start()");
    first_ = std::make_unique<double>(where(context));
  }
  void follow(const ObserverContext&) override { crash::in("follow()"); }
  void sample(const ObserverContext& context, Sample& sample) override {
    crash::in("sample()");
    sample.set("moved", where(context) - *first_);
  }
  [[nodiscard]] std::map<std::string, std::vector<double>> save() const override {
    crash::in("save()");
    return {};
  }
  void restore(const std::map<std::string, std::vector<double>>&) override { crash::in("restore()"); }

 private:
  static double where(const ObserverContext& context) {
    Index place = 0;
    while (context.id()[static_cast<std::size_t>(place)] != 0) ++place;
    return context.unwrapped_at(0, {&place, 1}).front();
  }

  std::unique_ptr<double> first_;
};

}  // namespace

MESOGEN_OBSERVER_PLUGIN(Crashing, "crashing", "1.0.0", "Crashes when it is told to")
