#include "mesogen/plugin/boundary.hpp"

#include "mesogen/particles/periodic.hpp"

namespace mesogen {

Boundary::~Boundary() = default;

void Boundary::parameters(ParameterList&) {}

void Boundary::scales(Scales&) const {}

void Boundary::prepare(const Scene&) {}

std::array<double, 3> Boundary::shear(const Scene&, const std::array<int, 3>&) const { return {}; }

void Boundary::keep_inside(const Scene& scene, double* position, std::int32_t* images) const {
  for (int d = 0; d < scene.dimension; ++d) {
    const double length = scene.box[static_cast<std::size_t>(d)];
    if (periodic(d)) {
      wrap_into_box(length, position[d], images[d]);
    } else if (position[d] < 0.0 && position[d] > -length) {
      position[d] = -position[d];
    } else if (position[d] > length && position[d] < 2.0 * length) {
      position[d] = 2.0 * length - position[d];
    }
  }
}

bool Boundary::strays(const double*) const { return false; }

std::vector<WallParticle> Boundary::wall_particles(const Scene&, double) const { return {}; }

AffineRule Boundary::ghost_rule(const Scene&, const FieldKind& field, const std::array<int, 3>&) const {
  return AffineRule(field);
}

AffineRule Boundary::wall_rule(const Scene&, const FieldKind& field, const WallParticle&) const {
  return AffineRule(field);
}

}  // namespace mesogen
