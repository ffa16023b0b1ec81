#include "schedule/advection.hpp"

#include "mesogen/exec/dispatch.hpp"
#include "mesogen/exec/for_each.hpp"
#include "mesogen/plugin/context.hpp"

namespace mesogen {

namespace {

template <class Real, int Dim>
struct Advection {
  FieldView<const Real> gradient, velocity;
  FieldView<Real> rate;
  int components;
  Real sign;

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int c = 0; c < components; ++c) {
      Real change = Real(0);
      for (int d = 0; d < Dim; ++d) change += velocity(d, i) * gradient(c * Dim + d, i);
      rate(c, i) += sign * change;
    }
  }
};

template <class Real, int Dim>
void advect(const PassContext& context, const FieldDeclaration& field, const Transport& transport) {
  exec::for_each(context.space(), context.count(),
                 Advection<Real, Dim>{context.read<Real>(field.name + "_gradient"),
                                      context.read<Real>(transport.relative()), context.write<Real>(field.rate),
                                      component_count(field.rank, Dim), Real(transport.fixed ? -1 : 1)});
}

}  // namespace

Pass advection_pass(const FieldDeclaration& field, const Transport& transport) {
  Pass pass;
  pass.name = "advection of " + field.name;
  pass.reads({field.name + "_gradient", transport.relative()}).accumulates({field.rate}).run([=](const auto& context) {
    const Scene& scene = context.scene();
    dispatch(scene.precision, scene.dimension,
             [&]<class Real, int Dim>() { advect<Real, Dim>(context, field, transport); });
  });
  return pass;
}

}  // namespace mesogen
