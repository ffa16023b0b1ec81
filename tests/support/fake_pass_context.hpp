#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesogen/plugin/physics.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"
#include "test_plugins.hpp"

namespace mesogen::test {

/// Fields made up by a test, for passes that work particle by particle, in double precision.
class FakePassContext final : public PassContext {
 public:
  explicit FakePassContext(Index count) : count_(count) { scene_.dimension = 2; }

  /// Gives a field: component c at all particles is values[c].
  void set(const std::string& field, const std::vector<double>& values) {
    auto& all = fields_[field];
    all.clear();
    for (const double value : values) all.insert(all.end(), static_cast<std::size_t>(count_), value);
  }
  [[nodiscard]] double at(const std::string& field, int component, Index particle = 0) const {
    return fields_.at(field).at(static_cast<std::size_t>(component * count_ + particle));
  }
  void set_step_size(double seconds) { step_size_ = seconds; }

  [[nodiscard]] bool has(std::string_view field) const override { return fields_.count(std::string(field)) > 0; }
  [[nodiscard]] const sph::SmoothingKernel& kernel() const override { return kernel_; }
  [[nodiscard]] const Scene& scene() const override { return scene_; }
  [[nodiscard]] exec::Space space() const override { return {}; }
  [[nodiscard]] Index count() const override { return count_; }
  [[nodiscard]] const double* position(int) const override { throw std::logic_error("there are no positions here"); }
  [[nodiscard]] std::uint64_t positions_version() const override { return 1; }
  [[nodiscard]] const std::int64_t* id() const override { throw std::logic_error("there are no ids here"); }
  [[nodiscard]] double time() const override { return 0.0; }
  [[nodiscard]] double step_size() const override { return step_size_; }
  [[nodiscard]] std::int64_t step() const override { return 0; }

 protected:
  [[nodiscard]] RawField readable(std::string_view field, std::size_t) const override { return raw(field); }
  [[nodiscard]] RawField writable(std::string_view field, std::size_t) const override { return raw(field); }
  void fill_neighbours(void*, std::size_t, int) const override {
    throw std::logic_error("this pass works particle by particle");
  }

 private:
  [[nodiscard]] RawField raw(std::string_view field) const {
    return {fields_.at(std::string(field)).data(), static_cast<std::ptrdiff_t>(count_)};
  }

  Index count_;
  double step_size_ = 0.0;
  sph::SmoothingKernel kernel_;
  Scene scene_;
  mutable std::map<std::string, std::vector<double>> fields_;  // component by component
};

/// A physics plugin of the built library with parameters as a case would set them, in double precision.
class PhysicsUnderTest {
 public:
  PhysicsUnderTest(const std::string& name, const std::map<std::string, double>& numbers, Scene scene = {})
      : plugin_(built_plugins().make_physics(name, Precision::double_precision, 2)), scene_(std::move(scene)) {
    scene_.dimension = 2;
    plugin_->parameters(parameters_);
    for (const auto& [key, value] : numbers) set(key, value);
    plugin_->publish(scene_);
    plugin_->declare(scene_, passes_);
  }

  /// With what the plugin published.
  [[nodiscard]] const Scene& scene() const { return scene_; }
  void run(const std::string& pass, const PassContext& context) const {
    for (const Pass& candidate : passes_.passes())
      if (candidate.name == pass) return candidate.body(context);
    throw std::invalid_argument("no pass " + pass);
  }
  [[nodiscard]] std::map<std::string, double> limits(const Scene& scene) const {
    std::map<std::string, double> all;
    for (const LinearTerm& term : passes_.linear_terms())
      all[std::string(to_string(term.cause)) + ": " + term.rule] = term.longest_step(scene);
    for (const PassList::Limit& limit : passes_.step_limits())
      all[std::string(to_string(limit.cause)) + ": " + limit.rule] = limit.seconds(scene);
    return all;
  }

 private:
  void set(const std::string& key, double value) {
    for (const Parameter& parameter : parameters_.all()) {
      if (parameter.name != key) continue;
      if (auto* const number = std::get_if<double*>(&parameter.target)) {
        **number = value;
      } else if (auto* const flag = std::get_if<bool*>(&parameter.target)) {
        **flag = value != 0.0;
      } else {
        *std::get<std::optional<double>*>(parameter.target) = value;
      }
      return;
    }
    throw std::invalid_argument("no parameter " + key);
  }

  PluginPointer<Physics> plugin_;
  Scene scene_;
  ParameterList parameters_;
  PassList passes_;
};

}  // namespace mesogen::test
