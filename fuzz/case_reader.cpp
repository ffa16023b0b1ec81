// Any text as a case, with what follows its first NUL as overrides, a line each: read or refused with a reason. What is
// accepted must survive being written and read again.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/resolved.hpp"

namespace {

using namespace mesogen;

/// Keys of every kind, as a plugin has them.
struct Parameters {
  double viscosity = 0.5;
  double a = -1.0;
  std::optional<double> sound_speed;
  std::int64_t count = 16;
  bool feedback = false;
  std::string form = "component";
  std::vector<double> angles;
  std::vector<std::string> names;
  Parameter::Rows modes;
  ParameterList list;

  Parameters() {
    list.number("viscosity", viscosity).above(0.0);
    list.number("bulk.A", a).at_most(10.0);
    list.number_or("sound_speed", sound_speed, "auto").above(0.0);
    list.integer("count", count).at_least(1.0);
    list.flag("filter_feedback", feedback);
    list.text("viscosity_form", form).choices({"component", "monaghan_gingold"});
    list.numbers("particles", angles).at_least(0.0);
    list.texts("names", names);
    list.rows("modes", modes).sizes({4});
  }
};

[[noreturn]] void fail(const char* what, const std::string& text) {
  std::fprintf(stderr, "%s:\n%s\n", what, text.c_str());
  std::abort();
}

/// The resolved text, plugins' parameters filled in; empty if there are problems.
std::string resolved(const std::string& text, const std::vector<std::string>& overrides, Problems& problems) {
  const Case read = read_case_text(text, "case.toml", overrides, problems);
  if (read.tree == nullptr) return {};
  ResolvedCase whole(read);
  for (const auto* const group : {&read.physics, &read.observers})
    for (const PluginChoice& choice : *group) {
      Parameters parameters;
      choice.read(parameters.list, problems);
      whole.add(choice.section, parameters.list);
    }
  return problems.empty() ? whole.text() : std::string();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  const auto end = std::min(input.find('\0'), input.size());
  std::vector<std::string> overrides;
  std::istringstream rest(end < size ? input.substr(end + 1) : std::string());
  for (std::string line; std::getline(rest, line) && overrides.size() < 4;) overrides.push_back(line);

  Problems problems;
  const std::string once = resolved(input.substr(0, end), overrides, problems);
  if (!problems.empty()) {
    const std::string said = problems.text();
    if (said.find("case.toml") == std::string::npos && said.find("--set") == std::string::npos)
      fail("a problem without its place", said);
    if (said.find('\033') != std::string::npos) fail("a terminal would obey this", said);
    return 0;
  }
  const std::string twice = resolved(once, {}, problems);
  if (!problems.empty()) fail("accepted, written, and refused", problems.text() + once);
  if (twice != once) fail("accepted, written, and read as another case", once + "\n--- is read as\n" + twice);
  return 0;
}
