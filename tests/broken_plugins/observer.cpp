// An observer that breaks one promise: which, says its parameter `misdeed`.
#include "mesogen/plugin/observer.hpp"

#include <stdexcept>
#include <string>

#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class Misbehaving final : public Observer {
 public:
  void parameters(ParameterList& list) override {
    list.text("misdeed", misdeed_).required().doc("what to do wrong");
    if (declares_interval) list.number("interval", interval_);
  }
  void plan(const Scene&, ObserverPlan& plan) override {
    if (misdeed_ == "plan throws") throw std::runtime_error("no plan");
    plan.reads("velocity");
    plan.scalar("nothing");
    plan.follow_every_step();
  }
  void start(const ObserverContext&) override {
    if (misdeed_ == "start throws") throw std::runtime_error("not yet");
  }
  void sample(const ObserverContext& context, Sample& sample) override {
    if (misdeed_ == "reads undeclared") (void)context.values("density");
    if (misdeed_ == "sample throws" && context.step() > 1) throw 42;
    sample.set("nothing", 0.0);
  }
  void follow(const ObserverContext&) override {
    if (misdeed_ == "follow throws") throw std::runtime_error("lost");
  }

 private:
#ifdef DECLARE_INTERVAL
  static constexpr bool declares_interval = true;
#else
  static constexpr bool declares_interval = false;
#endif
  std::string misdeed_;
  double interval_ = 1.0;
};

}  // namespace

#ifndef NAME
#define NAME "misbehaving"
#endif

MESOGEN_OBSERVER_PLUGIN(Misbehaving, NAME, "1.0.0", "Breaks a promise")
