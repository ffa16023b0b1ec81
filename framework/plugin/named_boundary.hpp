#pragma once

#include <string>

#include "mesogen/plugin/boundary.hpp"
#include "plugin/plugin_pointer.hpp"

namespace mesogen {

/// A boundary plugin that says its name: whatever one of its functions throws comes out as an Error that names the
/// plugin and the function; likewise a crash. `run_failed` where it is called while a case runs, `plugin_refused`
/// before. What the plugin gives is checked here: wall particles where somebody can see them, unit normals, rules of as
/// many components as the field has, finite numbers.
class NamedBoundary final : public Boundary {
 public:
  /// `length_unit`: of what its functions are given, for messages.
  NamedBoundary(std::string name, PluginPointer<Boundary> plugin, std::string length_unit)
      : name_(std::move(name)), plugin_(std::move(plugin)), length_unit_(std::move(length_unit)) {}

  void parameters(ParameterList& list) override;
  void scales(Scales& scales) const override;
  void prepare(const Scene& scene) override;
  [[nodiscard]] Continuation continuation(int axis) const override;
  [[nodiscard]] std::array<double, 3> shear(const Scene& scene, const std::array<int, 3>& boxes) const override;
  [[nodiscard]] bool strays(const double* position) const override;
  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override;
  [[nodiscard]] std::vector<WallParticle> wall_particles(const Scene& scene, double reach) const override;
  [[nodiscard]] AffineRule ghost_rule(const Scene& scene, const FieldKind& field,
                                      const std::array<int, 3>& boxes) const override;
  [[nodiscard]] AffineRule wall_rule(const Scene& scene, const FieldKind& field, const WallParticle& at) const override;

 private:
  void check(const Scene& scene, const WallParticle& particle, std::size_t number) const;

  std::string name_;
  PluginPointer<Boundary> plugin_;
  std::string length_unit_;
};

}  // namespace mesogen
