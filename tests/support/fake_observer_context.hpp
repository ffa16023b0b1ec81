#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesogen/plugin/observer.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"
#include "test_plugins.hpp"

namespace mesogen::test {

/// The state of a run made up by a test: particles on a two-dimensional lattice (cell centres, id = y * nx + x), with
/// fields given as functions of the position.
class FakeObserverContext final : public ObserverContext {
 public:
  using Function = std::function<double(double x, double y)>;

  FakeObserverContext(int nx, int ny, double length_x, double length_y) {
    const auto count = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
    scene_.dimension = 2;
    scene_.box = {length_x, length_y, 0.0};
    scene_.fluid_volume = length_x * length_y;
    scene_.spacing = length_x / nx;
    scene_.smoothing_length = 4.0 / 3.0 * scene_.spacing;
    scene_.support = 3.0 * scene_.smoothing_length;
    scene_.particle_count = static_cast<Index>(count);
    kernel_.shape.pieces = {{3.0, {1.0}}, {2.0, {-6.0}}, {1.0, {15.0}}};
    kernel_.shape.power = 5;
    kernel_.smoothing_length = scene_.smoothing_length;
    kernel_.scale = 1.0;
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        path_[0].push_back((i + 0.5) * length_x / nx);
        path_[1].push_back((j + 0.5) * length_y / ny);
      }
    }
    id_.resize(count);
    std::iota(id_.begin(), id_.end(), 0);
    set("volume", {[v = length_x * length_y / static_cast<double>(count)](double, double) { return v; }});
  }
  FakeObserverContext(const FakeObserverContext& other)
      : ObserverContext(),
        scene_(other.scene_),
        kernel_(other.kernel_),
        path_(other.path_),
        id_(other.id_),
        fields_(other.fields_),
        constants_(other.constants_) {}

  /// Adds change(x, y) of the unwrapped path to each particle's position. Fields keep their values.
  void move(const Function& change_x, const Function& change_y) {
    for (std::size_t i = 0; i < id_.size(); ++i) {
      const double x = path_[0][i];
      const double y = path_[1][i];
      path_[0][i] += change_x(x, y);
      path_[1][i] += change_y(x, y);
    }
  }
  /// Moves each particle at random, by at most `amount` spacings along each axis.
  void jitter(double amount, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-amount * scene_.spacing, amount * scene_.spacing);
    move([&](double, double) { return shift(random); }, [&](double, double) { return shift(random); });
  }
  void place(std::size_t id, double x, double y) {
    path_[0].at(id) = x;
    path_[1].at(id) = y;
  }
  /// Gives a field, one function of the position a component.
  void set(const std::string& field, const std::vector<Function>& components) {
    auto& values = fields_[field];
    values.clear();
    for (const auto& function : components) {
      auto& value = values.emplace_back();
      for (std::size_t i = 0; i < id_.size(); ++i) value.push_back(function(path_[0][i], path_[1][i]));
    }
  }
  /// Gives a field of one component, by id.
  void set_values(const std::string& field, std::vector<double> values) { fields_[field] = {std::move(values)}; }
  void remove(const std::string& field) { fields_.erase(field); }
  void set_constant(const std::string& name, double value) { constants_[name] = value; }
  /// Stores particles in another order.
  void store_anew(unsigned seed) { std::shuffle(id_.begin(), id_.end(), std::mt19937(seed)); }

  [[nodiscard]] FieldReader field(std::string_view name) const override {
    std::vector<double>& all = read_.emplace_back();
    for (const auto& component : fields_.at(std::string(name)))
      for (const double value : stored(component)) all.push_back(value);
    return {{all.data(), static_cast<std::ptrdiff_t>(id_.size())}, {}};
  }
  [[nodiscard]] std::vector<double> values(std::string_view field, int component) const override {
    return stored(fields_.at(std::string(field)).at(static_cast<std::size_t>(component)));
  }
  [[nodiscard]] bool has(std::string_view field) const override { return fields_.count(std::string(field)) > 0; }
  [[nodiscard]] std::vector<double> position(int axis) const override {
    auto inside = path_.at(static_cast<std::size_t>(axis));
    const double length = scene_.box.at(static_cast<std::size_t>(axis));
    for (double& x : inside) x -= std::floor(x / length) * length;
    return stored(inside);
  }
  [[nodiscard]] std::vector<double> unwrapped(int axis) const override {
    return stored(path_.at(static_cast<std::size_t>(axis)));
  }
  [[nodiscard]] std::vector<double> unwrapped_at(int axis, std::span<const Index> places) const override {
    const auto all = unwrapped(axis);
    std::vector<double> some;
    for (const Index place : places) some.push_back(all.at(static_cast<std::size_t>(place)));
    return some;
  }
  [[nodiscard]] std::span<const std::int64_t> id() const override { return id_; }
  [[nodiscard]] const Scene& scene() const override { return scene_; }
  [[nodiscard]] const sph::SmoothingKernel& kernel() const override { return kernel_; }
  [[nodiscard]] double constant(std::string_view name) const override {
    const auto found = constants_.find(std::string(name));
    return found == constants_.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
  }
  [[nodiscard]] double time() const override { return 0.0; }
  [[nodiscard]] std::int64_t step() const override { return 0; }

 private:
  [[nodiscard]] std::vector<double> stored(const std::vector<double>& by_id) const {
    std::vector<double> values;
    for (const auto id : id_) values.push_back(by_id[static_cast<std::size_t>(id)]);
    return values;
  }

  Scene scene_;
  sph::SmoothingKernel kernel_;
  std::array<std::vector<double>, 2> path_;                         // unwrapped, by id
  std::vector<std::int64_t> id_;                                    // in storage order
  std::map<std::string, std::vector<std::vector<double>>> fields_;  // components by id
  std::map<std::string, double> constants_;
  mutable std::deque<std::vector<double>> read_;  // what fields were read, in the order of storage
};

