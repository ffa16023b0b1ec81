#include "case/section.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "case/parameter_value.hpp"
#include "case/toml_text.hpp"
#include "case/value.hpp"
#include "text/nearest.hpp"

namespace mesogen {

namespace {

/// Checks one table, and the tables in it, against a list of parameters.
class SectionReader {
 public:
  SectionReader(const CaseSection& section, const ParameterList& list, Problems& problems)
      : section_(section), list_(list), problems_(problems) {}

  void refuse_unknown(const Value& table, const std::string& path, const std::vector<std::string>& other_keys) {
    std::vector<std::string> known = keys_under(path);
    known.insert(known.end(), other_keys.begin(), other_keys.end());
    for (const auto& [key, place, value] : *table.as<Value::Table>()) {
      const std::string key_path = joined(path, key);
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        refuse_key(key, key_path, place, known);
      } else if (const auto inner = keys_under(key_path); !inner.empty()) {
        if (value.as<Value::Table>() != nullptr) {
          refuse_unknown(value, key_path, {});
        } else {
          problems_.add(value.place, section_.full_key(key_path),
                        "must be a table with the keys " + listed(inner) + ", but is " + shown(value));
          broken_tables_.push_back(key_path + ".");
        }
      }
    }
  }

  void take(const Value* table) {
    for (Parameter parameter : list_.all()) {
      parameter.unit_text = section_.units().text(parameter.unit_text);
      const Value* const value = table == nullptr ? nullptr : table->find_path(parameter.name);
      const bool unclear = wrong_.contains(parameter.condition_key);
      if (!list_.applies(parameter)) {
        if (value != nullptr && !unclear)
          problems_.add(value->place, section_.full_key(parameter.name),
                        "has a meaning only with " + parameter.condition_text());
      } else if (value != nullptr) {
        if (const auto refusal = take_value(parameter, *value)) {
          problems_.add(refusal->place, section_.full_key(parameter.name), refusal->text);
          wrong_.insert(parameter.name);
        }
      } else if (parameter.is_required) {
        wrong_.insert(parameter.name);
        if (explained(parameter.name) || unclear) continue;
        require(parameter);
      }
    }
  }

 private:
  void require(const Parameter& parameter) {
    std::string text = "must be given: " + expected_text(parameter);
    if (!parameter.doc_text.empty()) text += " (" + parameter.doc_text + ")";
    problems_.add(section_.place_of(parameter.name), section_.full_key(parameter.name), text);
  }

  static std::string listed(const std::vector<std::string>& keys) {
    std::string text;
    for (const auto& key : keys) text += (text.empty() ? "" : ", ") + key;
    return text;
  }

  /// The keys that may stand in the table at a path: of "bulk.A" and "bulk.C", those under "bulk" are A and C.
  [[nodiscard]] std::vector<std::string> keys_under(const std::string& path) const {
    const std::string prefix = path.empty() ? "" : path + ".";
    std::vector<std::string> keys;
    for (const auto& parameter : list_.all()) {
      if (!parameter.name.starts_with(prefix)) continue;
      std::string key = parameter.name.substr(prefix.size());
      key.resize(std::min(key.find('.'), key.size()));
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(std::move(key));
    }
    return keys;
  }

  void refuse_key(const std::string& key, const std::string& key_path, const SourcePlace& place,
                  const std::vector<std::string>& known) {
    const std::string meant = nearest(key, known);
    std::string text = "unknown key";
    if (const std::string advice = list_.moved_advice(key_path); !advice.empty()) {
      text = advice;
    } else if (!meant.empty()) {
      text += did_you_mean(key, known);
      misspelt_.push_back(key_path.substr(0, key_path.size() - key.size()) + meant);
    } else {
      text += known.empty() ? "; nothing can be set here" : "; known here: " + listed(known);
    }
    problems_.add(place, section_.full_key(key_path), text);
  }

  /// Has another problem been reported that tells why this key is missing?
  [[nodiscard]] bool explained(const std::string& name) const {
    return std::find(misspelt_.begin(), misspelt_.end(), name) != misspelt_.end() ||
           std::any_of(broken_tables_.begin(), broken_tables_.end(),
                       [&](const std::string& prefix) { return name.starts_with(prefix); });
  }

  const CaseSection& section_;
  const ParameterList& list_;
  Problems& problems_;
  std::set<std::string> wrong_;  // keys that are missing or refused: what depends on them is not known
  std::vector<std::string> misspelt_;
  std::vector<std::string> broken_tables_;
};

}  // namespace

CaseSection::CaseSection() = default;

CaseSection::CaseSection(std::string path, std::shared_ptr<const Value> table, SourcePlace place, Units units)
    : path_(std::move(path)), table_(std::move(table)), place_(std::move(place)), units_(std::move(units)) {}

std::string CaseSection::name() const { return path_.substr(path_.rfind('.') + 1); }

bool CaseSection::has(std::string_view key) const { return table_ != nullptr && table_->find_path(key) != nullptr; }

SourcePlace CaseSection::place_of(std::string_view key) const {
  if (table_ == nullptr) return place_;
  const auto place = table_->place_of_path(key);
  return place.file.empty() ? place_ : place;
}

std::string CaseSection::full_key(std::string_view key) const { return joined(path_, key); }

std::string CaseSection::type() const {
  const auto* const value = table_ == nullptr ? nullptr : table_->find("type");
  const auto* const text = value == nullptr ? nullptr : value->as<std::string>();
  return text == nullptr ? "" : *text;
}

void CaseSection::read(const ParameterList& list, Problems& problems,
                       const std::vector<std::string>& other_keys) const {
  SectionReader reader(*this, list, problems);
  if (table_ != nullptr) reader.refuse_unknown(*table_, "", other_keys);
  reader.take(table_.get());
}

void CaseSection::read_only(const ParameterList& list, Problems& problems) const {
  SectionReader(*this, list, problems).take(table_.get());
}

}  // namespace mesogen
