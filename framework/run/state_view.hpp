#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/observer.hpp"
#include "run/whole_state.hpp"
#include "schedule/state.hpp"

namespace mesogen {

/// The state of a run as observers see it. Whether a field is up to date is for the maker of the view to see to.
class MESOGEN_EXPORT StateView : public ObserverContext {
 public:
  /// Of a run on one process.
  explicit StateView(const State& state)
      : state_(state), particles_(state.particles), fields_(state.fields), backend_(state.backend) {}
  StateView(const State& state, const WholeState& whole)
      : state_(state), particles_(whole.particles()), fields_(whole.fields()), backend_(whole.backend()) {}
  ~StateView() override;

  [[nodiscard]] FieldReader field(std::string_view name) const override { return fields_.at(name).reader(); }
  [[nodiscard]] std::vector<double> values(std::string_view name, int component) const override;
  [[nodiscard]] bool has(std::string_view field) const override { return fields_.find(field) != nullptr; }
  [[nodiscard]] std::vector<double> position(int axis) const override;
  [[nodiscard]] std::vector<double> unwrapped(int axis) const override;
  [[nodiscard]] std::vector<double> unwrapped_at(int axis, std::span<const Index> places) const override;
  [[nodiscard]] std::span<const std::int64_t> id() const override { return particles_.id.host(); }
  [[nodiscard]] const Scene& scene() const override { return state_.scene; }
  [[nodiscard]] const sph::SmoothingKernel& kernel() const override { return state_.kernel; }
  [[nodiscard]] double constant(std::string_view name) const override;
  [[nodiscard]] double time() const override { return state_.time; }
  [[nodiscard]] std::int64_t step() const override { return state_.step; }

 private:
  const State& state_;
  const Particles& particles_;
  const FieldStore& fields_;
  const Backend& backend_;
};

}  // namespace mesogen
