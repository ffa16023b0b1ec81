#pragma once

#include "mesogen/exec/for_each.hpp"
#include "mesogen/plugin/context.hpp"
#include "mesogen/plugin/passes.hpp"

namespace mesogen::nematics {

/// mu (G + G^T), G_ab = d u_a / d x_b.
template <class Real, int Dim>
struct ViscousStress {
  FieldView<const Real> velocity_gradient;
  FieldView<Real> stress;
  Real viscosity;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b)
        stress(a * Dim + b, i) = viscosity * (velocity_gradient(a * Dim + b, i) + velocity_gradient(b * Dim + a, i));
  }
};

/// Declares the field `stress_viscous` of a flow, made for readers.
template <class Real, int Dim>
void declare_viscous_stress(PassList& list, double viscosity) {
  list.field("stress_viscous", Rank::matrix).unit("Pa").doc("mu (grad u + its transpose), row by row; for readers");
  list.pass("viscous stress, for readers", Phase::observe)
      .reads({"velocity_gradient"})
      .writes({"stress_viscous"})
      .run([viscosity](const PassContext& context) {
        exec::for_each(context.space(), context.count(),
                       ViscousStress<Real, Dim>{context.read<Real>("velocity_gradient"),
                                                context.write<Real>("stress_viscous"), Real(viscosity)});
      });
}

}  // namespace mesogen::nematics
