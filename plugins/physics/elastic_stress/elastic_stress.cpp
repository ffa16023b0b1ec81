// The force of the nematic's elasticity on the flow (Beris and Edwards 1994), which the active-turbulence literature
// often drops:
//
//   f = div Pi - (grad Q) : H,   f_i = d_j Pi_ij - d_i Q_ab H_ab,
//   Pi = 2 lambda (Q + I/2)(Q:H) - lambda H (Q + I/2) - lambda (Q + I/2) H + Q H - H Q.
//
// Energy: with E, w and H as in beris_edwards the flow gets by Pi what turning and stretching Q takes from the free
// energy, and by (grad Q) : H, at each particle, what carrying Q along takes from it: u . (grad Q) : H. Written as the
// divergence of a stress the second term is div(-K d_i Q : d_j Q), which differs by the gradient of the free energy's
// density. That form balances the work only as far as divergence and Laplacian agree, which they do not where Q varies
// from particle to particle, and it loads the fluid with a pressure even at rest, where H = 0 and there is no force.
//
// Where K varies, the energy's density changes with it: the stress then has the further divergence |grad Q|^2 / 2 grad
// K, a force that drives nematics from where distortion costs much to where it costs little.
//
// The coefficients are those that the nematic plugin publishes.

#include <algorithm>
#include <cmath>
#include <string>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dim>
struct Stress {
  FieldView<const Real> q, field;  // Q, H
  FieldView<Real> stress;
  Real lambda;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real q11 = q(0, i);
    const Real q12 = q(1, i);
    const Real h11 = field(0, i);
    const Real h12 = field(1, i);
    // H (Q + I/2) + (Q + I/2) H = (Q:H) I + H, as both are symmetric and traceless in 2D.
    const Real product = Real(2) * (q11 * h11 + q12 * h12);
    const Real half = Real(0.5);
    const Real aligned11 = lambda * (Real(2) * product * (q11 + half) - product - h11);
    const Real aligned22 = lambda * (Real(2) * product * (half - q11) - product + h11);
    const Real aligned12 = lambda * (Real(2) * product * q12 - h12);
    const Real antisymmetric = Real(2) * (q11 * h12 - q12 * h11);
    stress(0, i) = aligned11;
    stress(1, i) = aligned12 + antisymmetric;
    stress(2, i) = aligned12 - antisymmetric;
    stress(3, i) = aligned22;
  }
};

/// The whole stress: Pi - K d_i Q : d_j Q + f I, whose divergence is the force; f is the density of the free energy,
/// A/2 tr Q^2 + C/4 (tr Q^2)^2 + K/2 |grad Q|^2.
template <class Real, int Dim>
struct WholeStress {
  FieldView<const Real> turning, q, gradient;
  FieldView<Real> stress;
  Real a, c;
  Varying<Real> k;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real trace = Real(2) * (q(0, i) * q(0, i) + q(1, i) * q(1, i));
    Real squares = Real(0);
    for (int n = 0; n < 2 * Dim; ++n) squares += gradient(n, i) * gradient(n, i);
    const Real energy = trace * (a / Real(2) + c / Real(4) * trace) + k(i) * squares;
    for (int x = 0; x < Dim; ++x)
      for (int y = 0; y < Dim; ++y) {
        const Real pull = gradient(x, i) * gradient(y, i) + gradient(Dim + x, i) * gradient(Dim + y, i);
        stress(x * Dim + y, i) = turning(x * Dim + y, i) - Real(2) * k(i) * pull + (x == y ? energy : Real(0));
      }
  }
};

template <class Real, int Dim>
struct Force {
  FieldView<const Real> stress_gradient;  // d Pi_ab / d x_c at (a Dim + b) Dim + c
  FieldView<const Real> field, gradient;  // H, and (Q11_x, Q11_y, Q12_x, Q12_y)
  FieldView<const Real> density;
  FieldView<Real> acceleration;
  FieldView<const Real> k_gradient;  // empty where K is uniform

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    Real squares(0);  // |grad Q|^2 / 2
    for (int n = 0; n < 2 * Dim; ++n) squares += gradient(n, i) * gradient(n, i);
    for (int a = 0; a < Dim; ++a) {
      // Q_xx H_xx = Q_yy H_yy: each component counts twice.
      Real force = Real(-2) * (gradient(a, i) * field(0, i) + gradient(Dim + a, i) * field(1, i));
      for (int b = 0; b < Dim; ++b) force += stress_gradient((a * Dim + b) * Dim + b, i);
      if (k_gradient) force += k_gradient(a, i) * squares;
      acceleration(a, i) += force / density(i);
    }
  }
};

