/// How well a nematic is ordered, how evenly its director lies, and its free energy.
///
/// Order q = sqrt(Q11^2 + Q12^2), director angle = atan2(Q12, Q11) / 2. Free energy (Landau-de Gennes, one elastic
/// constant, per metre of depth), with Tr Q^2 = 2 q^2 and |grad Q|^2 = sum_ijk (d_k Q_ij)^2
/// = 2 (|grad Q11|^2 + |grad Q12|^2):
///
///     F = sum_i V_i [ A/2 Tr Q^2 + C/4 (Tr Q^2)^2 + K/2 |grad Q|^2 ]
///
/// Its variation is -dF/dQ_ij = -A Q_ij - C Q_ij Tr Q^2 + K lap Q_ij = H_ij: the molecular field that drives Q, so
/// without flow F never rises. Each factor: d(Tr Q^2)/dQ_ij = 2 Q_ij; d((Tr Q^2)^2)/dQ_ij = 4 Q_ij Tr Q^2; and by parts
/// d(|grad Q|^2)/dQ_ij = -2 lap Q_ij. (A cubic term B Tr Q^3 is zero in 2D.)
///
/// The elastic part is the field `elastic_energy` where a physics plugin makes it, else made of the gradient of Q. The
/// volumes V_i add up to that of the fluid: those of the kernel miss it by up to a per cent where particles lie
/// unevenly.
///
/// A, C and K are the constants `bulk_A`, `bulk_C` and `elastic_constant` that a physics plugin publishes; where one is
/// missing, the free energy is NaN.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesogen/exec/exact_sum.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace mesogen {
namespace {

class NematicStatistics final : public Observer {
 public:
  static constexpr DimensionSet dimensions{2};

  void plan(const Scene& /*scene*/, ObserverPlan& plan) override {
    for (const auto* field : {"order_tensor", "volume"}) plan.reads(field);
    plan.reads_if_present("elastic_energy", gradient);
    plan.scalar("mean_order").doc("mean over particles of the order q = sqrt(Q11^2 + Q12^2)");
    plan.scalar("minimum_order").doc("smallest order q of a particle");
    plan.scalar("mean_director_angle").unit("rad").doc("director of the mean order tensor, in (-pi/2, pi/2]");
    plan.scalar("tilt_rms").unit("rad").doc("root mean square angle between a particle's director and the mean one");
    plan.scalar("free_energy")
        .unit("J/m")
        .doc(
            "Landau-de Gennes free energy per metre of depth; NaN if no plugin publishes bulk_A, bulk_C and "
            "elastic_constant");
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    const FieldReader q = context.field("order_tensor");
    const Index count = context.count();
    const auto [order, sum11, sum12] = exec::exact_sums<3>(count, [&](Index i, double(&terms)[3]) {
      terms[0] = std::sqrt(square(q, i));
      terms[1] = q(0, i);
      terms[2] = q(1, i);
    });
    double angle = 0.5 * std::atan2(sum12, sum11);
    if (angle <= -0.5 * std::numbers::pi) angle = 0.5 * std::numbers::pi;  // rounded: atan2(-1e-30, -1)
    sample.set("mean_order", order / count);
    sample.set("minimum_order", smallest_order(q, count));
    sample.set("mean_director_angle", angle);
    sample.set("tilt_rms", tilt(q, count, angle));
    sample.set("free_energy", free_energy(context, q));
  }

 private:
  /// Q11^2 + Q12^2.
  static double square(const FieldReader& q, Index i) { return q(0, i) * q(0, i) + q(1, i) * q(1, i); }

  static double smallest_order(const FieldReader& q, Index count) {
    double smallest = std::numeric_limits<double>::infinity();
#pragma omp parallel for schedule(static) reduction(min : smallest)
    for (Index i = 0; i < count; ++i) smallest = std::min(smallest, square(q, i));
    return std::sqrt(smallest);
  }

  /// rad; a director has no head: no tilt is above pi/2. Taken from Q turned back by the mean angle, so that a small
  /// tilt keeps its digits.
  static double tilt(const FieldReader& q, Index count, double mean_angle) {
    const double cosine = std::cos(2.0 * mean_angle);
    const double sine = std::sin(2.0 * mean_angle);
    const auto [squares] = exec::exact_sums<1>(count, [&](Index i, double(&term)[1]) {
      const double tilt = 0.5 * std::atan2(q(1, i) * cosine - q(0, i) * sine, q(0, i) * cosine + q(1, i) * sine);
      term[0] = tilt * tilt;
    });
    return std::sqrt(squares / count);
  }

  static double free_energy(const ObserverContext& context, const FieldReader& q) {
    const double a = context.constant("bulk_A");
    const double c = context.constant("bulk_C");
    const double k = context.constant("elastic_constant");
    if (std::isnan(k)) return k;
    // One K does for all only where it is the same everywhere.
    if (!context.has("elastic_energy") && context.scene().varying.contains("elastic_constant"))
      return std::numeric_limits<double>::quiet_NaN();
    const FieldReader volume = context.field("volume");
    const auto sum = [&](const auto& elastic) {
      return exec::exact_sums<2>(context.count(), [&](Index i, double(&terms)[2]) {
        const double trace = 2.0 * square(q, i);
        terms[0] = volume(i) * (0.5 * a * trace + 0.25 * c * trace * trace + elastic(i));
        terms[1] = volume(i);
      });
    };
    const auto [energy, filled] = context.has("elastic_energy") ? sum(context.field("elastic_energy"))
                                                                : sum(ElasticEnergy{context.field(gradient), k});
    return energy * (context.scene().fluid_volume / filled);
  }

  /// K/2 |grad Q|^2, J/m3.
  struct ElasticEnergy {
    FieldReader slope;
    double elastic_constant;
    double operator()(Index i) const {
      double sum = 0.0;
      for (int c = 0; c < 4; ++c) sum += slope(c, i) * slope(c, i);
      return elastic_constant * sum;
    }
  };

  static constexpr const char* gradient = "order_tensor_gradient";
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::NematicStatistics, "nematic_statistics", "1.0.0",
                        "Order, mean director, tilt and free energy of a nematic")
