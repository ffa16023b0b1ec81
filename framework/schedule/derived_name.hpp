#pragma once

#include <string>
#include <string_view>

namespace mesogen {

/// A field that the framework offers by itself, recognised by its name.
struct DerivedName {
  enum class Kind { none, volume, correction, gradient, laplacian };
  Kind kind = Kind::none;
  std::string source;  ///< of a gradient or Laplacian: the field it belongs to
};

inline DerivedName derived_name(std::string_view field) {
  using Kind = DerivedName::Kind;
  if (field == "volume") return {Kind::volume, {}};
  if (field == "correction") return {Kind::correction, {}};
  for (const auto& [suffix, kind] : {std::pair{std::string_view("_gradient"), Kind::gradient},
                                     std::pair{std::string_view("_laplacian"), Kind::laplacian}})
    if (field.size() > suffix.size() && field.ends_with(suffix))
      return {kind, std::string(field.substr(0, field.size() - suffix.size()))};
  return {};
}

}  // namespace mesogen
