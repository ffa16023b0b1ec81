#include "schedule/advection.hpp"

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

template <class Real>
void advect(const PassContext& context, const FieldDeclaration& field, const Transport& transport) {
  if (context.scene().dimension == 2) return advect<Real, 2>(context, field, transport);
  advect<Real, 3>(context, field, transport);
}

}  // namespace

Pass advection_pass(const FieldDeclaration& field, const Transport& transport) {
  Pass pass;
  pass.name = "advection of " + field.name;
  pass.reads({field.name + "_gradient", transport.relative()}).accumulates({field.rate}).run([=](const auto& context) {
    if (context.scene().precision == Precision::single_precision) return advect<float>(context, field, transport);
    advect<double>(context, field, transport);
  });
  return pass;
}

}  // namespace mesogen
