// Fields that show a flow, for frames and observers: vorticity and stream function. They are made when a reader asks
// and cost a step nothing.

#include <memory>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "stream_function.hpp"

namespace {

using namespace mesogen;
using flow_fields::StreamFunction;

/// omega = dv/dx - du/dy.
template <class Real>
struct Curl {
  FieldView<const Real> gradient;
  FieldView<Real> vorticity;

  MESOGEN_HOST_DEVICE void operator()(Index i) const { vorticity(0, i) = gradient(2, i) - gradient(1, i); }
};

template <class Real, int Dim>
requires(Dim == 2) class FlowFields final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.number("mesh_spacing", mesh_spacing_)
        .unit("particle spacings")
        .at_least(1.0)
        .at_most(10.0)
        .doc("approximate spacing of the mesh of the stream function; waves shorter than 3 mesh spacings are left out");
  }

  void declare(const Scene& scene, PassList& list) override {
    grid_ = StreamFunction::grid_of(scene, mesh_spacing_);
    periodic_ = scene.endless();
    if (periodic_) list.memory(StreamFunction::memory(grid_, scene.particle_count));
    list.field("vorticity", Rank::scalar).unit("1/s").doc("omega = dv/dx - du/dy");
    list.field("stream_function", Rank::scalar)
        .unit("m2/s")
        .doc(
            "psi of the velocity without its mean: u = d psi/dy, v = -d psi/dx; the mean of psi is 0; only in periodic "
            "boxes");
    list.pass("vorticity, for readers", Phase::observe)
        .reads({"velocity_gradient"})
        .writes({"vorticity"})
        .run([](const PassContext& context) {
          exec::for_each(context.space(), context.count(),
                         Curl<Real>{context.read<Real>("velocity_gradient"), context.write<Real>("vorticity")});
        });
    list.pass("stream function, for readers", Phase::observe)
        .reads({"velocity"})
        .writes({"stream_function"})
        .run([this](const PassContext& context) { find_stream_function(context); });
  }

 private:
  // That somebody reads the stream function is known no earlier.
  void find_stream_function(const PassContext& context) {
    if (!periodic_)
      throw Error(ExitCode::bad_case,
                  "the stream function exists only in a periodic box, and this box has walls: remove stream_function "
                  "from output.fields and from what observers read");
    if (!stream_function_) stream_function_ = std::make_unique<StreamFunction>(grid_, context);
    stream_function_->find(context, context.read<Real>("velocity"), context.write<Real>("stream_function"));
  }

  double mesh_spacing_ = 1.5;
  mesh::Grid<2> grid_;
  bool periodic_ = false;
  std::unique_ptr<StreamFunction> stream_function_;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(FlowFields, "flow_fields", "1.0.0", "Vorticity and stream function, for frames and observers")
