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
/// volumes V_i add up to that of the box: those of the kernel miss it by up to a per cent where particles lie unevenly.
///
/// A, C and K are the constants `bulk_A`, `bulk_C` and `elastic_constant` that a physics plugin publishes; where one is
/// missing, the free energy is NaN.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesogen/exec/compensated_sum.hpp"
#include "mesogen/plugin/by_id.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace mesogen {
namespace {

class NematicStatistics final : public Observer {
 public:
  static constexpr DimensionSet dimensions{2};

  void plan(const Scene& /*scene*/, ObserverPlan& plan) override {
    for (const auto* field : {"order_tensor", "order_tensor_gradient", "volume"}) plan.reads(field);
    plan.reads_if_present("elastic_energy");
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
    const ById particles(context);
    const auto q11 = particles.values("order_tensor", 0);
    const auto q12 = particles.values("order_tensor", 1);
    exec::CompensatedSum order;
    exec::CompensatedSum sum11;
    exec::CompensatedSum sum12;
    double smallest = q11.empty() ? 0.0 : std::hypot(q11[0], q12[0]);
    for (std::size_t i = 0; i < particles.count(); ++i) {
      const double q = std::hypot(q11[i], q12[i]);
      order.add(q);
      smallest = std::min(smallest, q);
      sum11.add(q11[i]);
      sum12.add(q12[i]);
    }
    double angle = 0.5 * std::atan2(sum12.value(), sum11.value());
    if (angle <= -0.5 * std::numbers::pi) angle = 0.5 * std::numbers::pi;  // rounded: atan2(-1e-30, -1)
    sample.set("mean_order", order.value() / static_cast<double>(particles.count()));
    sample.set("minimum_order", smallest);
    sample.set("mean_director_angle", angle);
    sample.set("tilt_rms", tilt(q11, q12, angle));
    sample.set("free_energy", free_energy(context, particles, q11, q12));
  }

 private:
  /// rad; a director has no head: no tilt is above pi/2. Taken from Q turned back by the mean angle, so that a small
  /// tilt keeps its digits.
  static double tilt(const std::vector<double>& q11, const std::vector<double>& q12, double mean_angle) {
    const double cosine = std::cos(2.0 * mean_angle);
    const double sine = std::sin(2.0 * mean_angle);
    exec::CompensatedSum squares;
    for (std::size_t i = 0; i < q11.size(); ++i)
      squares.add(std::pow(0.5 * std::atan2(q12[i] * cosine - q11[i] * sine, q11[i] * cosine + q12[i] * sine), 2));
    return std::sqrt(squares.value() / static_cast<double>(q11.size()));
  }

  static double free_energy(const ObserverContext& context, const ById& particles, const std::vector<double>& q11,
                            const std::vector<double>& q12) {
    const double bulk_a = context.constant("bulk_A");
    const double bulk_c = context.constant("bulk_C");
    const double elastic_constant = context.constant("elastic_constant");
    const auto volume = particles.values("volume");
    const auto elastic = elastic_energy(context, particles, elastic_constant);
    exec::CompensatedSum energy;
    exec::CompensatedSum filled;
    for (std::size_t i = 0; i < particles.count(); ++i) {
      const double trace = 2.0 * (q11[i] * q11[i] + q12[i] * q12[i]);
      energy.add(volume[i] * (0.5 * bulk_a * trace + 0.25 * bulk_c * trace * trace + elastic[i]));
      filled.add(volume[i]);
    }
    const auto& box = context.scene().box;
    return energy.value() * (box[0] * box[1] / filled.value());
  }

  /// K/2 |grad Q|^2, J/m3.
  static std::vector<double> elastic_energy(const ObserverContext& context, const ById& particles,
                                            double elastic_constant) {
    if (context.has("elastic_energy") && !std::isnan(elastic_constant)) return particles.values("elastic_energy");
    std::vector<double> energy(particles.count(), 0.0);
    for (int c = 0; c < 4; ++c) {
      const auto slope = particles.values("order_tensor_gradient", c);
      for (std::size_t i = 0; i < energy.size(); ++i) energy[i] += elastic_constant * slope[i] * slope[i];
    }
    return energy;
  }
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::NematicStatistics, "nematic_statistics", "1.0.0",
                        "Order, mean director, tilt and free energy of a nematic")
