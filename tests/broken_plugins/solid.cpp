// Plugins of three dimensions alone, one for each kind.
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/kernel.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

#if defined(KERNEL)
class Solid final : public Kernel {
 public:
  static constexpr DimensionSet dimensions{3};
  [[nodiscard]] sph::KernelShape shape() const override { return {.pieces = {{2.0, {1.0}}}, .power = 3}; }
};
#elif defined(BOUNDARY)
class Solid final : public Boundary {
 public:
  static constexpr DimensionSet dimensions{3};
  [[nodiscard]] Continuation continuation(int) const override { return Continuation::wrapped; }
};
#elif defined(INITIAL)
class Solid final : public Initial {
 public:
  static constexpr DimensionSet dimensions{3};
  void plan(InitialPlan&) const override {}
  void set(InitialState&) const override {}
};
#elif defined(OBSERVER)
class Solid final : public Observer {
 public:
  static constexpr DimensionSet dimensions{3};
  void plan(const Scene&, ObserverPlan&) override {}
  void sample(const ObserverContext&, Sample&) override {}
};
#else
template <class Real, int Dim>
requires(Dim == 3) class Solid final : public Physics {
 public:
  void parameters(ParameterList&) override {}
  void declare(const Scene&, PassList&) override {}
};
#endif

}  // namespace

#if defined(KERNEL)
MESOGEN_KERNEL_PLUGIN(Solid, "solid_kernel", "1.0.0", "A kernel of three dimensions")
#elif defined(BOUNDARY)
MESOGEN_BOUNDARY_PLUGIN(Solid, "solid_boundary", "1.0.0", "A boundary of three dimensions")
#elif defined(INITIAL)
MESOGEN_INITIAL_PLUGIN(Solid, "solid_initial", "1.0.0", "An initial condition of three dimensions")
#elif defined(OBSERVER)
MESOGEN_OBSERVER_PLUGIN(Solid, "solid_observer", "1.0.0", "An observer of three dimensions")
#else
MESOGEN_PHYSICS_PLUGIN(Solid, "solid_physics", "1.0.0", "A physics term of three dimensions")
#endif
