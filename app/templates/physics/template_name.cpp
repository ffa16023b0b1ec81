// A uniform force F on the fluid along x, such as that of a pressure gradient: Du/Dt = ... + F / rho.

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// What is done at particle i, on host and device.
template <class Real>
struct AddForce {
  FieldView<const Real> density;
  FieldView<Real> acceleration;
  Real force;

  MESOGEN_HOST_DEVICE void operator()(Index i) const { acceleration(0, i) += force / density(i); }
};

// In any dimension; a term of two dimensions alone is a `template <class Real, int Dim> requires(Dim == 2) class`.
template <class Real, int Dim>
class TemplateNamePlugin final : public Physics {
 public:
  // Keys of its section in a case, checked before a run: unit, range, and a default or required().
  void parameters(ParameterList& list) override {
    list.number("force", force_).unit("N/m3").required().doc("F: force per volume along x");
  }

  // All fields that the pass touches. More of them: `mesogen plugin info wcsph`, and X_gradient, X_laplacian of each X.
  void declare(const Scene&, PassList& list) override {
    list.pass("template_name").reads({"density"}).accumulates({"acceleration"}).run([this](const PassContext& context) {
      exec::for_each(context.space(), context.count(),
                     AddForce<Real>{context.read<Real>("density"), context.write<Real>("acceleration"), Real(force_)});
    });
  }

  // A force that grows with velocity or gradients limits the step: list.step_limit(), see plugins/physics/friction.
  // What other plugins should know goes into publish().
  //
  // Fields that are advanced in time are saved in checkpoints. Numbers of its own that a pass changes, and needs again
  // at the next step, are saved if declare() names them; otherwise a resumed run begins without them:
  //
  //     std::vector<double> memory_ = {0.0};
  //     list.keep("memory", 1, [this] { return std::span(memory_); });    // and .advances_what_is_kept() of that pass

 private:
  double force_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(TemplateNamePlugin, "template_name", "1.0.0", "Uniform force on the fluid along x")
