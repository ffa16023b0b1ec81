#pragma once

#include <string>

#include "mesogen/plugin/boundary.hpp"
#include "plugin/plugin_pointer.hpp"

namespace mesogen {

/// A boundary plugin that says its name: whatever one of its functions throws comes out as an Error that names the
/// plugin and the function; likewise a crash. `run_failed` where it is called while a case runs, `plugin_refused`
/// before. What it gives is checked here: copies of particles that there are, dummies beyond the faces, numbers that
/// are finite.
class NamedBoundary final : public Boundary {
 public:
  /// `length_unit`: of what its functions are given, for messages.
  NamedBoundary(std::string name, PluginPointer<Boundary> plugin, std::string length_unit)
      : name_(std::move(name)), plugin_(std::move(plugin)), length_unit_(std::move(length_unit)) {}

  void parameters(ParameterList& list) override;
  void scales(Scales& scales) const override;
  void prepare(const Scene& scene) override;
  [[nodiscard]] bool periodic(int axis) const override;
  [[nodiscard]] bool wraps(int axis) const override;
  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override;
  void copies(const Scene& scene, const double* const* position, Index count, double reach, Copies& out) const override;
  void carry_over(const Scene& scene, std::string_view field, int components, const Copies& copies,
                  std::vector<Extension>& extension) const override;
  void dummies(const Scene& scene, double reach, Dummies& out) const override;
  void extend(const Scene& scene, std::string_view field, int components, const Dummies& dummies,
              std::vector<Extension>& extension) const override;

 private:
  std::string name_;
  PluginPointer<Boundary> plugin_;
  std::string length_unit_;
};

}  // namespace mesogen
