#include "schedule/advection.hpp"

#include "mesogen/exec/dispatch.hpp"
#include "mesogen/plugin/context.hpp"
#include "particles/field_loops.hpp"

namespace mesogen {

namespace {

template <class Real>
void advect(const PassContext& context, const Backend& backend, const FieldDeclaration& field,
            const Transport& transport) {
  const int dimension = context.scene().dimension;
  backend.fields<Real>().advect({context.read<Real>(field.name + "_gradient"), context.read<Real>(transport.relative()),
                                 context.write<Real>(field.rate), component_count(field.rank, dimension), dimension,
                                 Real(transport.fixed ? -1 : 1)},
                                context.count());
}

}  // namespace

Pass advection_pass(const FieldDeclaration& field, const Transport& transport, const Backend& backend) {
  Pass pass;
  pass.name = "advection of " + field.name;
  pass.reads({field.name + "_gradient", transport.relative()})
      .accumulates({field.rate})
      .run([=, &backend](const auto& context) {
        dispatch(context.scene().precision, [&]<class Real>() { advect<Real>(context, backend, field, transport); });
      });
  return pass;
}

}  // namespace mesogen
