// The order tensor of a nematic, Beris and Edwards (1994), in 2D with the trace of S removed by I/2:
//
//   DQ11/Dt = lambda E11 - 2 lambda (Q:E) Q11 - w Q12 + Gamma H11
//   DQ12/Dt = lambda E12 - 2 lambda (Q:E) Q12 + w Q11 + Gamma H12
//   Q:E = 2 (Q11 E11 + Q12 E12),   E = sym(grad u),   w = dv/dx - du/dy
//   H = -A Q - C Q Tr(Q^2) + K lap Q + (grad K . grad) Q
//
// Signs: a rigid rotation turns the director with the fluid, dtheta/dt = w/2.
//
// Where the paper that this scheme comes from (Saghatchi, Kolukisa, Yildiz) reads otherwise: its vorticity tensor is
// built from d_i u_j, which would turn the director against the fluid; its I/3 gives a 2x2 S a trace; its discrete
// equation lacks the K before the Laplacian; and A, B, C = 1, 0, 0 of its Table 2 has no order as its only minimum,
// where its figures need A = -1, C = 1/2, that is H = Q (1 - q^2) at rest.

#include <cmath>

#include "mesogen/nematics/advice.hpp"
#include "mesogen/nematics/numbers.hpp"
#include "mesogen/nematics/order_tensor.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "mesogen/sph/pair_sum.hpp"

namespace {

using namespace mesogen;

struct Nematic {
  double gamma = 0.0;   // rotational diffusivity, 1/(Pa s)
  double lambda = 0.0;  // flow alignment
  double k = 0.0;       // elastic constant, N
  double a = -1.0;      // bulk, Pa
  double b = 0.0;
  double c = 0.5;
};

/// (grad K . grad) Q, of an elastic constant that varies: H is what Q takes from the energy K/2 |grad Q|^2.
template <class Real, int Dim>
struct VaryingElasticity {
  FieldView<const Real> k_gradient, q_gradient;  // both empty where K is uniform

  static VaryingElasticity of(const PassContext& context, bool varies) {
    if (!varies) return {};
    return {context.read<Real>("elastic_constant_gradient"), context.read<Real>("order_tensor_gradient")};
  }
  MESOGEN_HOST_DEVICE Real operator()(int component, Index i) const {
    Real sum(0);
    if (k_gradient)
      for (int d = 0; d < Dim; ++d) sum += k_gradient(d, i) * q_gradient(component * Dim + d, i);
    return sum;
  }
};

template <class Real, int Dim>
struct MolecularField {
  FieldView<const Real> q, laplacian;
  FieldView<Real> field;
  Real a, c;
  Varying<Real> k;
  VaryingElasticity<Real, Dim> varying;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real trace = nematics::trace_of_square(q(0, i), q(1, i));
    for (int n = 0; n < 2; ++n)
      field(n, i) = nematics::bulk_field(a, c, q(n, i), trace) + k(i) * laplacian(n, i) + varying(n, i);
  }
};

/// Elastic energy per volume, K/2 |grad Q|^2, from the differences between neighbours:
///
///   |grad Q|^2 = 2 (|grad Q11|^2 + |grad Q12|^2),   |grad f|^2 = 2 sum_j w_ij r_ij^2 (f_j - f_i)^2 / sum_j w_ij
///   r_ij^4,
///
/// w_ij = -V_j W'(r_ij) / r_ij. On a lattice these are the weights of the consistent Laplacian, walls included, so that
/// the variation of the sum of these energies is -K lap Q as particles find it. The square of a gradient would leave
/// out most of what noise from particle to particle and jumps at walls hold.
template <class Real>
struct ElasticEnergy {
  static constexpr int sum_count = 2;
  enum Sum { squares, moment };

  FieldView<const Real> volume, q;
  FieldView<Real> energy;
  Varying<Real> k;

