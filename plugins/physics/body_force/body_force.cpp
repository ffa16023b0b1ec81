// A force density f on the fluid: gravity, the pressure gradient that drives a channel, or one that varies in space and
// time.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dim>
struct Push {
  FieldView<const Real> density;
  FieldView<Real> acceleration;
  FieldView<const Real> field;  // empty where the force is uniform
  Real force[Dim];

  MESOGEN_HOST_DEVICE void operator()(Index i) const {
    for (int d = 0; d < Dim; ++d) acceleration(d, i) += (field ? field(d, i) : force[d]) / density(i);
  }
};

template <class Real, int Dim>
class BodyForce final : public Physics {
 public:
  void parameters(ParameterList& list) override {
    list.numbers("force", force_)
        .sizes({Dim})
        .unit("N/m3")
        .required()
        .may_vary("body_force")
        .doc("f: force density along each axis");
  }

  // Against a wall or a solid it is pressure. In a box without them friction holds it, or viscosity: that of a wave as
  // long as the box, if the force varies like one.
  void publish(Scene& scene) const override {
    const double viscosity = scene.constant("viscosity");
    const double friction = scene.varying.contains("friction") ? 0.0 : scene.constant("friction");
    const double wave = *std::max_element(scene.box.begin(), scene.box.end()) / (2.0 * std::numbers::pi);
    Scales& scales = scene.scales;
    for (std::size_t d = 0; d < force_.size(); ++d) {
      const double force = std::abs(force_[d]);
      if (scene.solids || !scene.periodic.at(d)) scales.stress = std::max(scales.stress, force * scene.box.at(d));
      if (!scene.endless()) continue;
      if (friction > 0.0) {
        scales.speed = std::max(scales.speed, force / friction);
      } else if (viscosity > 0.0) {
        scales.speed = std::max(scales.speed, force * wave * wave / viscosity);
      }
    }
  }

  void declare(const Scene& scene, PassList& list) override {
    const bool nothing = std::all_of(force_.begin(), force_.end(), [](double f) { return f == 0.0; });
    list.pass("body force")
        .reads({"density"})
        .reads_if_present({"body_force"})
        .accumulates({"acceleration"})
        .idle_if(nothing && !scene.varying.contains("body_force"))
        .run([this](const PassContext& context) {
          Push<Real, Dim> push{context.read<Real>("density"), context.write<Real>("acceleration"), {}, {}};
          if (context.has("body_force")) push.field = context.read<Real>("body_force");
          for (unsigned d = 0; d < Dim; ++d) push.force[d] = Real(force_[d]);
          exec::for_each(context.space(), context.count(), push);
        });
  }

 private:
  std::vector<double> force_ = std::vector<double>(Dim, 0.0);
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(BodyForce, "body_force", "1.0.0",
                       "Force density on the fluid, which may vary in space and time: drives a channel")
