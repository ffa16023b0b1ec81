// A uniform force density f on the fluid: gravity, or the pressure gradient that drives a channel.

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dim>
struct Push {
  FieldView<const Real> density;
  FieldView<Real> acceleration;
  Real force[Dim];

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int d = 0; d < Dim; ++d) acceleration(d, i) += force[d] / density(i);
  }
};

template <class Real, int Dim>
class BodyForce final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.numbers("force", force_).sizes({Dim}).unit("N/m3").required().doc("f: force density along each axis");
  }

  // Against a wall or a solid it is pressure.
  void publish(Scene& scene) const override {
    double& stress = scene.scales.stress;
    for (std::size_t d = 0; d < force_.size(); ++d)
      if (scene.solids || !scene.periodic.at(d)) stress = std::max(stress, std::abs(force_[d]) * scene.box.at(d));
  }

  void declare(const Scene&, PassList& list) override {
    list.pass("body force")
        .reads({"density"})
        .accumulates({"acceleration"})
        .idle_if(std::all_of(force_.begin(), force_.end(), [](double f) { return f == 0.0; }))
        .run([this](const PassContext& context) {
          Push<Real, Dim> push{context.read<Real>("density"), context.write<Real>("acceleration"), {}};
          for (unsigned d = 0; d < Dim; ++d) push.force[d] = Real(force_[d]);
          exec::for_each(context.space(), context.count(), push);
        });
  }

 private:
  std::vector<double> force_ = std::vector<double>(Dim, 0.0);
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(BodyForce, "body_force", "1.0.0", "Uniform force density on the fluid: drives a channel")
