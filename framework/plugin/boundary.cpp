#include "mesogen/plugin/boundary.hpp"

namespace mesogen {

namespace {

template <class Real>
void take_from_source(const Copies& copies, FieldView<Real> field, int components, Index count) {
  const auto made = static_cast<Index>(copies.source.size());
  const Index* source = copies.source.data();
#pragma omp parallel for schedule(static)
  for (Index copy = 0; copy < made; ++copy)
    for (int c = 0; c < components; ++c) field(c, count + copy) = field(c, source[copy]);
}

}  // namespace

Boundary::~Boundary() = default;

void Boundary::parameters(ParameterList&) {}

void Boundary::scales(Scales&) const {}

void Boundary::prepare(const Scene&) {}

bool Boundary::periodic(int) const { return true; }

void Boundary::copies(const Scene&, const double* const*, Index, double, Copies& out) const {
  out.source.clear();
  out.offset.clear();
}

void Boundary::refresh(const Copies& copies, FieldView<float> field, int components, Index count) const {
  take_from_source(copies, field, components, count);
}

void Boundary::refresh(const Copies& copies, FieldView<double> field, int components, Index count) const {
  take_from_source(copies, field, components, count);
}

void Boundary::dummies(const Scene&, double, Dummies& out) const {
  out.position.clear();
  out.mirror.clear();
}

void Boundary::extend(const Scene&, std::string_view, int, const Dummies&, std::vector<Extension>&) const {}

}  // namespace mesogen
