// Friction with a substrate that has a direction, such as a smectic liquid crystal under an active nematic (Guillamat,
// Ignes-Mullol, Sagues, PNAS 113, 5498 (2016)): a force density
//
//   f = -xi_along n (n . u) - xi_across (u - n (n . u)),   n the easy axis of the substrate or the director.
//
// The smaller of the two acts on the whole velocity, the rest on the part along the axis that is held more. Both are
// declared as damping, so that stabilised steps take them however strong they are.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// The director, or with `across` the axis at right angles to it. (Q11, Q12) = q (cos 2 theta, sin 2 theta).
template <class Real>
struct AxisOfDirector {
  FieldView<const Real> order_tensor;
  FieldView<Real> axis;
  bool across;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real q11 = order_tensor(0, i);
    const Real q12 = order_tensor(1, i);
    const Real order = std::sqrt(q11 * q11 + q12 * q12);
    if (!(order > Real(0))) {
      axis(0, i) = across ? Real(0) : Real(1);
      axis(1, i) = across ? Real(1) : Real(0);
      return;
    }
    // The larger component from the cosine of the double angle, the other from its sine: both keep their digits.
    const Real larger = std::sqrt((order + std::fabs(q11)) / (Real(2) * order));
    const Real smaller = q12 / (Real(2) * order * larger);
    const Real x = q11 > Real(0) ? larger : smaller;
    const Real y = q11 > Real(0) ? smaller : larger;
    axis(0, i) = across ? -y : x;
    axis(1, i) = across ? x : y;
  }
};

template <class Real>
struct FixedAxis {
  FieldView<Real> axis;
  Real x, y;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    axis(0, i) = x;
    axis(1, i) = y;
  }
};

template <class Real, int Dim>
requires(Dim == 2) class AnisotropicFriction final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.number("along", along_)
        .unit("kg/(m3 s)")
        .at_least(0)
        .required()
        .doc("force density per velocity along the axis");
    list.number("across", across_).unit("kg/(m3 s)").at_least(0).required().doc("the same at right angles to it");
    list.word_or_number("axis", axis_, {"director"})
        .unit("degrees")
        .required()
        .doc("angle of the axis against x, or \"director\": that of the nematic at each place");
  }

  void publish(Scene& scene) const override {
    scene.constants["friction_along"] = along_;
    scene.constants["friction_across"] = across_;
    // What holds every flow. Another plugin's friction comes on top.
    scene.constants.emplace("friction", std::min(along_, across_));
  }

  void declare(const Scene& scene, PassList& list) override {
    if (!scene.constants.contains("density"))
      throw Error(ExitCode::bad_case,
                  "anisotropic_friction needs a flow: add a [physics.*] section with type = \"wcsph\"");
    const double density = scene.constant("density");
    const double larger = std::max(along_, across_);
    if (!scene.stabilised_steps && larger > 0.0)
      list.step_limit(StepCause::friction, "0.25 rho / xi of the larger friction",
                      [=](const Scene&) { return 0.25 * density / larger; });
    // The limit is of the two together.
    const auto damp = [&](double coefficient) -> LinearTerm& {
      return list.damping("velocity", "acceleration", coefficient, StepCause::friction, "")
          .divided_by("density", density)
          .takes_any_step(true);
    };
    damp(std::min(along_, across_));
    damp(std::abs(along_ - across_)).along("friction_axis");
    if (along_ == across_) return;
    list.field("friction_axis", Rank::vector).doc("unit vector along which friction is larger");
    Pass& pass = list.pass("axis of friction").writes({"friction_axis"});
    const bool across = across_ > along_;
    if (axis_.word == "director") {
      pass.reads({"order_tensor"}).run([across](const PassContext& context) {
        exec::for_each(
            context.space(), context.count(),
            AxisOfDirector<Real>{context.read<Real>("order_tensor"), context.write<Real>("friction_axis"), across});
      });
      return;
    }
    const double angle = axis_.number * std::numbers::pi / 180.0 + (across ? std::numbers::pi / 2.0 : 0.0);
    pass.run([angle](const PassContext& context) {
      exec::for_each(
          context.space(), context.count(),
          FixedAxis<Real>{context.write<Real>("friction_axis"), Real(std::cos(angle)), Real(std::sin(angle))});
    });
  }

 private:
  double along_ = 0.0;
  double across_ = 0.0;
  WordOrNumber axis_;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(AnisotropicFriction, "anisotropic_friction", "1.0.0",
                       "Friction with a substrate that is easier along one axis")
