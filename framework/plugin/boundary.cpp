#include "mesogen/plugin/boundary.hpp"

namespace mesogen {

Boundary::~Boundary() = default;

void Boundary::parameters(ParameterList&) {}

void Boundary::scales(Scales&) const {}

void Boundary::prepare(const Scene&) {}

bool Boundary::periodic(int) const { return true; }

void Boundary::copies(const Scene&, const double* const*, Index, double, Copies& out) const {
  out.source.clear();
  out.offset.clear();
}

void Boundary::carry_over(const Scene&, std::string_view, int, const Copies&, std::vector<Extension>&) const {}

void Boundary::dummies(const Scene&, double, Dummies& out) const {
  out.position.clear();
  out.mirror.clear();
}

void Boundary::extend(const Scene&, std::string_view, int, const Dummies&, std::vector<Extension>&) const {}

}  // namespace mesogen
