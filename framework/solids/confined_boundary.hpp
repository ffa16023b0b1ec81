#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "case/arrangement.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "solids/clear_cells.hpp"
#include "solids/fluid_region.hpp"

namespace mesogen {

/// The boundary of a case with solids: that of the box, and the surfaces of the solids. The rest of the framework sees
/// one boundary.
class MESOGEN_EXPORT ConfinedBoundary final : public Boundary {
 public:
  /// `length_unit`: of the case, for messages.
  ConfinedBoundary(std::unique_ptr<Boundary> box, std::vector<Solid> solids, std::string length_unit);

  /// Of the box; the solids have theirs from the case already.
  void parameters(ParameterList& list) override { box_->parameters(list); }
  void scales(Scales& scales) const override;
  /// Of the box; then place() is called.
  void prepare(const Scene& scene) override { box_->prepare(scene); }

  /// What the solids leave of a lattice of particles.
  struct Fluid {
    Arrangement arrangement;
    double volume = 0.0;  ///< m^dimension
    double widest = 0.0;  ///< largest distance between two walls, m
  };
  /// Places particles of the fluid and of the solids. Throws an Error(bad_case) that names the solid and the place
  /// where they do not fit together. `scene` must outlive this.
  [[nodiscard]] Fluid place(const Scene& scene, const Arrangement& lattice);

  [[nodiscard]] std::vector<Solid>& solids() { return solids_; }
  [[nodiscard]] const FluidRegion& region() const { return *region_; }
  /// See Scene::depth_in_solid.
  [[nodiscard]] double depth(const Shape::Point& at) const {
    return clear_->hold(at.data()) ? 0.0 : std::max(0.0, -region_->distance(at));
  }

  [[nodiscard]] Continuation continuation(int axis) const override { return box_->continuation(axis); }
  [[nodiscard]] std::array<double, 3> shear(const Scene& scene, const std::array<int, 3>& boxes) const override {
    return box_->shear(scene, boxes);
  }
  [[nodiscard]] bool strays(const double* position) const override;
  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override;
  [[nodiscard]] std::vector<WallParticle> wall_particles(const Scene& scene, double reach) const override;
  [[nodiscard]] AffineRule ghost_rule(const Scene& scene, const FieldKind& field,
                                      const std::array<int, 3>& boxes) const override {
    return box_->ghost_rule(scene, field, boxes);
  }
  [[nodiscard]] AffineRule wall_rule(const Scene& scene, const FieldKind& field, const WallParticle& at) const override;

 private:
  void add_faces(const Scene& scene, const std::vector<WallParticle>& faces, double reach);
  void add_solids(const Scene& scene, const std::vector<Shape::Point>& placed);
  [[nodiscard]] std::string place_text(const Shape::Point& at) const;

  std::unique_ptr<Boundary> box_;
  std::vector<Solid> solids_;
  std::string length_unit_;
  std::unique_ptr<FluidRegion> region_;
  std::unique_ptr<ClearCells> clear_;
  std::vector<WallParticle> walls_;  // `wall`: 0 of the box, n + 1 of the n-th solid
};

}  // namespace mesogen
