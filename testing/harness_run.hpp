#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>

#include "given_fields.hpp"
#include "run/observation.hpp"
#include "run/stepper.hpp"

namespace mesogen::testing {

/// The scene of a harness, put together and at its initial state: everything that is thrown away when a test gives a
/// field that the scene did not know before.
class HarnessRun {
 public:
  HarnessRun(const std::string& case_text, const PluginRegistry& registry, const GivenFields& given,
             const std::map<std::string, double>& constants, std::int64_t seed);

  /// Values that the test gives to a field of the scene; false if there is no such field, or it is derived.
  bool set(const std::string& field, const GivenField& given);
  void seed(std::int64_t seed);
  void start();
  void resume_from(HarnessRun& other);
  void restore(const std::map<std::string, std::vector<double>>& saved, double time);
  /// At most to `end` (s).
  void step(double end);
  [[nodiscard]] std::map<std::string, std::vector<double>, std::less<>> sample(std::optional<std::int64_t> shuffled_by);
  /// In the order of ids.
  [[nodiscard]] std::vector<double> values(const std::string& field, int component);
  [[nodiscard]] std::vector<double> by_id(const std::vector<double>& stored);
  void move(const std::function<double(double, double)>& x, const std::function<double(double, double)>& y);
  /// A pass by its name, or by "instance: name".
  [[nodiscard]] ScheduledPass& scheduled(std::string_view pass);

  [[nodiscard]] Setup& setup() { return *setup_; }
  [[nodiscard]] Stepper& stepper() { return stepper_; }
  [[nodiscard]] State& state() { return stepper_.state(); }
  [[nodiscard]] std::vector<bool> all_readers() const { return std::vector<bool>(setup_->observers.size() + 1, true); }
  /// Has anything run here, so that giving it up would lose something?
  bool touched = false;

 private:
  void fill(const std::string& field, const FieldValue& value);
  /// Fields that start with random numbers unless the test gives them.
  [[nodiscard]] std::set<std::string> seeded_fields() const;
  void permute(const std::vector<Index>& order);

  std::unique_ptr<Setup> setup_;
  Stepper stepper_;
  Observation observation_;
  std::set<std::string> given_;
  bool started_ = false;
};

}  // namespace mesogen::testing