  struct Own {
    Real q[2];
  };
  MESOGEN_HOST_DEVICE Own load(Index i) const { return {{q(0, i), q(1, i)}}; }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own& own, const Pair& p, Lane* sum) const {
    const Lane square = p.distance * p.distance;
    const Lane weight = p.load(volume) * p.gradient() * square;
    const Lane first = p.load(q, 0) - Lane(own.q[0]);
    const Lane second = p.load(q, 1) - Lane(own.q[1]);
    sum[squares] = sum[squares] + weight * (first * first + second * second);
    sum[moment] = sum[moment] + weight * square;
  }

  MESOGEN_HOST_DEVICE void finish(Index i, const Own&, const Real* sum) const {
    energy(i) = sum[moment] < Real(0) ? Real(2) * k(i) * sum[squares] / sum[moment] : Real(0);
  }
};

template <class Real, int Dim>
struct Rate {
  FieldView<const Real> q, velocity_gradient;  // the last may be empty: no flow
  FieldView<Real> rate;
  Real gamma, lambda, a, c;
  VaryingElasticity<Real, Dim> varying;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real q11 = q(0, i);
    const Real q12 = q(1, i);
    const Real trace = nematics::trace_of_square(q11, q12);
    // Without elasticity, which is declared as a diffusion.
    Real rate11 = gamma * (nematics::bulk_field(a, c, q11, trace) + varying(0, i));
    Real rate12 = gamma * (nematics::bulk_field(a, c, q12, trace) + varying(1, i));
    if (velocity_gradient) {
      const Real ux = velocity_gradient(0, i);
      const Real uy = velocity_gradient(1, i);
      const Real vx = velocity_gradient(2, i);
      const Real vy = velocity_gradient(3, i);
      // Half the difference: without the divergence that a weakly compressible flow has, E stays traceless.
      const Real e11 = (ux - vy) / Real(2);
      const Real e12 = (uy + vx) / Real(2);
      const Real vorticity = vx - uy;
      const Real stretch = Real(2) * lambda * Real(2) * (q11 * e11 + q12 * e12);
      rate11 += lambda * e11 - stretch * q11 - vorticity * q12;
      rate12 += lambda * e12 - stretch * q12 + vorticity * q11;
    }
    rate(0, i) = rate11;
    rate(1, i) = rate12;
  }
};

