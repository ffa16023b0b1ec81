// Active stress -zeta Q (Simha and Ramaswamy 2002): its divergence is a force density
//
//   f = -zeta (dQ11/dx + dQ12/dy, dQ12/dx - dQ11/dy),   zeta > 0 extensile, zeta < 0 contractile.
//
// (The momentum sum printed by Saghatchi, Kolukisa and Yildiz lacks the -zeta / rho in front.)

#include <cmath>

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dim>
struct ActiveAcceleration {
  FieldView<const Real> gradient;  // of Q: (Q11_x, Q11_y, Q12_x, Q12_y)
  FieldView<const Real> density;
  FieldView<Real> acceleration;
  Real activity;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    const Real scale = -activity / density(i);
    acceleration(0, i) += scale * (gradient(0, i) + gradient(3, i));
    acceleration(1, i) += scale * (gradient(2, i) - gradient(1, i));
  }
};

template <class Real, int Dim>
class ActiveStress final : public Physics {
  static_assert(Dim == 2, "the components here are those of two dimensions");

 public:
  void parameters(ParameterList& list) override {
    list.number("activity", activity_)
        .unit("Pa")
        .required()
        .doc("zeta: above 0 extensile (pushers), below 0 contractile (pullers)");
  }

  void scales(Scales& scales) const override { scales.stress = std::max(scales.stress, std::abs(activity_)); }
  void constants(Constants& constants) const override { constants["activity"] = activity_; }

  void passes(PassList& list) override {
    list.pass("active stress")
        .reads({"order_tensor_gradient", "density"})
        .accumulates({"acceleration"})
        .idle_if(activity_ == 0.0)
        .run([this](const PassContext& context) {
          exec::for_each(
              context.space(), context.count(),
              ActiveAcceleration<Real, Dim>{context.read<Real>("order_tensor_gradient"), context.read<Real>("density"),
                                            context.write<Real>("acceleration"), Real(activity_)});
        });
  }

 private:
  double activity_ = 0.0;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(ActiveStress, "active_stress", "1.0.0", "Force of the active stress -zeta Q on the flow")
