// A physics plugin of two dimensions, in double precision alone.
#include <concepts>

#include "mesogen/plugin/physics.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace {

using namespace mesogen;

template <class Real, int Dim>
requires(Dim == 2 && std::same_as<Real, double>) class Exact final : public Physics {
 public:
  void parameters(ParameterList&) override {}
  void declare(const Scene&, PassList&) override {}
};

}  // namespace

MESOGEN_PHYSICS_PLUGIN(Exact, "exact", "1.0.0", "A term in double precision")