template <class Real, int Dim>
requires(Dim == 2) class BerisEdwards final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.number("rotational_diffusivity", nematic_.gamma)
        .unit("1/(Pa s)")
        .above(0)
        .required()
        .doc("Gamma: how fast Q relaxes toward the minimum of the free energy");
    list.number("flow_alignment", nematic_.lambda)
        .unit("1")
        .required()
        .doc("lambda: coupling to the strain rate; with |lambda| >= 2 q the director aligns with a shear");
    list.number("elastic_constant", nematic_.k)
        .unit("N")
        .at_least(0)
        .required()
        .may_vary("elastic_constant")
        .doc("K: elastic constant, the energy cost of gradients of Q (one-constant approximation)");
    list.number("bulk.A", nematic_.a).unit("Pa").doc("second-order bulk coefficient; below 0 the fluid is nematic");
    list.number("bulk.B", nematic_.b).unit("Pa").doc("third-order bulk coefficient; drops out in 2D");
    list.number("bulk.C", nematic_.c)
        .unit("Pa")
        .at_least(0)
        .doc("fourth-order bulk coefficient; the equilibrium order is sqrt(-A / 2C)");
  }

  void publish(Scene& scene) const override {
    scene.constants["rotational_diffusivity"] = nematic_.gamma;
    scene.constants["flow_alignment"] = nematic_.lambda;
    scene.constants["elastic_constant"] = nematic_.k;
    scene.constants["bulk_A"] = nematic_.a;
    scene.constants["bulk_C"] = nematic_.c;
  }

  void declare(const Scene& scene, PassList& list) override {
    const bool varies = scene.varying.contains("elastic_constant");
    limit_step(scene, varies, list);
    LinearTerm& elasticity = list.diffusion("order_tensor", "order_tensor_rate", nematic_.gamma * nematic_.k,
                                            StepCause::elasticity, "stable diffusion by Gamma K");
    if (varies) elasticity.varies_with("elastic_constant", nematic_.k);
    list.numbers(nematics::add_core_numbers);
    list.advice([](const AdviceContext& context, std::vector<Suggestion>& suggestions) {
      nematics::advise_on_cores(context, suggestions);
      nematics::advise_on_order(context, suggestions);
    });
    list.field("order_tensor", Rank::order_tensor)
        .doc("Q = q (2 n n - I), stored as (Q11, Q12) = q (cos 2 theta, sin 2 theta)")
        .predicted_by("order_tensor_rate")
        .shown()
        .set_at_start();
    list.field("order_tensor_rate", Rank::order_tensor).unit("1/s").doc("DQ/Dt");
    list.field("molecular_field", Rank::order_tensor)
        .unit("Pa")
        .doc("H = -A Q - C Q Tr(Q^2) + K lap Q + (grad K . grad) Q");
    Pass& molecular_field = list.pass("molecular field");
    molecular_field.reads({"order_tensor", "order_tensor_laplacian"})
        .reads_if_present({"elastic_constant"})
        .writes({"molecular_field"})
        .run([this, varies](const PassContext& context) {
          exec::for_each(context.space(), context.count(),
                         MolecularField<Real, Dim>{
                             context.read<Real>("order_tensor"), context.read<Real>("order_tensor_laplacian"),
                             context.write<Real>("molecular_field"), Real(nematic_.a), Real(nematic_.c),
                             context.varying<Real>("elastic_constant", nematic_.k),
                             VaryingElasticity<Real, Dim>::of(context, varies)});
        });
    list.field("elastic_energy", Rank::scalar).unit("J/m3").doc("K/2 |grad Q|^2, from differences between neighbours");
    list.pass("elastic energy, for readers", Phase::observe)
        .reads_neighbours({"order_tensor", "volume"})
        .reads_if_present({"elastic_constant"})
        .writes({"elastic_energy"})
        .run([this](const PassContext& context) {
          sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(),
                        ElasticEnergy<Real>{context.read<Real>("volume"), context.read<Real>("order_tensor"),
                                            context.write<Real>("elastic_energy"),
                                            context.varying<Real>("elastic_constant", nematic_.k)});
        });
    Pass& rate_pass = list.pass("rate of the order tensor");
    rate_pass.reads({"order_tensor"})
        .reads_if_present({"velocity_gradient"})
        .writes({"order_tensor_rate"})
        .run([this, varies](const PassContext& context) {
          Rate<Real, Dim> rate{context.read<Real>("order_tensor"),
                               {},
                               context.write<Real>("order_tensor_rate"),
                               Real(nematic_.gamma),
                               Real(nematic_.lambda),
                               Real(nematic_.a),
                               Real(nematic_.c),
                               VaryingElasticity<Real, Dim>::of(context, varies)};
          if (context.has("velocity_gradient")) rate.velocity_gradient = context.read<Real>("velocity_gradient");
          exec::for_each(context.space(), context.count(), rate);
        });
    if (varies)
      for (Pass* const pass : {&molecular_field, &rate_pass})
        pass->reads({"elastic_constant_gradient", "order_tensor_gradient"});
  }

 private:
  void limit_step(const Scene& scene, bool varies, PassList& list) const {
    // (grad K . grad) Q is explicit, also where the diffusion takes any step. Where K falls to zero over two spacings
    // it carries Q at Gamma K / (2 dx), which diffusion holds in steps up to 8 dx^2 / (Gamma K).
    const bool any_step = scene.stabilised_steps || scene.scales.laplacians_for_any_step.contains("order_tensor");
    if (varies && any_step && nematic_.k > 0.0)
      list.step_limit(StepCause::elasticity, "2 dx^2 / (Gamma K), as K varies", [this](const Scene& run) {
        return 2.0 * run.spacing * run.spacing / (nematic_.gamma * nematic_.k);
      });
    // The midpoint rule is stable up to 2 over the rate, and off by a sixth of the square of their product: at most 3 %
    // where |Q| = 1, 0.7 % of the return to equilibrium with A = -2 C.
    const double stiffness = std::abs(nematic_.a) + 6.0 * nematic_.c;
    if (stiffness > 0.0)
      list.step_limit(StepCause::bulk_relaxation, "0.4 / (Gamma (|A| + 6 C))",
                      [this, stiffness](const Scene&) { return 0.4 / (nematic_.gamma * stiffness); });
  }

  Nematic nematic_;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(BerisEdwards, "beris_edwards", "1.0.0",
                       "Order tensor of a nematic: alignment with the flow, rotation, relaxation, elasticity")
