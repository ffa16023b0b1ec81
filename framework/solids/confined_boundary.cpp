#include "solids/confined_boundary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/particles/periodic.hpp"
#include "solids/fit.hpp"
#include "solids/packing.hpp"

namespace mesogen {

namespace {

using Point = Shape::Point;

// Beyond the support, for what sees farther until particles are sorted again.
constexpr double margin = 1.0;  // in spacings

Point moved(const Point& from, double by, const Point& along) {
  return {from[0] + by * along[0], from[1] + by * along[1], from[2] + by * along[2]};
}

Point wrapped(const Scene& scene, Point at) {
  std::int32_t boxes = 0;
  for (int d = 0; d < scene.dimension; ++d)
    if (const auto axis = static_cast<std::size_t>(d); scene.periodic[axis])
      wrap_into_box(scene.box[axis], at[axis], boxes);
  return at;
}

bool in_box(const Scene& scene, const Point& at) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(scene.dimension); ++d)
    if (!(at[d] >= 0.0 && at[d] <= scene.box[d])) return false;
  return true;
}

/// Of the fluid: a cell of the lattice counts as far as the surface leaves of it.
double volume_of(const FluidRegion& region, const Scene& scene, const Arrangement& lattice) {
  double cells = 0.0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(lattice.count); ++n) {
    Point at{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(scene.dimension); ++d) at[d] = lattice.position[d][n];
    cells += std::clamp(0.5 + region.distance(at) / scene.spacing, 0.0, 1.0);
  }
  double box = 1.0;
  for (std::size_t d = 0; d < static_cast<std::size_t>(scene.dimension); ++d) box *= scene.box[d];
  return box * cells / lattice.count;
}

}  // namespace

ConfinedBoundary::ConfinedBoundary(std::unique_ptr<Boundary> box, std::vector<Solid> solids, std::string length_unit)
    : box_(std::move(box)), solids_(std::move(solids)), length_unit_(std::move(length_unit)) {}

void ConfinedBoundary::scales(Scales& scales) const {
  box_->scales(scales);
  for (const WallParticle& wall : walls_) {
    if (wall.wall == 0) continue;
    const Point speed = solids_[static_cast<std::size_t>(wall.wall) - 1].velocity(wall.position);
    scales.speed = std::max(scales.speed, std::hypot(speed[0], speed[1], speed[2]));
  }
}

ConfinedBoundary::Fluid ConfinedBoundary::place(const Scene& scene, const Arrangement& lattice) {
  region_ = std::make_unique<FluidRegion>(solids_, scene);
  const double reach = scene.support + margin * scene.spacing;
  const std::vector<WallParticle> faces = box_->wall_particles(scene, reach);
  std::vector<Point> behind_faces;
  for (const WallParticle& wall : faces) behind_faces.push_back(wall.position);
  const Packing packing = pack(*region_, scene, lattice, behind_faces, reach);
  if (const std::string problem = fit_problem(*region_, scene, packing, length_unit_); !problem.empty())
    throw Error(ExitCode::bad_case, problem);
  walls_.clear();
  add_faces(scene, faces, reach);
  add_solids(scene, packing.solid);
  clear_ = std::make_unique<ClearCells>(*region_, scene);

  Fluid fluid;
  fluid.arrangement.count = static_cast<Index>(packing.fluid.size());
  for (std::size_t d = 0; d < static_cast<std::size_t>(scene.dimension); ++d)
    for (const Point& at : packing.fluid) fluid.arrangement.position[d].push_back(at[d]);
  fluid.volume = volume_of(*region_, scene, lattice);
  for (const Point& at : packing.fluid) fluid.widest = std::max(fluid.widest, 2.0 * region_->distance(at));
  return fluid;
}

// Where a solid stands at a face, what the wall of the face would take from there it takes from before the solid.
void ConfinedBoundary::add_faces(const Scene& scene, const std::vector<WallParticle>& faces, double reach) {
  for (WallParticle wall : faces) {
    wall.wall = 0;
    const double distance = region_->distance(wall.mirror);
    if (distance < -reach) continue;
    if (distance < 0.0) {
      const auto foot = region_->foot(wall.mirror);
      if (!foot) continue;
      const Point before = moved(foot->point, 1.0, moved(foot->point, -1.0, wall.mirror));
      if (!in_box(scene, before)) continue;
      wall.mirror = before;
    }
    walls_.push_back(wall);
  }
}

void ConfinedBoundary::add_solids(const Scene& scene, const std::vector<Point>& placed) {
  for (const Point& at : placed) {
    const auto foot = region_->foot(at);
    const std::string& name = solids_[region_->nearest(at).solid].name();
    if (!foot)
      throw Error(ExitCode::bad_case,
                  fmt::format("{} has no surface to the fluid near {}: where it crosses a periodic face its two ends "
                              "must fit together, and solids that overlap must do so by more than they touch",
                              name, place_text(at)));
    const Point mirror = wrapped(scene, moved(foot->point, 1.0, moved(foot->point, -1.0, at)));
    if (!in_box(scene, mirror))
      throw Error(ExitCode::bad_case,
                  fmt::format("the surface of {} near {} lies at a face of the box that is not periodic: let the solid "
                              "end inside, or reach across the face",
                              name, place_text(foot->point)));
    WallParticle wall{at, mirror, foot->normal, region_->curvature(*foot)};
    wall.wall = static_cast<int>(foot->solid) + 1;
    walls_.push_back(wall);
  }
}

std::string ConfinedBoundary::place_text(const Point& at) const {
  return fmt::format("({:.4g}, {:.4g}) {}", at[0], at[1], length_unit_);
}

bool ConfinedBoundary::strays(const double* position) const {
  if (clear_->hold(position)) return false;
  Point at{};
  std::copy_n(position, at.size(), at.begin());
  return region_->distance(at) < 0.0;
}

// A particle that passed the surface of a solid comes back from it as far as it went in.
void ConfinedBoundary::keep_inside(const Scene& scene, double* position, std::int32_t* images) const {
  box_->keep_inside(scene, position, images);
  Point at{};
  std::copy_n(position, static_cast<std::size_t>(scene.dimension), at.begin());
  if (!in_box(scene, at) || !strays(at.data())) return;
  const auto foot = region_->foot(at);
  if (!foot) return;
  Point back = moved(foot->point, 1.0, moved(foot->point, -1.0, at));
  if (region_->distance(back) < 0.0) back = moved(foot->point, 1e-6 * scene.spacing, foot->normal);
  std::copy_n(back.begin(), static_cast<std::size_t>(scene.dimension), position);
  box_->keep_inside(scene, position, images);
}

std::vector<WallParticle> ConfinedBoundary::wall_particles(const Scene&, double) const { return walls_; }

AffineRule ConfinedBoundary::wall_rule(const Scene& scene, const FieldKind& field, const WallParticle& at) const {
  if (at.wall == 0) return box_->wall_rule(scene, field, at);
  return solids_[static_cast<std::size_t>(at.wall) - 1].rule(field, at);
}

}  // namespace mesogen
