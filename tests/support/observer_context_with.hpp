#pragma once

#include "fake_observer_context.hpp"

namespace mesogen::test {

/// A made-up state of a run, seen at some time and, if wished, between walls.
class ObserverContextWith final : public ObserverContext {
 public:
  /// `walls`: at all faces. `time`: s.
  ObserverContextWith(const FakeObserverContext& from, bool walls, double time = 0.0)
      : from_(from), scene_(from.scene()), time_(time) {
    if (walls) scene_.periodic = {false, false, false};
  }

  [[nodiscard]] FieldReader field(std::string_view name) const override { return from_.field(name); }
  [[nodiscard]] std::vector<double> values(std::string_view field, int component) const override {
    return from_.values(field, component);
  }
  [[nodiscard]] bool has(std::string_view field) const override { return from_.has(field); }
  [[nodiscard]] std::vector<double> position(int axis) const override { return from_.position(axis); }
  [[nodiscard]] std::vector<double> unwrapped(int axis) const override { return from_.unwrapped(axis); }
  [[nodiscard]] std::vector<double> unwrapped_at(int axis, std::span<const Index> places) const override {
    return from_.unwrapped_at(axis, places);
  }
  [[nodiscard]] std::span<const std::int64_t> id() const override { return from_.id(); }
  [[nodiscard]] const Scene& scene() const override { return scene_; }
  [[nodiscard]] const sph::SmoothingKernel& kernel() const override { return from_.kernel(); }
  [[nodiscard]] double constant(std::string_view name) const override { return from_.constant(name); }
  [[nodiscard]] double time() const override { return time_; }
  [[nodiscard]] std::int64_t step() const override { return from_.step(); }

 private:
  const FakeObserverContext& from_;
  Scene scene_;
  double time_;
};

}  // namespace mesogen::test
