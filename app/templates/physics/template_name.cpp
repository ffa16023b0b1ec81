// A uniform force F on the fluid along x, such as that of a pressure gradient: Du/Dt = ... + F / rho.

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

/// Work at particle i, on host and device.
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
  // Keys of the plugin's section in a case: unit, range, and a default or required(). Checked before a run.
  void parameters(ParameterList& list) override {
    list.number("force", force_).unit("N/m3").required().doc("F: force per volume along x");
  }

  // All fields that the pass uses. `mesogen plugin info wcsph` lists more; each X also has X_gradient and X_laplacian.
  void declare(const Scene&, PassList& list) override {
    list.pass("template_name").reads({"density"}).accumulates({"acceleration"}).run([this](const PassContext& context) {
      exec::for_each(context.space(), context.count(),
                     AddForce<Real>{context.read<Real>("density"), context.write<Real>("acceleration"), Real(force_)});
    });
  }

  // A force -c u, or diffusion of a field, needs no pass: list.damping() and list.diffusion(), see
  // plugins/physics/friction. Any other force that grows with velocity or gradients limits the step: list.step_limit().
  // A force between parts of the fluid, such as the divergence of a stress, is declared with .conserves_momentum().
  // What other plugins should know goes into publish().
  //
  // Checkpoints save fields that are advanced in time. If a pass changes numbers of its own and needs them at the next
  // step, declare() must name them; otherwise a resumed run starts without them:
  //
  //     std::vector<double> memory_ = {0.0};
  //     list.keep("memory", 1, [this] { return std::span(memory_); });    // and .advances_what_is_kept() of that pass

 private:
  double force_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(TemplateNamePlugin, "template_name", "1.0.0", "Uniform force on the fluid along x")
