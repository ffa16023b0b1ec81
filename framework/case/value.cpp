#include "case/value.hpp"

#include <algorithm>
#include <utility>

namespace mesogen {

namespace {

/// Cuts the first key off a dotted path.
std::string_view next_key(std::string_view& path) {
  const auto dot = path.find('.');
  const auto key = path.substr(0, dot);
  path = dot == std::string_view::npos ? std::string_view{} : path.substr(dot + 1);
  return key;
}

}  // namespace

Value::Value() : content(false) {}
Value::Value(Content initial, SourcePlace at) : content(std::move(initial)), place(std::move(at)) {}
Value::Value(const Value& other) = default;
Value::Value(Value&& other) noexcept = default;
Value& Value::operator=(const Value& other) = default;
Value& Value::operator=(Value&& other) noexcept = default;
Value::~Value() = default;

const Value* Value::find(std::string_view key) const {
  const auto* const table = as<Table>();
  if (table == nullptr) return nullptr;
  const auto found = std::find_if(table->begin(), table->end(), [&](const Entry& entry) { return entry.key == key; });
  return found == table->end() ? nullptr : &found->value;
}

const Value* Value::find_path(std::string_view path) const {
  const Value* value = this;
  while (value != nullptr && !path.empty()) value = value->find(next_key(path));
  return value;
}

SourcePlace Value::place_of_path(std::string_view path) const {
  const Value* value = this;
  while (!path.empty()) {
    const Value* const inner = value->find(next_key(path));
    if (inner == nullptr) break;
    value = inner;
  }
  return value->place;
}

bool Value::set_path(std::string_view path, Value value, std::string* obstacle) {
  const std::string_view whole = path;
  Value* target = this;
  while (!path.empty()) {
    const auto key = next_key(path);
    auto* const table = target->as<Table>();
    if (table == nullptr) {
      if (obstacle != nullptr) *obstacle = std::string(whole.substr(0, key.data() - whole.data() - 1));
      return false;
    }
    const auto found = std::find_if(table->begin(), table->end(), [&](const Entry& entry) { return entry.key == key; });
    if (found == table->end()) {
      table->push_back({std::string(key), value.place, Value{Table{}, value.place}});
      target = &table->back().value;
    } else {
      target = &found->value;
    }
  }
  *target = std::move(value);
  return true;
}

}  // namespace mesogen
