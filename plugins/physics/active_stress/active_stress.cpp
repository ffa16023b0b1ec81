// Active stress -zeta Q (Simha and Ramaswamy 2002): its divergence is a force density
//
//   f = -zeta (dQ11/dx + dQ12/dy, dQ12/dx - dQ11/dy),   zeta > 0 extensile, zeta < 0 contractile,
//
// less Q grad zeta where zeta varies: the force is the divergence of the product.
//
// (The momentum sum printed by Saghatchi, Kolukisa and Yildiz lacks the -zeta / rho in front.)

#include <algorithm>
#include <cmath>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/nematics/advice.hpp"
#include "mesogen/nematics/numbers.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "mesogen/sph/pair_sum.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dim>
struct ActiveAcceleration {
  FieldView<const Real> gradient;  // of Q: (Q11_x, Q11_y, Q12_x, Q12_y)
  FieldView<const Real> density;
  FieldView<Real> acceleration;
  Varying<Real> activity;
  FieldView<const Real> order_tensor, activity_gradient;  // empty where zeta is uniform

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real scale = -activity(i) / density(i);
    acceleration(0, i) += scale * (gradient(0, i) + gradient(3, i));
    acceleration(1, i) += scale * (gradient(2, i) - gradient(1, i));
    if (!activity_gradient) return;
    const Real q11 = order_tensor(0, i);
    const Real q12 = order_tensor(1, i);
    const Real zeta_x = activity_gradient(0, i);
    const Real zeta_y = activity_gradient(1, i);
    acceleration(0, i) -= (q11 * zeta_x + q12 * zeta_y) / density(i);
    acceleration(1, i) -= (q12 * zeta_x - q11 * zeta_y) / density(i);
  }
};

template <class Real>
struct StressOfQ {
  FieldView<const Real> order_tensor;
  FieldView<Real> stress;
  Varying<Real> activity;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real zeta = activity(i);
    stress(0, i) = -zeta * order_tensor(0, i);
    stress(1, i) = stress(2, i) = -zeta * order_tensor(1, i);
    stress(3, i) = zeta * order_tensor(0, i);
  }
};

/// The same with opposite forces on two particles: -1 / m sum_j V_i V_j (zeta_i Q_i + zeta_j Q_j) . grad W_ij. No
/// momentum is made, but the sum is exact for uniform Q only where particles are evenly spread.
template <class Real, int Dim>
struct ActivePairs {
  static constexpr int sum_count = Dim;
  FieldView<const Real> order_tensor, volume;
  FieldView<Real> acceleration;
  Real activity_per_mass;            // with the largest activity
  Real largest;                      // activity
  FieldView<const Real> activity{};  // empty where it is uniform

  struct Own {
    Real q[2];
  };
  MESOGEN_HOST_DEVICE Own load(Index i) const {
    const Real share = activity ? activity(i) / largest : Real(1);
    return {{share * order_tensor(0, i), share * order_tensor(1, i)}};
  }

  template <class Pair, class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE void pair(const Own& own, const Pair& p, Lane* sum) const {
    const Lane g = p.load(volume) * p.gradient();
    Lane share(Real(1));
    if (activity) share = p.load(activity) / Lane(largest);
    const Lane q11 = share * p.load(order_tensor, 0) + Lane(own.q[0]);
    const Lane q12 = share * p.load(order_tensor, 1) + Lane(own.q[1]);
    sum[0] = sum[0] + g * (q11 * p.separation[0] + q12 * p.separation[1]);
    sum[1] = sum[1] + g * (q12 * p.separation[0] - q11 * p.separation[1]);
  }

  MESOGEN_HOST_DEVICE void finish(Index i, const Own&, const Real* sum) const {
    for (int d = 0; d < Dim; ++d) acceleration(d, i) -= activity_per_mass * volume(i) * sum[d];
  }
};

template <class Real, int Dim>
requires(Dim == 2) class ActiveStress final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.number("activity", activity_)
        .unit("Pa")
        .required()
        .may_vary("activity")
        .doc("zeta: above 0 extensile (pushers), below 0 contractile (pullers)");
    list.text("form", form_)
        .choices({"corrected", "conservative"})
        .doc(
            "how the divergence of Q is summed. corrected: exact for linear Q; conservative: opposite forces on two "
            "particles, so they add no momentum");
  }

  void publish(Scene& scene) const override {
    scene.constants["activity"] = activity_;
    scene.scales.stress = std::max(scene.scales.stress, std::abs(activity_));
    scene.scales.driven_speed = std::max(scene.scales.driven_speed, nematics::active_speed(scene));
  }

  void declare(const Scene& scene, PassList& list) override {
    list.numbers(nematics::add_active_numbers);
    list.advice(nematics::advise_on_activity);
    Pass& pass = list.pass("active stress")
                     .accumulates({"acceleration"})
                     .conserves_momentum()
                     .idle_if(activity_ == 0.0 && !scene.varying.contains("activity"));
    form_ == "conservative" ? in_pairs(scene, pass) : by_gradient(scene, pass);
    list.field("stress_active", Rank::matrix).unit("Pa").doc("-zeta Q, row by row; for readers");
    list.pass("active stress, for readers", Phase::observe)
        .reads({"order_tensor"})
        .reads_if_present({"activity"})
        .writes({"stress_active"})
        .run([this](const PassContext& context) {
          exec::for_each(context.space(), context.count(),
                         StressOfQ<Real>{context.read<Real>("order_tensor"), context.write<Real>("stress_active"),
                                         context.varying<Real>("activity", activity_)});
        });
  }

 private:
  void by_gradient(const Scene& scene, Pass& pass) {
    pass.reads({"order_tensor_gradient", "density"}).reads_if_present({"activity"});
    const bool varies = scene.varying.contains("activity");
    if (varies) pass.reads({"order_tensor", "activity_gradient"});
    pass.run([this, varies](const PassContext& context) {
      ActiveAcceleration<Real, Dim> add{context.read<Real>("order_tensor_gradient"),
                                        context.read<Real>("density"),
                                        context.write<Real>("acceleration"),
                                        context.varying<Real>("activity", activity_),
                                        {},
                                        {}};
      if (varies) {
        add.order_tensor = context.read<Real>("order_tensor");
        add.activity_gradient = context.read<Real>("activity_gradient");
      }
      exec::for_each(context.space(), context.count(), add);
    });
  }

  void in_pairs(const Scene& scene, Pass& pass) {
    if (!scene.constants.contains("density"))
      throw BadParameter(
          "form", "\"conservative\" needs the density of a flow: add a [physics.*] section with type = \"wcsph\"");
    pass.reads_neighbours({"order_tensor", "volume"});
    const bool varies = scene.varying.contains("activity");
    if (varies) pass.reads_neighbours({"activity"});
    pass.run([this, varies](const PassContext& context) {
      ActivePairs<Real, Dim> sums{};
      sums.order_tensor = context.read<Real>("order_tensor");
      sums.volume = context.read<Real>("volume");
      sums.acceleration = context.write<Real>("acceleration");
      const Scene& run = context.scene();
      sums.activity_per_mass = Real(activity_ / (run.constant("density") * std::pow(run.spacing, Dim)));
      sums.largest = Real(activity_);
      if (varies) sums.activity = context.read<Real>("activity");
      sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(), sums);
    });
  }

  double activity_ = 0.0;
  std::string form_ = "corrected";
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(ActiveStress, "active_stress", "1.0.0", "Force of the active stress -zeta Q on the flow")
