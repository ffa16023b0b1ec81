// The only file that sees Boost.Program_options: its headers take seconds to compile.

#include "command_line/parse.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <charconv>
#include <set>

#include "text/nearest.hpp"

namespace mesogen::app {

namespace {

namespace po = boost::program_options;

template <class Number>
std::optional<Number> read_number(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

/// What the value of an option must be, if this text is no such value.
std::string unmet(const Option& option, const std::string& text) {
  const auto [lowest, highest] = std::pair(option.rules.lowest, option.rules.highest);
  if (std::holds_alternative<std::optional<double>*>(option.target) && !number(text)) return "a number";
  if (const auto value = read_number<int>(text); !lowest || (value && *value >= *lowest && *value <= highest))
    return {};
  if (highest < no_limit) return fmt::format("a whole number from {} to {}", *lowest, highest);
  return *lowest == -no_limit ? "a whole number" : fmt::format("a whole number of at least {}", *lowest);
}

/// Puts a text that is fit for it where the value of an option goes.
struct Put {
  const Option& option;
  const std::string& text;

  void operator()(bool* target) const { *target = true; }
  void operator()(int* target) const { *target = *read_number<int>(text); }
  void operator()(std::optional<double>* target) const { *target = number(text); }
  void operator()(std::string* target) const { *target = text; }
  void operator()(std::vector<std::string>* target) const { target->push_back(text); }
  void operator()(Forwarded* target) const {
    if (option.name.empty())
      target->arguments.push_back(text);
    else
      target->options.push_back(option.value.empty() ? option.name : option.name + "=" + text);
  }
};

/// By its name or its letter; nullptr if there is none.
const Option* find(const Verb& verb, std::string_view name) {
  const auto found = std::ranges::find_if(verb.options, [&](const Option& one) {
    return one.name == name || (name.size() == 2 && one.rules.letter == name[1]);
  });
  return found == verb.options.end() ? nullptr : &*found;
}

/// "; did you mean ...", or all that there are.
std::string hint(const std::string& word, const std::vector<std::string>& all) {
  const std::string nearest = did_you_mean(word, all);
  return nearest.empty() ? fmt::format("; there are: {}", fmt::join(all, ", ")) : nearest;
}

[[noreturn]] void fail(const Verb& verb, const std::string& what) { throw Error(ExitCode::bad_case, verb.name + what); }

/// Options and arguments as given; an argument has no string_key.
std::vector<po::option> split(const Verb& verb, std::span<const std::string> words) {
  po::options_description known;
  std::vector<std::string> names;
  for (const Option& one : verb.options) {
    names.push_back(one.name);
    const std::string name =
        one.name.substr(2) + (one.rules.letter == '\0' ? "" : fmt::format(",{}", one.rules.letter));
    if (one.value.empty())
      known.add_options()(name.c_str(), "");
    else
      known.add_options()(name.c_str(), po::value<std::string>());
  }
  // An abbreviation would stop working once another option begins like it.
  constexpr int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  try {
    return po::command_line_parser({words.begin(), words.end()}).options(known).style(style).run().options;
  } catch (const po::error_with_option_name& error) {
    const std::string given = error.get_option_name();
    const std::string name = given.substr(0, given.find('='));
    const Option* const option = find(verb, name);
    if (option == nullptr) fail(verb, fmt::format(" has no option \"{}\"{}", name, hint(name, names)));
    if (option->value.empty()) fail(verb, fmt::format(": {} takes no value", option->name));
    fail(verb, fmt::format(": {0} needs a value: {0} {1}", option->name, option->value));
  }
}

void check_together(const Verb& verb, const std::set<std::string>& given) {
  for (const Option& one : verb.options) {
    if (!given.contains(one.name)) continue;
    for (const std::string& other : one.rules.excludes)
      if (given.contains(other)) fail(verb, fmt::format(": {} excludes {}: give one of them", one.name, other));
    if (const auto& other = one.rules.needs; !other.empty() && !given.contains(other))
      fail(verb, fmt::format(": {} needs {} as well", one.name, other));
  }
}

void read_options(const Verb& verb, std::span<const std::string> words) {
  std::set<std::string> given;
  std::size_t place = 0;
  for (const po::option& one : split(verb, words)) {
    const std::string text = one.value.empty() ? "" : one.value.front();
    const bool is_argument = one.string_key.empty();
    if (is_argument && place == verb.arguments.size())
      fail(verb, fmt::format(": \"{}\" is one argument too many\n  usage: {}", text, verb.usage()));
    // split() lets no other through. NOLINTNEXTLINE(clang-analyzer-core.NullDereference)
    const Option& option = is_argument ? verb.arguments[place++] : *find(verb, "--" + one.string_key);
    const bool may_repeat = option.value.empty() || option.rules.repeated ||
                            std::holds_alternative<std::vector<std::string>*>(option.target);
    if (!given.insert(option.title()).second && !may_repeat)
      fail(verb, fmt::format(": {} is given twice", option.name));
    if (const std::string what = unmet(option, text); !what.empty())
      fail(verb, fmt::format(": {} must be {}, not \"{}\"", option.title(), what, text));
    std::visit(Put{option, text}, option.target);
  }
  if (verb.help_wanted || verb.help_all_wanted) return;
  if (place < verb.arguments.size() && verb.arguments[place].rules.required) {
    const Option& missing = verb.arguments[place];
    fail(verb, fmt::format(": {0} is missing\n  {0}: {1}\n  usage: {2}", missing.value, missing.help, verb.usage()));
  }
  check_together(verb, given);
}

Action print(std::FILE* stream, const std::string& text, ExitCode code) {
  return [=] {
    fmt::print(stream, "{}", text);
    return code;
  };
}

}  // namespace

std::optional<double> number(std::string_view text) { return read_number<double>(text); }

Action parse(Verb& verb, std::span<const std::string> words) {
  // The options of a verb with verbs of its own end where one of those begins.
  const auto next = verb.verbs.empty()
                        ? words.end()
                        : std::ranges::find_if(words, [](const std::string& word) { return !word.starts_with('-'); });
  read_options(verb, {words.begin(), next});
  if (verb.help_all_wanted) return print(stdout, verb.help_all(), ExitCode::done);
  if (verb.help_wanted) return print(stdout, verb.help(), ExitCode::done);
  if (next == words.end()) return verb.action ? verb.action : print(stderr, verb.help(), ExitCode::bad_case);
  std::vector<std::string> known;
  for (Verb& one : verb.verbs) {
    if (one.word() == *next) return parse(one, {next + 1, words.end()});
    known.push_back(one.word());
  }
  fail(verb, fmt::format(" has no verb \"{}\"{}", *next, hint(*next, known)));
}

}  // namespace mesogen::app
