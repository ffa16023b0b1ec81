#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/fields/dimensions.hpp"
#include "mesogen/fields/field_reader.hpp"
#include "mesogen/fields/field_view.hpp"
#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

namespace sph {
struct SmoothingKernel;
}

/// A quantity that an observer records at each sample: a scalar, or rows x columns numbers.
struct MESOGEN_EXPORT Quantity {
  std::string name;
  std::string unit_text = "1";
  std::string doc_text;
  /// Numbers in a row; 0: the quantity is one number a sample.
  std::size_t columns = 0;
  /// The number of rows may change from sample to sample (defects): stored padded with NaN, the count beside it.
  bool varying = false;

  Quantity& unit(std::string_view text);
  Quantity& doc(std::string_view text);
};

/// What an observer reads and records.
class MESOGEN_EXPORT ObserverPlan {
 public:
  /// Fields it reads when it samples; brought up to date by then. Standard derived fields too (see PassList).
  void reads(std::string_view field);
  /// Fields it reads if the scene has them; see ObserverContext::has.
  void reads_if_present(std::string_view field);
  /// A field it reads if the scene has it, and another that it reads only if not: so nobody makes both.
  void reads_if_present(std::string_view field, std::string_view otherwise);
  /// One number a sample.
  Quantity& scalar(std::string_view name);
  /// A table a sample, `columns` numbers a row.
  Quantity& table(std::string_view name, std::size_t columns);
  /// Ask for Observer::follow after every step.
  void follow_every_step();
  /// What it records means something only where particles go with the fluid; a case in which they stay is refused.
  void traces_particles() { traces_ = true; }

  [[nodiscard]] const std::vector<std::string>& read_list() const { return reads_; }
  [[nodiscard]] const std::vector<std::string>& optional_list() const { return optional_; }
  /// What it reads in place of an optional field, by the name of that field.
  [[nodiscard]] const std::map<std::string, std::string>& otherwise_list() const { return otherwise_; }
  /// All fields it reads in a scene that has those for which has(name) is true.
  [[nodiscard]] std::vector<std::string> fields(const std::function<bool(const std::string&)>& has) const;
  [[nodiscard]] const std::deque<Quantity>& quantities() const { return quantities_; }
  [[nodiscard]] bool follows() const { return follows_; }
  [[nodiscard]] bool traces() const { return traces_; }

 private:
  std::vector<std::string> reads_;
  std::vector<std::string> optional_;
  std::map<std::string, std::string> otherwise_;
  std::deque<Quantity> quantities_;
  bool follows_ = false;
  bool traces_ = false;
};

/// One sample: values by quantity name.
class MESOGEN_EXPORT Sample {
 public:
  void set(std::string_view quantity, double value);
  /// Row-major; the number of rows is values.size() / columns.
  void set(std::string_view quantity, std::vector<double> values);
  [[nodiscard]] const std::map<std::string, std::vector<double>, std::less<>>& values() const { return values_; }

 private:
  std::map<std::string, std::vector<double>, std::less<>> values_;
};

/// The state of the run as an observer sees it, on the host. All fields are as declared in the plan, by particle in
/// storage order, which changes during a run: `id` identifies a particle.
class MESOGEN_EXPORT ObserverContext {
 public:
  ObserverContext() = default;
  ObserverContext(const ObserverContext&) = delete;
  ObserverContext& operator=(const ObserverContext&) = delete;
  virtual ~ObserverContext();

  /// A field at all particles, to be read without a copy: field(component, place in storage). Integrated fields lose no
  /// digits. Take it before a loop.
  [[nodiscard]] virtual FieldReader field(std::string_view name) const = 0;
  /// A copy of component `component` of a field at all particles.
  [[nodiscard]] virtual std::vector<double> values(std::string_view field, int component = 0) const = 0;
  [[nodiscard]] virtual bool has(std::string_view field) const = 0;
  /// Coordinates in the box, [0, box).
  [[nodiscard]] virtual std::vector<double> position(int axis) const = 0;
  /// Coordinates along the particle's path, without jumps at the faces.
  [[nodiscard]] virtual std::vector<double> unwrapped(int axis) const = 0;
  /// The same of some particles, by their places in storage: for those who follow a few at every step. From a device
  /// no others are brought.
  [[nodiscard]] virtual std::vector<double> unwrapped_at(int axis, std::span<const Index> places) const = 0;
  [[nodiscard]] virtual std::span<const std::int64_t> id() const = 0;
  /// Number of particles.
  [[nodiscard]] Index count() const { return static_cast<Index>(id().size()); }
  [[nodiscard]] virtual const Scene& scene() const = 0;
  [[nodiscard]] virtual const sph::SmoothingKernel& kernel() const = 0;
  /// A number that a plugin published by name, in the unit that it gave; NaN if none did.
  [[nodiscard]] virtual double constant(std::string_view name) const = 0;
  [[nodiscard]] virtual double time() const = 0;
  [[nodiscard]] virtual std::int64_t step() const = 0;
};

/// Watches a run and records numbers; changes not one bit of it. `interval` and `every` are the framework's own keys.
class MESOGEN_EXPORT Observer {
 public:
  /// Dimensions that it has a form for. A plugin of fewer declares the same public member again.
  static constexpr DimensionSet dimensions{AllDimensions{}};

  Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  virtual ~Observer();

  virtual void parameters(ParameterList& list);
  virtual void plan(const Scene& scene, ObserverPlan& plan) = 0;
  /// Called before the first sample, with the state that the run begins with. When a run is resumed it is called with
  /// that same state, then restore(): what is found here need not be saved, what is gathered later must
  /// be. The first state of a resumed branch is that of its case: save what start() found for runs that are branched.
  virtual void start(const ObserverContext& context);
  virtual void sample(const ObserverContext& context, Sample& sample) = 0;
  /// After every step, if the plan asked for it. Positions and fields that are advanced in time can be read then.
  virtual void follow(const ObserverContext& context);
  /// What it has gathered since start() and must remember to continue a run, as named lists of numbers; kept in
  /// checkpoints. Without save() and restore(), a resumed run forgets what sample() and follow() have noted.
  [[nodiscard]] virtual std::map<std::string, std::vector<double>> save() const;
  virtual void restore(const std::map<std::string, std::vector<double>>& saved);
};

}  // namespace mesogen
