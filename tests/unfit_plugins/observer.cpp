#include <omp.h>

#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

class Unfit final : public Observer {
 public:
  void parameters(ParameterList& list) override {
    list.text("fault", fault_)
        .choices({"none", "undeclared", "unplanned", "missing", "rows", "leftover", "threads", "order", "memory",
                  "nothing", "no_doc", "twins"})
        .doc("what is wrong");
  }

  void plan(const Scene&, ObserverPlan& plan) override {
    plan.reads("density");
    if (fault_ == "nothing") return;
    auto& quantity = plan.scalar("first");
    if (fault_ != "no_doc") quantity.doc("density of particle 0");
    plan.table("pair", 2).doc("two numbers");
    if (fault_ == "memory") plan.follow_every_step();
    if (fault_ == "twins") plan.scalar("first").doc("again");
  }

  // What start() finds comes back by itself in a resumed run; what is gathered since then does not.
  void start(const ObserverContext&) override { gathered_ = 1.0; }
  void follow(const ObserverContext&) override { gathered_ += 1.0; }

  void sample(const ObserverContext& context, Sample& sample) override {
    if (fault_ == "undeclared") (void)context.values("velocity", 0);
    if (fault_ == "unplanned") sample.set("second", 1.0);
    const auto density = context.values("density");
    std::size_t place = 0;
    while (fault_ != "order" && context.id()[place] != 0) ++place;
    double first = density[place];
    if (fault_ == "leftover") first += samples_;
    if (fault_ == "threads") first += omp_get_max_threads();
    if (fault_ == "memory") first += gathered_;
    ++samples_;
    if (fault_ != "missing") sample.set("first", first);
    sample.set("pair", fault_ == "rows" ? std::vector<double>{1.0, 2.0, 3.0} : std::vector<double>{1.0, 2.0});
  }

 private:
  std::string fault_ = "none";
  double gathered_ = 0.0;
  static inline int samples_ = 0;
};

}  // namespace

MESOGEN_OBSERVER_PLUGIN(Unfit, "unfit_observer", "1.0.0", "Wrong on purpose")
