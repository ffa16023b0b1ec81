#include "case/case_reader.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "case/framework_keys.hpp"
#include "case/toml_text.hpp"
#include "case/value.hpp"
#include "mesogen/fields/dimensions.hpp"
#include "text/nearest.hpp"

namespace mesogen {

namespace {

class CaseReader {
 public:
  CaseReader(Case& target, Problems& problems) : case_(target), problems_(problems) {}

  void read() {
    check_names();
    read_units();
    read_domain();
    read_kernel();
    read_solids();
    read_particles();
    read_initial();
    read_time_and_output();
    case_.physics = instances("physics", {"type"});
    case_.observers = instances("observers", {"type", "interval", "every"});
    // An empty [physics] says on purpose that nothing happens: a scene for a kernel, a boundary or an observer alone.
    if (case_.tree->find("physics") == nullptr && !broken("physics"))
      problems_.add({case_.file, 1, 1}, "physics", "must hold at least one table with a type, such as [physics.flow]");
    for (const auto& observer : case_.observers) case_.timings.push_back(timing(observer.section));
    read_run();
  }

 private:
  void check_names() {
    std::vector<std::string> known = {"title"};
    for (const auto& section : case_keys::sections())
      if (!section.name.empty() && section.name.find('.') == std::string::npos && !section.plugin_named())
        known.push_back(section.name);
    for (const auto& [key, place, value] : *case_.tree->as<Value::Table>()) {
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        const std::string hint = did_you_mean(key, known);
        if (hint.empty() && value.as<Value::Table>() != nullptr) {
          initial_.emplace_back(key, place);
          continue;
        }
        misspelt_.push_back(nearest(key, known));
        problems_.add(place, key, "unknown section or key" + (hint.empty() ? "; known here: " + listed(known) : hint));
      } else if (key == "title") {
        CaseSection("", case_.tree, case_.tree->place).read_only(case_keys::title(case_.title), problems_);
      } else if (value.as<Value::Table>() == nullptr) {
        problems_.add(value.place, key, "must be a table, [" + key + "], but is " + shown(value));
      }
    }
  }

  static std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
  }

  /// Is there something by this name, or by one that means it, that check_names has refused?
  [[nodiscard]] bool broken(const std::string& name) const {
    const auto* const value = case_.tree->find(name);
    if (value == nullptr) return std::find(misspelt_.begin(), misspelt_.end(), name) != misspelt_.end();
    return value->as<Value::Table>() == nullptr;
  }

  [[nodiscard]] CaseSection section(const std::string& path) const {
    const auto* const value = case_.tree->find_path(path);
    if (value == nullptr || value->as<Value::Table>() == nullptr)
      return {path, nullptr, {case_.file, 1, 1}, case_.units};
    return {path, {case_.tree, value}, value->place, case_.units};
  }

  void read_keys(const CaseSection& from, const ParameterList& list, const std::vector<std::string>& other_keys = {}) {
    if (!broken(from.path())) from.read(list, problems_, other_keys);
  }

  void read_particles() { read_keys(section("particles"), case_keys::particles(case_.particles)); }

  void read_solids() {
    case_.shapes = instances(
        "solids",
        {"shape", "fluid", "velocity", "angular_velocity", "slip", "anchoring", "angle", "anchoring_strength", "order"},
        "shape");
    for (const auto& shape : case_.shapes) {
      Case::Solid& solid = case_.solids.emplace_back();
      shape.section.read_only(case_keys::solid(solid), problems_);
    }
  }

  /// What is no section of the framework's is called after an initial condition; whether there is one is for the
  /// registry to say.
  void read_initial() {
    for (const auto& [name, place] : initial_) case_.initial.push_back({name, name, section(name), name, place, {}});
  }

  void read_time_and_output() {
    read_keys(section("time"), case_keys::time(case_.time));
    case_.output.interval = case_.time.end;
    const CaseSection output = section("output");
    read_keys(output, case_keys::output(case_.output));
    case_.output.fields_given = output.has("fields");
    std::erase(case_.output.fields, "position");
  }

  void read_run() {
    std::string precision = "single";
    read_keys(section("run"), case_keys::run(case_.run, precision));
    for (const Precision one : {Precision::single_precision, Precision::double_precision})
      if (precision == to_string(one)) case_.run.precision = one;
  }

