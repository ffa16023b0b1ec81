#include "case/declared_keys.hpp"

#include <utility>
#include <variant>

#include "case/parameter_value.hpp"

namespace mesogen {

std::vector<DeclaredKey> declared_keys(const ParameterList& list) {
  std::vector<DeclaredKey> keys;
  for (const auto& parameter : list.all()) {
    DeclaredKey key{parameter, std::nullopt};
    if (!parameter.is_required) key.default_value = current_value(parameter);
    if (key.default_value && take_value(parameter, *key.default_value)) key.default_value.reset();
    std::visit([](auto*& target) { target = nullptr; }, key.parameter.target);
    keys.push_back(std::move(key));
  }
  return keys;
}

}  // namespace mesogen
