#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/plugin/observer.hpp"
#include "schedule/state.hpp"

namespace mesogen {

/// The state of a run as observers see it. Whether a field is up to date is for the maker of the view to see to.
class MESOGEN_EXPORT StateView : public ObserverContext {
 public:
  explicit StateView(const State& state) : state_(state) {}
  ~StateView() override;

  [[nodiscard]] FieldReader field(std::string_view name) const override { return state_.fields.at(name).reader(); }
  [[nodiscard]] std::vector<double> values(std::string_view name, int component) const override;
  [[nodiscard]] bool has(std::string_view field) const override { return state_.fields.find(field) != nullptr; }
  [[nodiscard]] std::vector<double> position(int axis) const override;
  [[nodiscard]] std::vector<double> unwrapped(int axis) const override;
  [[nodiscard]] std::vector<double> unwrapped_at(int axis, std::span<const Index> places) const override;
  [[nodiscard]] std::span<const std::int64_t> id() const override { return state_.particles.id.host(); }
  [[nodiscard]] const Scene& scene() const override { return state_.scene; }
  [[nodiscard]] const sph::SmoothingKernel& kernel() const override { return state_.kernel; }
  [[nodiscard]] double constant(std::string_view name) const override;
  [[nodiscard]] double time() const override { return state_.time; }
  [[nodiscard]] std::int64_t step() const override { return state_.step; }

 private:
  const State& state_;
};

}  // namespace mesogen
