#pragma once

#include <functional>
#include <limits>
#include <list>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mesogen/diagnostics/error.hpp"

/// The command line as it is declared: verbs, each with its arguments and options. parse.hpp reads what a user gives.
namespace mesogen::app {

/// What was given to a verb that another program carries out.
struct Forwarded {
  std::vector<std::string> options;  ///< "--quiet", "--output=DIR"
  std::vector<std::string> arguments;
};

/// Where a value goes. A list takes the values of an option that is given several times.
using Target = std::variant<bool*, int*, std::optional<double>*, std::string*, std::vector<std::string>*, Forwarded*>;

constexpr int no_limit = std::numeric_limits<int>::max();

struct Rules {
  char letter = '\0';    ///< 'o' for -o
  bool required = true;  ///< of an argument
  bool repeated = false;
  std::optional<int> lowest{};  ///< -no_limit, or more: the value is a whole number
  int highest = no_limit;
  std::vector<std::string> excludes{};  ///< options that cannot be given together with this one
  std::string needs{};                  ///< an option without which this one has no meaning
};

/// An option, or an argument, which is known by its place.
struct Option {
  std::string name;   ///< "--output"; empty for an argument
  std::string value;  ///< the name of its value, "DIR"; empty for a flag
  Target target;
  std::string help;
  Rules rules;

  [[nodiscard]] const std::string& title() const { return name.empty() ? value : name; }
};

using Action = std::function<ExitCode()>;

/// The command itself, one of its verbs, or a verb of a verb.
struct Verb {
  /// `called`: with the words before it, "mesogen plugin new". No action: it only has verbs of its own.
  Verb(std::string called, std::string about, Action task = {});
  Verb(const Verb&) = delete;
  Verb& operator=(const Verb&) = delete;

  Verb& verb(const std::string& last_word, const std::string& about, const Action& task = {});
  void argument(const std::string& value, Target target, const std::string& help, const Rules& rules = {});
  void option(const std::string& called, const std::string& value, Target target, const std::string& help,
              const Rules& rules = {});
  void flag(const std::string& called, Target target, const std::string& help, const Rules& rules = {});

  /// The last word of the name.
  [[nodiscard]] std::string word() const { return name.substr(name.rfind(' ') + 1); }
  /// "mesogen run CASE [OPTIONS]"
  [[nodiscard]] std::string usage() const;
  /// What --help prints, and --help-all.
  [[nodiscard]] std::string help() const;
  [[nodiscard]] std::string help_all() const;

  const std::string name;
  const std::string summary;
  const Action action;
  std::list<Verb> verbs;
  std::vector<Option> arguments;
  std::vector<Option> options;
  bool help_wanted = false;
  bool help_all_wanted = false;
};

}  // namespace mesogen::app
