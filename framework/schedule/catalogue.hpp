#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/fields/field_kind.hpp"
#include "mesogen/plugin/passes.hpp"

namespace mesogen {

/// The fields of a scene: what each is and who introduced it.
class MESOGEN_EXPORT Catalogue {
 public:
  struct Entry {
    FieldDeclaration declaration;
    std::string owner;                      ///< instance, "director", ...
    bool initial = false;                   ///< the initial conditions set it
    std::string set_by = {};                ///< which one
    bool prescribed = false;                ///< by the case
    std::vector<std::string> sources = {};  ///< fields that it then depends on
  };

  explicit Catalogue(int dimension) : dimension_(dimension) {}

  /// A field of a plugin. Throws if another plugin introduced it already.
  void add(const FieldDeclaration& declaration, const std::string& owner);
  /// A field that the initial conditions set, whether or not a plugin knows it.
  void add_initial(const FieldDeclaration& declaration, const std::string& owner);

  /// A field that the case prescribes in space and time, and what fields it depends on.
  void add_prescribed(const FieldDeclaration& declaration, const std::string& owner, std::vector<std::string> sources);

  [[nodiscard]] bool is_prescribed(std::string_view field) const {
    const Entry* const entry = find(field);
    return entry != nullptr && entry->prescribed;
  }
  [[nodiscard]] const Entry* find(std::string_view field) const;
  /// Does the scene have this field, declared or derived from a declared one?
  [[nodiscard]] bool exists(std::string_view field) const;
  /// Components of an existing field; 0 if there is none of this name.
  [[nodiscard]] int components(std::string_view field) const;
  /// What the components of an existing field mean; nothing for the gradient of a tensor.
  [[nodiscard]] std::optional<Rank> rank(std::string_view field) const;
  /// What it is for a boundary; `velocity`: the name of the fluid's velocity. Nothing where there is no rank.
  [[nodiscard]] std::optional<FieldKind> kind(std::string_view field, std::string_view velocity) const;
  /// Unit of an existing field: "1/m2 x unit of its source" for derived ones.
  [[nodiscard]] std::string unit(std::string_view field) const;
  /// A state keeps its value from step to step: advanced in time or set once.
  [[nodiscard]] bool is_state(std::string_view field) const;
  /// A state, or a field that the passes of its plugin bring from step to step: what a checkpoint must hold.
  [[nodiscard]] bool outlasts_step(std::string_view field) const;
  [[nodiscard]] const std::map<std::string, Entry, std::less<>>& all() const { return entries_; }
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  int dimension_;
  std::map<std::string, Entry, std::less<>> entries_;
};

}  // namespace mesogen
