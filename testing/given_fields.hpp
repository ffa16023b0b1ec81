#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "run/setup.hpp"

namespace mesogen::testing {

/// Components of a field by the words of a test: at a particle of this id, at (x, y).
using FieldValue = std::function<double(int component, std::int64_t id, double x, double y)>;

/// A field that a test gives; without a value, one that it wants to be there, if a plugin knows it.
struct GivenField {
  int components = 0;  ///< as many as the test named
  FieldValue value;
};
using GivenFields = std::map<std::string, GivenField, std::less<>>;

/// Completes a scene in which one plugin is tested without those it works with. Fields that are read and nobody makes
/// become states with given values; fields that others would make and the plugin adds to are there; and all that is
/// made is kept.
class SceneCompletion {
 public:
  /// Both must outlive the set-up. `constants`: what other plugins would publish.
  SceneCompletion(const PluginRegistry& registry, const GivenFields& given,
                  const std::map<std::string, double>& constants)
      : registry_(registry), given_(given), constants_(constants) {}

  [[nodiscard]] SetupAdditions additions();

 private:
  void add_given(Setup& setup) const;
  void add_missing(Setup& setup) const;
  void add_missing(Setup& setup, const std::string& field, bool written, const std::string& by) const;
  static void keep_all(Setup& setup);
  [[nodiscard]] FieldDeclaration known(const std::string& field, int dimension) const;

  const PluginRegistry& registry_;
  const GivenFields& given_;
  const std::map<std::string, double>& constants_;
};

}  // namespace mesogen::testing