  void read_units() {
    const CaseSection units = section("units");
    read_keys(units, case_keys::units(case_.units));
    for (const auto& [key, name] :
         {std::pair{"length", &case_.units.length}, {"time", &case_.units.time}, {"force", &case_.units.force}}) {
      const bool word = !name->empty() && std::all_of(name->begin(), name->end(), [](unsigned char c) {
        return std::isalpha(c) != 0 || c > 127;  // um, or with a Greek letter
      });
      if (word) continue;
      problems_.add(units.place_of(key), units.full_key(key),
                    R"(must be the name of a unit, letters alone, such as "um", but is ")" + *name + "\"");
      *name = *key == 'l' ? "m" : (*key == 't' ? "s" : "N");
    }
  }

  /// Is there a space of this dimension, for which Mesogen is not built?
  static bool not_built(int dimension) {
    return DimensionSet(AllDimensions{}).contains(dimension) && !built_dimensions.contains(dimension);
  }

  void read_domain() {
    const CaseSection domain = section("domain");
    const auto* const value = case_.tree->find_path("domain.size");
    const auto* const list = value == nullptr ? nullptr : value->as<Value::List>();
    if (list != nullptr && not_built(static_cast<int>(list->size()))) {
      const std::string number = std::to_string(list->size());
      const std::string built = built_dimensions.text();
      problems_.add(value->place, "domain.size",
                    "has " + number + " numbers, which means " + number +
                        " dimensions, but this Mesogen is built for " + built + " dimensions: give " + built +
                        " numbers in " + case_.units.length);
      read_keys(domain, {}, {"size", "boundary"});
    } else {
      read_keys(domain, case_keys::domain(case_.domain), {"boundary"});
    }
    read_boundary(domain);
  }

  /// The choice that a section with a key `chooser` makes.
  PluginChoice choice(const CaseSection& from, std::vector<std::string> framework_keys,
                      const std::string& chooser = "type") {
    PluginChoice result{
        "", from.name(), from, from.full_key(chooser), from.place_of(chooser), std::move(framework_keys)};
    from.read_only(case_keys::plugin(result.type, chooser), problems_);
    if (from.has(chooser)) refuse_empty_name(case_.tree->find_path(result.type_key), result.type_key);
    return result;
  }

  void refuse_empty_name(const Value* value, const std::string& key) {
    const auto* const name = value == nullptr ? nullptr : value->as<std::string>();
    if (name != nullptr && name->empty())
      problems_.add(value->place, key, "must be the name of a plugin, but is empty; `mesogen plugin list` shows all");
  }

  void read_kernel() {
    const CaseSection kernel = section("kernel");
    if (broken("kernel")) return;
    case_.kernel = choice(kernel, {"type", "smoothing_length", "laplacian"});
    kernel.read_only(case_keys::kernel(case_.smoothing_length_ratio, case_.laplacian), problems_);
  }

  /// `boundary = "name"` or `boundary = { type = "name", key = value }`
  void read_boundary(const CaseSection& domain) {
    if (broken("domain")) return;
    const std::string path = "domain.boundary";
    const auto* const value = case_.tree->find_path(path);
    if (value == nullptr) {
      problems_.add(domain.place(), path, "must be given: a text (name of the plugin), or a table with its type");
    } else if (value->as<Value::Table>() != nullptr) {
      case_.boundary = choice(section(path), {"type"});
    } else if (const auto* const name = value->as<std::string>()) {
      refuse_empty_name(value, path);
      auto table = std::make_shared<Value>(Value{Value::Table{{"type", value->place, *value}}, value->place});
      case_.boundary = {*name, "boundary",   CaseSection(path, std::move(table), value->place, case_.units),
                        path,  value->place, {"type"}};
    } else {
      problems_.add(value->place, path,
                    "must be a text (name of the plugin), or a table with its type, but is " + shown(*value));
    }
  }

  /// Names of the tables that have such a key.
  static std::vector<std::string> with_key(const Value::Table& group, const std::string& key) {
    std::vector<std::string> names;
    for (const auto& [name, place, inner] : group)
      if (inner.find(key) != nullptr) names.push_back(name);
    return names;
  }

  std::vector<PluginChoice> instances(const std::string& group, const std::vector<std::string>& framework_keys,
                                      const std::string& chooser = "type") {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    std::vector<PluginChoice> choices;
    const auto* const value = case_.tree->find(group);
    const auto* const table = value == nullptr ? nullptr : value->as<Value::Table>();
    if (table == nullptr) return choices;
    for (const auto& [name, place, inner] : *table) {
      const std::string path = joined(group, name);
      if (inner.as<Value::Table>() == nullptr) {
        problems_.add(place, path, "must be a table with a " + chooser + ", [" + path + "], but is " + shown(inner));
      } else if (name.empty() || name.find_first_not_of(letters) != std::string::npos) {
        problems_.add(place, path, "the name may hold only letters, digits, _ and -");
      } else if (const std::string meant =
                     inner.find(chooser) == nullptr ? nearest(name, with_key(*table, chooser)) : "";
                 !meant.empty()) {
        problems_.add(inner.place, path + "." + chooser,
                      "must be given: a text (name of the plugin); did you mean \"" + joined(group, meant) + "\"?");
      } else {
        choices.push_back(choice(section(path), framework_keys, chooser));
      }
    }
    return choices;
  }

  ObserverTiming timing(const CaseSection& observer) {
    ObserverTiming result;
    std::int64_t every = 0;
    observer.read_only(case_keys::timing(result, every), problems_);
    if (every > 0) result.every = every;
    if (observer.has("interval") && observer.has("every"))
      problems_.add(observer.place_of("every"), observer.full_key("every"), "must not be given beside interval");
    return result;
  }

  Case& case_;
  Problems& problems_;
  std::vector<std::pair<std::string, SourcePlace>> initial_;  ///< sections that an initial condition may have
  std::vector<std::string> misspelt_;                         ///< sections that unknown names most likely mean
};

}  // namespace

void read_sections(Case& target, Problems& problems) { CaseReader(target, problems).read(); }

}  // namespace mesogen