/// An observer of the built plugin library, as a run uses it.
class ObserverUnderTest {
 public:
  explicit ObserverUnderTest(const std::string& name) : observer_(built_plugins().make_observer(name, 2)) {
    observer_->parameters(parameters_);
  }

  /// Sets a parameter, as a case would.
  template <class Value>
  void set(const std::string& name, const Value& value) {
    for (const auto& parameter : parameters_.all()) {
      if (parameter.name == name) {
        *std::get<Value*>(parameter.target) = value;
        return;
      }
    }
    throw std::invalid_argument("no parameter " + name);
  }
  /// Plans and starts.
  void start(const ObserverContext& context) {
    plan(context.scene());
    observer_->start(context);
  }
  const ObserverPlan& plan(const Scene& scene) {
    plan_ = ObserverPlan();
    observer_->plan(scene, plan_);
    return plan_;
  }
  Observer* operator->() { return observer_.get(); }

  /// Values by quantity. Throws unless exactly the quantities of the plan are there, each of whole rows.
  std::map<std::string, std::vector<double>, std::less<>> sample(const ObserverContext& context) {
    Sample sample;
    observer_->sample(context, sample);
    auto values = sample.values();
    for (const auto& quantity : plan_.quantities()) {
      const auto found = values.find(quantity.name);
      if (found == values.end()) throw std::logic_error("not sampled: " + quantity.name);
      const bool whole =
          quantity.columns == 0 ? found->second.size() == 1 : found->second.size() % quantity.columns == 0;
      if (!whole) throw std::logic_error("broken rows: " + quantity.name);
    }
    if (values.size() != plan_.quantities().size()) throw std::logic_error("sampled, but not planned");
    return values;
  }
  /// A quantity of one number.
  double number(const ObserverContext& context, const std::string& quantity) {
    return sample(context).at(quantity).at(0);
  }

 private:
  PluginPointer<Observer> observer_;
  ParameterList parameters_;
  ObserverPlan plan_;
};

}  // namespace mesogen::test