template <class Real, int Dim>
requires(Dim == 2) class ElasticStress final : public Physics {
 public:
  void parameters(ParameterList&) override {}

  // |Pi| and what (grad Q) : H adds up to over the length in which Q changes are at most (2 + |lambda|) |H|, about,
  // where |H| is that of the start (K lap Q and the bulk), or of defects that vanish: the most that the bulk has below
  // its equilibrium order.
  void publish(Scene& scene) const override {
    scene.constants["elastic_stress"] = 1.0;  // the nematic's elasticity acts on the flow
    const double a = scene.constant("bulk_A");
    const double c = scene.constant("bulk_C");
    const auto bulk = [&](double order) { return std::abs(a + 2.0 * c * order * order) * order; };
    const double equilibrium = a < 0.0 && c > 0.0 ? std::sqrt(-a / (2.0 * c)) : 0.0;
    const InitialExtent start = scene.initial_extent("order_tensor");
    const double field = std::max(scene.constant("elastic_constant") * start.laplacian + bulk(start.largest),
                                  bulk(equilibrium / std::sqrt(3.0)));
    double& stress = scene.scales.passing_stress;
    stress = std::max(stress, (2.0 + std::abs(scene.constant("flow_alignment"))) * field);
  }

  void declare(const Scene& scene, PassList& list) override {
    for (const char* const name : {"flow_alignment", "elastic_constant"})
      if (!scene.constants.contains(name))
        throw Error(ExitCode::bad_case, std::string("elastic_stress needs the '") + name +
                                            "' of a nematic: add a [physics.*] section with type = \"beris_edwards\"");
    lambda_ = scene.constant("flow_alignment");
    const double k = scene.constant("elastic_constant");
    if (k > 0.0 && scene.constants.contains("density")) limit_step(scene, list, k);
    list.field("elastic_stress", Rank::matrix)
        .unit("Pa")
        .doc("Pi, the elastic stress of turning and stretching Q, row by row");
    list.pass("elastic stress")
        .reads({"order_tensor", "molecular_field"})
        .writes({"elastic_stress"})
        .run([this](const PassContext& context) {
          exec::for_each(context.space(), context.count(),
                         Stress<Real, Dim>{context.read<Real>("order_tensor"), context.read<Real>("molecular_field"),
                                           context.write<Real>("elastic_stress"), Real(lambda_)});
        });
    list.field("stress_elastic", Rank::matrix)
        .unit("Pa")
        .doc("the whole elastic stress, Pi - K d_i Q : d_j Q + f I with f the density of the free energy; for readers");
    list.pass("elastic stress, for readers", Phase::observe)
        .reads({"elastic_stress", "order_tensor", "order_tensor_gradient"})
        .reads_if_present({"elastic_constant"})
        .writes({"stress_elastic"})
        .run([a = scene.constant("bulk_A"), c = scene.constant("bulk_C"), k](const PassContext& context) {
          exec::for_each(
              context.space(), context.count(),
              WholeStress<Real, Dim>{context.read<Real>("elastic_stress"), context.read<Real>("order_tensor"),
                                     context.read<Real>("order_tensor_gradient"), context.write<Real>("stress_elastic"),
                                     Real(a), Real(c), context.varying<Real>("elastic_constant", k)});
        });
    Pass& force = list.pass("elastic force");
    force.reads({"elastic_stress_gradient", "molecular_field", "order_tensor_gradient", "density"})
        .accumulates({"acceleration"})
        .conserves_momentum();
    const bool varies = scene.varying.contains("elastic_constant");
    if (varies) force.reads({"elastic_constant_gradient"});
    force.run([varies](const PassContext& context) {
      Force<Real, Dim> add{context.read<Real>("elastic_stress_gradient"), context.read<Real>("molecular_field"),
                           context.read<Real>("order_tensor_gradient"),   context.read<Real>("density"),
                           context.write<Real>("acceleration"),           {}};
      if (varies) add.k_gradient = context.read<Real>("elastic_constant_gradient");
      exec::for_each(context.space(), context.count(), add);
    });
  }

 private:
  // Waves of the director against the fluid's inertia: rho w' ~ K k^4 X theta with X <= 2 + |lambda|, theta' ~ X w / 4.
  // In a stabilised step viscosity may overdamp them: the flow is that of the balance mu k^2 w ~ K k^4 X theta, by
  // which the director diffuses with K X^2 / (4 mu).
  void limit_step(const Scene& scene, PassList& list, double k) const {
    const char* const rule =
        scene.stabilised_steps
            ? "0.25 h^2 sqrt(rho / K) / (2 + |lambda|) or stable diffusion by K (2 + |lambda|)^2 / 2 mu"
            : "0.25 h^2 sqrt(rho / K) / (2 + |lambda|)";
    list.step_limit(StepCause::elastic_waves, rule, [this, k](const Scene& run) {
      const double coupling = 2.0 + std::abs(lambda_);
      const double length = run.smoothing_length;
      const double wave = 0.25 * length * length * std::sqrt(run.constant("density") / k) / coupling;
      if (!run.stabilised_steps) return wave;
      return std::max(wave, run.diffusion_step * 2.0 * run.constant("viscosity") / (k * coupling * coupling));
    });
  }

  double lambda_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(ElasticStress, "elastic_stress", "1.0.0", "Stress of the nematic's elasticity on the flow")
