// An incompressible flow without sound, by particles and a mesh: rho Du/Dt = -grad p + mu lap u + f, div u = 0.
//
// Particles carry what goes with the fluid (order tensor, colour, ...). The velocity lives in Fourier space, where
// viscosity takes any step and div u = 0 is a projection: forces are spread from particles to a mesh with B-splines,
// the momentum equation is solved mode by mode, and velocity and its gradient are interpolated back. Order tensor and
// other fields get changes only, so that nothing is smoothed twice. (Velocity carried by particles would have to be
// spread anew each step, and its noise below the mesh would need a damping of its own.)
//
// Gradient and Laplacian of the order tensor are those of the mesh too: exact for every wave that it carries, where a
// smoothing kernel is a few per cent off, and stable for any step.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "memory.hpp"
#include "mesh_flow.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/nematics/numbers.hpp"
#include "mesogen/nematics/viscous_stress.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "pair_shift.hpp"

namespace {

using namespace mesogen;
using incompressible::MeshFlow;

template <class Real, int Dim>
requires(Dim == 2) class Incompressible final : public Physics {
  using Momentum = incompressible::Momentum<Dim>;

 public:
  void parameters(ParameterList& list) override {
    list.number("density", fluid_.density).unit("kg/m3").above(0).required().doc("rho: density");
    list.number("viscosity", fluid_.viscosity).unit("Pa s").above(0).required().doc("mu: dynamic viscosity");
    list.flag("inertia", fluid_.inertia)
        .doc(
            "true: solve the momentum equation. false: creeping (Stokes) flow, in which forces balance viscosity and "
            "friction at every moment");
    list.number_or("expected_speed", expected_speed_, "auto")
        .unit("m/s")
        .at_least(0)
        .doc("largest speed that the flow will reach, for forecasts of a run; auto: the largest speed at the start");
    list.number_or("sound_speed", sound_speed_, "auto")
        .unit("m/s")
        .above(0)
        .doc(
            "without effect, because this flow has no sound; accepted, so that a case for wcsph works with no other "
            "change than the type");
    list.number("mesh_spacing", mesh_spacing_)
        .unit("1")
        .at_least(1)
        .at_most(8)
        .doc(
            "approximate distance of the mesh points, in particle spacings; the actual distance fits the box and the "
            "Fourier transform");
    list.integer("corrections", corrections_)
        .at_least(0)
        .at_most(10)
        .doc(
            "largest number of corrections of the fit of the mesh to the particles; each correction spreads again what "
            "the fit misses. Fewer are made where particles are even");
    list.number("shift", shift_)
        .unit("1")
        .at_least(0)
        .at_most(100)
        .doc(
            "how fast particles move to sparse regions, in multiples of the root mean square velocity gradient; what "
            "they carry is re-evaluated at the new place. If a plugin sums over neighbours, close pairs are also moved "
            "apart, at a tenth of this value times the local gradient. 0: no shift");
  }

  void publish(Scene& scene) const override {
    scene.constants["density"] = fluid_.density;
    scene.constants["viscosity"] = fluid_.viscosity;
    Scales& scales = scene.scales;
    scales.laplacians_for_any_step.insert("order_tensor");
    scales.friction_for_any_step = true;
    scales.speed = std::max({scales.speed, expected_speed_.value_or(0.0), scene.initial_extent("velocity").largest});
  }

  void declare(const Scene& scene, PassList& list) override {
    choose(scene);
    list.memory(incompressible::mesh_flow_memory<Real>(grid_, scene.particle_count));
    list.numbers(nematics::add_flow_numbers);
    // Of an active flow the rate at which it shears, and at which disturbances of it grow.
    if (const double stress = scene.scales.stress; stress > 0.0)
      list.step_limit(StepCause::shear, "0.2 mu / largest stress",
                      [this, stress](const Scene&) { return 0.2 * fluid_.viscosity / stress; });
    fields(list);
    list.flows({"velocity", "shift_velocity", false, "acceleration"});
    for (int n = 0; n < Momentum::kept_count; ++n)
      list.keep(Momentum::kept[n], Momentum::count(grid_, n), [this, n] { return flow().momentum().numbers(n); });
    list.keep("origin of the mesh", Dim, [this] { return flow().origin(); });
    pass(list, "flow at the midpoint", Phase::begin, &MeshFlow<Real, Dim>::to_midpoint)
        .reads({"velocity"})
        .writes({"velocity", "velocity_gradient", "density"});
    const bool shifts = shift_ > 0.0;
    if (nematic_) {
      Pass& in_step = list.pass(
          shifts ? "derivatives of the order tensor, and shift" : "derivatives of the order tensor", Phase::rates);
      Pass& for_readers = list.pass("derivatives of the order tensor, for readers", Phase::observe);
      for (Pass* const made : {&in_step, &for_readers})
        made->reads({"order_tensor"}).writes({"order_tensor_gradient", "order_tensor_laplacian"});
      if (shifts) in_step.accumulates({"shift_velocity"});
      in_step.run([this, shifts](const PassContext& context) {
        shifts ? flow(context).template order_tensor_derivatives<true>(context, diffusivity_, context.step_size())
               : flow(context).template order_tensor_derivatives<false>(context, diffusivity_, context.step_size());
      });
      for_readers.run([this](const PassContext& context) {
        flow(context).template order_tensor_derivatives<false>(context, diffusivity_, 0.0);
      });
    }
    // So that there is an acceleration where nobody adds to it.
    list.pass("no force of its own").accumulates({"acceleration"}).idle_if(true).run([](const PassContext&) {});
    pass(list, "forces", Phase::rates, &MeshFlow<Real, Dim>::add_forces)
        .reads({"acceleration"})
        .advances_what_is_kept();
    pass(list, "pressure", Phase::rates, &MeshFlow<Real, Dim>::pressure).reads({"acceleration"}).writes({"pressure"});
    pass(list, "shift", Phase::rates, &MeshFlow<Real, Dim>::spread_particles)
        .accumulates({"shift_velocity"})
        .idle_if(nematic_ || !shifts);
    list.pass("shift of close pairs")
        .reads({"velocity_gradient"})
        .accumulates({"shift_velocity"})
        .beside_pair_sums()
        .idle_if(!shifts)
        .run([this](const PassContext& context) { move_apart(context); });
    pass(list, "flow at the end", Phase::end, &MeshFlow<Real, Dim>::to_end).writes({"velocity"});
    pass(list, "velocity gradient, for readers", Phase::observe, &MeshFlow<Real, Dim>::velocity_gradient)
        .reads({"velocity"})
        .writes({"velocity_gradient"});
    nematics::declare_viscous_stress<Real, Dim>(list, fluid_.viscosity);
  }

 private:
  void choose(const Scene& scene) {
    for (int d = 0; d < Dim; ++d)
      if (!scene.periodic[static_cast<std::size_t>(d)])
        throw Error(ExitCode::bad_case,
                    "an incompressible flow needs a box that is periodic along every axis: take boundary = "
                    "\"periodic_wrap\" or \"periodic_ghosts\", or between walls type = \"wcsph\"");
    if (scene.solids)
      throw Error(ExitCode::bad_case,
                  "an incompressible flow knows no solids: between them take type = \"wcsph\", or remove [solids]");
    if (!fluid_.inertia && (scene.varying.contains("friction") || scene.constants.contains("friction_along")))
      throw Error(
          ExitCode::bad_case,
          "a creeping incompressible flow knows friction that is the same everywhere and in all directions: leave "
          "inertia = false out, or take type = \"wcsph\"");
    fluid_.friction = scene.constant("friction");
    nematic_ = scene.constants.contains("elastic_constant");
    if (nematic_ && !scene.constants.contains("rotational_diffusivity"))
      throw Error(ExitCode::bad_case,
                  "an incompressible flow slows the Laplacian of the order tensor by its diffusivity: the nematic must "
                  "publish the constant rotational_diffusivity beside elastic_constant");
    diffusivity_ = scene.constant("rotational_diffusivity") * scene.constant("elastic_constant");
    for (int d = 0; d < Dim; ++d) {
      grid_.length[d] = scene.box[static_cast<std::size_t>(d)];
      grid_.points[d] = mesh::fast_size(grid_.length[d] / (mesh_spacing_ * scene.spacing));
    }
    particle_spacing_ = scene.spacing;
  }

  using Action = void (MeshFlow<Real, Dim>::*)(const PassContext&);
  Pass& pass(PassList& list, const char* name, Phase phase, Action action) {
    return list.pass(name, phase).run([this, action](const PassContext& context) { (flow(context).*action)(context); });
  }

  // Made when it is first used: a case is also put together only to be looked at.
  MeshFlow<Real, Dim>& flow() {
    if (!flow_)
      flow_ = std::make_unique<MeshFlow<Real, Dim>>(grid_, particle_spacing_, fluid_,
                                                    incompressible::Numerics{static_cast<int>(corrections_), shift_});
    return *flow_;
  }
  MeshFlow<Real, Dim>& flow(const PassContext& context) {
    flow().run_where(context);
    return flow();
  }

  void move_apart(const PassContext& context) {
    // Nobody moves before there is a step.
    const double step = context.step_size();
    const double per_step = step > 0.0 ? 1.0 / step : 0.0;
    incompressible::PairShift<Real, Dim> sums{};
    sums.velocity_gradient = context.read<Real>("velocity_gradient");
    sums.shift = context.write<Real>("shift_velocity");
    sums.strength = Real(0.1 * shift_);
    sums.mean_gradient = Real(flow().mean_gradient());
    // What an explicit step bears: on a lattice the sum grows by some 10 displacements.
    sums.fastest_rate = Real(0.1 * per_step);
    sums.fastest = Real(MeshFlow<Real, Dim>::farthest_shift * particle_spacing_ * per_step);
    sums.spacing = Real(particle_spacing_);
    sums.at_support = Real(std::pow(particle_spacing_ / context.scene().support, 3));
    sph::pair_sum(context.space(), context.neighbours<Real, Dim>(), context.kernel(), sums);
  }

  void fields(PassList& list) const {
    list.field("velocity", Rank::vector).unit("m/s").doc("u, free of divergence").shown().advanced_by_passes();
    list.field("velocity_gradient", Rank::matrix).unit("1/s").doc("d u_c / d x_d as component c * Dim + d");
    list.field("acceleration", Rank::vector).unit("m/s2").doc("force densities of other plugins, divided by rho");
    list.field("density", Rank::scalar).unit("kg/m3").doc("rho, the same for all particles");
    list.field("pressure", Rank::scalar).unit("Pa").doc("p at the midpoint of the step; its mean is 0");
    list.field("shift_velocity", Rank::vector).unit("m/s").doc("artificial displacement of particles per time");
    if (!nematic_) return;
    list.field("order_tensor_gradient", Rank::matrix).unit("1/m").doc("d Q_c / d x_d as component c * Dim + d");
    list.field("order_tensor_laplacian", Rank::order_tensor)
        .unit("1/m2")
        .doc("lap Q, reduced for waves that decay fast within a step, so that long steps are stable");
  }

  incompressible::Fluid fluid_;
  std::optional<double> expected_speed_;
  std::optional<double> sound_speed_;
  double mesh_spacing_ = 1.5;
  std::int64_t corrections_ = 2;
  double shift_ = 5.0;
  double diffusivity_ = 0.0;  // of the order tensor, m2/s
  bool nematic_ = false;
  mesh::Grid<Dim> grid_;
  double particle_spacing_ = 0.0;
  std::unique_ptr<MeshFlow<Real, Dim>> flow_;
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Incompressible, "incompressible", "1.0.0",
                       "Incompressible flow without sound, by Fourier transforms on a mesh: long steps, periodic boxes")
