#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "case/problems.hpp"

namespace mesogen {

struct Entry;

/// A TOML value with the place where it stands. Tables keep the order of the file.
struct MESOGEN_EXPORT Value {
  /// A date or a time, for which a case has no use.
  struct Date {
    std::string text;
  };
  using List = std::vector<Value>;
  using Table = std::vector<Entry>;

  using Content = std::variant<bool, std::int64_t, double, std::string, Date, List, Table>;

  Content content;
  SourcePlace place;

  // defined where Entry is complete
  Value();
  Value(Content initial, SourcePlace at);
  Value(const Value& other);
  Value(Value&& other) noexcept;
  Value& operator=(const Value& other);
  Value& operator=(Value&& other) noexcept;
  ~Value();

  template <class Type>
  [[nodiscard]] const Type* as() const {
    return std::get_if<Type>(&content);
  }
  template <class Type>
  [[nodiscard]] Type* as() {
    return std::get_if<Type>(&content);
  }
  /// The value under a key of this table; null if there is none.
  [[nodiscard]] const Value* find(std::string_view key) const;
  /// The value under a dotted path of keys, the empty one being this value itself; null if there is none.
  [[nodiscard]] const Value* find_path(std::string_view path) const;
  /// Place of the value under a dotted path, or of the innermost value on the way to it.
  [[nodiscard]] SourcePlace place_of_path(std::string_view path) const;
  /// Puts a value under a dotted path; a new key goes to the end of its table, and takes the value's place. False if
  /// something on the way is no table; `obstacle` is then its path.
  bool set_path(std::string_view path, Value value, std::string* obstacle = nullptr);
};

struct Entry {
  std::string key;
  SourcePlace place;  ///< of the key
  Value value;
};

/// "physics.flow" and "type" to "physics.flow.type".
inline std::string joined(std::string_view path, std::string_view key) {
  return path.empty() ? std::string(key) : std::string(path) + "." + std::string(key);
}

}  // namespace mesogen
