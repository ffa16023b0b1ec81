// A force that is none. See crash.hpp.
#include "crash.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

const struct Loaded {
  Loaded() { crash::in("loading"); }
} loaded;

template <class Real, int Dim>
class Crashing final : public Physics {
 public:
  Crashing() { crash::in("constructor"); }
  ~Crashing() override { crash::in("destructor"); }
  void parameters(ParameterList& list) override {
    crash::in("parameters()");
    list.number("after", after_).unit("s").at_least(0.0).doc("crashes only from this time on");
  }
  void publish(Scene&) const override { crash::in("publish()"); }
  void declare(const Scene&, PassList& list) override {
    crash::in("declare()");
    list.step_limit(StepCause::other, "crash", [](const Scene&) {
      crash::in("step limit");
      return 1.0;
    });
    list.advice([](const AdviceContext&, std::vector<Suggestion>&) { crash::in("advice"); });
    list.numbers([](const Scene&, std::vector<SceneNumber>&) { crash::in("numbers"); });
    list.pass("work").reads({"velocity"}).accumulates({"acceleration"}).run([this](const PassContext& context) {
      if (context.time() < after_) return;
      crash::in("pass");
      // In whichever threads come to it.
      exec::for_each(context.space(), context.count(), [](Index) { crash::in("particle"); });
    });
  }

 private:
  double after_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Crashing, "crashing", "1.0.0", "Crashes when it is told to")
