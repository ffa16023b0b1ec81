// A dissolved substance that the fluid carries, such as the fuel of motors:
//
//   Dc/Dt = D lap c + s - k c.
//
// It is carried exactly, because particles move with the fluid; walls let none through. Expressions of other numbers
// may use it by its name: activity = "0.1 * solute".

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

template <class Real>
struct AddSource {
  FieldView<Real> rate;
  Varying<Real> source;

  MESOGEN_HOST_DEVICE void operator()(Index i) const { rate(i) += source(i); }
};

template <class Real, int Dim>
class Solute final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.number("diffusivity", diffusivity_).unit("m2/s").at_least(0).required().doc("D: diffusivity");
    list.number("source", source_)
        .unit("1/s")
        .may_vary("solute_source")
        .doc(
            "s: what is added per time; below 0 what is taken. It may depend on the solute itself: \"0.1 * (1 - "
            "solute)\"");
    list.number("decay", decay_).unit("1/s").at_least(0).may_vary("solute_decay").doc("k: share that decays per time");
    list.number_or("largest", largest_, "auto")
        .above(0)
        .doc(
            "how much of it there will be at most, for limits on the step by numbers that depend on it; auto: as at "
            "the "
            "start, or source / decay if that is more; needed where a source is not held by a decay that is a number");
  }

  // Of a source and a decay that are the same everywhere no more than their ratio is reached. What is fed without that
  // grows by no rule that could be known here.
  void publish(Scene& scene) const override {
    const bool unknown = source_ > 0.0 && (!(decay_ > 0.0) || scene.varying.contains("solute_decay"));
    const double balance = source_ > 0.0 ? source_ / decay_ : 0.0;
    const double expected =
        unknown ? std::numeric_limits<double>::infinity() : std::max(balance, scene.initial_extent("solute").largest);
    scene.constants["solute_largest"] = largest_.value_or(expected);
  }

  void declare(const Scene& scene, PassList& list) override {
    list.field("solute", Rank::scalar)
        .doc("c: concentration, in units of your choice")
        .predicted_by("solute_rate")
        .shown();
    list.field("solute_rate", Rank::scalar).unit("1/s").doc("Dc/Dt");
    list.diffusion("solute", "solute_rate", diffusivity_, StepCause::other, "diffusion of the solute");
    LinearTerm& decay =
        list.damping("solute", "solute_rate", decay_, StepCause::other, "decay of the solute: 0.25 / k");
    if (scene.varying.contains("solute_decay")) decay.varies_with("solute_decay", decay_);
    list.pass("source of the solute")
        .reads_if_present({"solute_source"})
        .accumulates({"solute_rate"})
        .idle_if(source_ == 0.0 && !scene.varying.contains("solute_source"))
        .run([this](const PassContext& context) {
          exec::for_each(
              context.space(), context.count(),
              AddSource<Real>{context.write<Real>("solute_rate"), context.varying<Real>("solute_source", source_)});
        });
  }

 private:
  double diffusivity_ = 0.0;
  double source_ = 0.0;
  double decay_ = 0.0;
  std::optional<double> largest_;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Solute, "solute", "1.0.0",
                       "Dissolved substance that the fluid carries: diffuses, decays, is fed")
