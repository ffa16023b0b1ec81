#include "case/declared_sections.hpp"

namespace mesogen {

namespace {

/// The name of a plugin, then the framework's other keys of that section.
std::vector<DeclaredKey> with_type(const std::vector<DeclaredKey>& others = {}, const std::string& chooser = "type") {
  std::string type;
  auto keys = declared_keys(case_keys::plugin(type, chooser));
  keys.insert(keys.end(), others.begin(), others.end());
  return keys;
}

std::vector<DeclaredKey> keys_of(const std::string& section) {
  Case any;
  std::string word = "single";
  ObserverTiming timing;
  Case::Solid solid;
  std::int64_t every = 0;
  if (section.empty()) return declared_keys(case_keys::title(any.title));
  if (section == "units") return declared_keys(case_keys::units(any.units));
  if (section == "domain") return declared_keys(case_keys::domain(any.domain));
  if (section == "solids") return with_type(declared_keys(case_keys::solid(solid)), "shape");
  if (section == "particles") return declared_keys(case_keys::particles(any.particles));
  if (section == "kernel")
    return with_type(declared_keys(case_keys::kernel(any.smoothing_length_ratio, any.laplacian)));
  if (section == "time") return declared_keys(case_keys::time(any.time));
  if (section == "output") return declared_keys(case_keys::output(any.output));
  if (section == "observers") return with_type(declared_keys(case_keys::timing(timing, every)));
  if (section == "run") return declared_keys(case_keys::run(any.run, word));
  if (section == "NAME") return {};
  return with_type();
}

}  // namespace

std::vector<DeclaredSection> declared_sections() {
  std::vector<DeclaredSection> all;
  for (const auto& section : case_keys::sections()) all.push_back({section, keys_of(section.name)});
  return all;
}

}  // namespace mesogen
