// Stress of the nematic's elasticity on the flow (Beris and Edwards 1994), which the active-turbulence literature
// often drops:
//
//   Pi = 2 lambda (Q + I/2)(Q:H) - lambda H (Q + I/2) - lambda (Q + I/2) H - K d_i Q : d_j Q + Q H - H Q,
//   force density f_i = d_j Pi_ij.
//
// With E, w and H as in beris_edwards the terms with lambda and Q H - H Q do the work on the flow that they take from
// the free energy. The coefficients are those that the nematic plugin publishes.

#include <cmath>
#include <string>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dim>
struct Stress {
  FieldView<const Real> q, field, gradient;  // Q, H, and (Q11_x, Q11_y, Q12_x, Q12_y)
  FieldView<Real> stress;
  Real lambda, k;

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
    const Real xx = Real(2) * (gradient(0, i) * gradient(0, i) + gradient(2, i) * gradient(2, i));
    const Real xy = Real(2) * (gradient(0, i) * gradient(1, i) + gradient(2, i) * gradient(3, i));
    const Real yy = Real(2) * (gradient(1, i) * gradient(1, i) + gradient(3, i) * gradient(3, i));
    stress(0, i) = aligned11 - k * xx;
    stress(1, i) = aligned12 - k * xy + antisymmetric;
    stress(2, i) = aligned12 - k * xy - antisymmetric;
    stress(3, i) = aligned22 - k * yy;
  }
};

template <class Real, int Dim>
struct Force {
  FieldView<const Real> gradient;  // d Pi_ab / d x_c at (a Dim + b) Dim + c
  FieldView<const Real> density;
  FieldView<Real> acceleration;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int a = 0; a < Dim; ++a) {
      Real force = Real(0);
      for (int b = 0; b < Dim; ++b) force += gradient((a * Dim + b) * Dim + b, i);
      acceleration(a, i) += force / density(i);
    }
  }
};

template <class Real, int Dim>
class ElasticStress final : public Physics {
  static_assert(Dim == 2, "the algebra here is that of two dimensions");

 public:
  void parameters(ParameterList&) override {}

  /// For what is known of the nematic's stability: whether its elasticity acts on the flow.
  void constants(Constants& constants) const override { constants["elastic_stress"] = 1.0; }

  void prepare(const Scene& scene) override {
    const auto constant = [&](const char* name) {
      const auto at = scene.constants.find(name);
      if (at == scene.constants.end())
        throw Error(ExitCode::bad_case, std::string("elastic_stress needs the '") + name +
                                            "' of a nematic: add a [physics.*] section with type = \"beris_edwards\"");
      return at->second;
    };
    lambda_ = constant("flow_alignment");
    k_ = constant("elastic_constant");
  }

  // Waves of the director against the fluid's inertia: rho w' ~ K k^4 X theta with X <= 2 + |lambda|, theta' ~ X w / 4.
  void step_limits(const Scene& scene, StepLimits& limits) const override {
    const auto density = scene.constants.find("density");
    if (k_ > 0.0 && density != scene.constants.end())
      limits.add("elastic waves: 0.25 h^2 sqrt(rho / K) / (2 + |lambda|)",
                 0.25 * scene.smoothing_length * scene.smoothing_length * std::sqrt(density->second / k_) /
                     (2.0 + std::abs(lambda_)));
  }

  void passes(PassList& list) override {
    list.field("elastic_stress", Rank::matrix).unit("Pa").doc("Pi, row by row");
    list.pass("elastic stress")
        .reads({"order_tensor", "molecular_field", "order_tensor_gradient"})
        .writes({"elastic_stress"})
        .run([this](const PassContext& context) {
          exec::for_each(context.space(), context.count(),
                         Stress<Real, Dim>{context.read<Real>("order_tensor"), context.read<Real>("molecular_field"),
                                           context.read<Real>("order_tensor_gradient"),
                                           context.write<Real>("elastic_stress"), Real(lambda_), Real(k_)});
        });
    list.pass("elastic force")
        .reads({"elastic_stress_gradient", "density"})
        .accumulates({"acceleration"})
        .run([](const PassContext& context) {
          exec::for_each(context.space(), context.count(),
                         Force<Real, Dim>{context.read<Real>("elastic_stress_gradient"), context.read<Real>("density"),
                                          context.write<Real>("acceleration")});
        });
  }

 private:
  double lambda_ = 0.0;
  double k_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(ElasticStress, "elastic_stress", "1.0.0", "Stress of the nematic's elasticity on the flow")
