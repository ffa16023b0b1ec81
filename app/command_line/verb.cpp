#include "command_line/verb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace mesogen::app {

namespace {

using Row = std::pair<std::string, std::string>;

/// Two columns, the second one wrapped. Beside a long name there is no text: it begins on the next line.
std::string table(const std::string& title, const std::vector<Row>& rows) {
  constexpr std::size_t line_width = 80;
  constexpr std::size_t name_width = 20;
  const std::string indent(name_width + 4, ' ');
  std::string text = rows.empty() ? "" : "\n" + title + ":\n";
  for (const auto& [name, meaning] : rows) {
    std::string line = fmt::format("  {:<{}}  ", name, name_width);
    if (line.size() > indent.size()) {
      text += "  " + name + "\n";
      line = indent;
    }
    std::istringstream words(meaning);
    for (std::string word; words >> word; line += word + ' ') {
      if (line.size() + word.size() <= line_width) continue;
      text += line.substr(0, line.size() - 1) + "\n";
      line = indent;
    }
    text += line.substr(0, line.size() - 1) + "\n";
  }
  return text;
}

std::vector<Row> rows(const std::vector<Option>& options) {
  std::vector<Row> all;
  for (const Option& one : options) {
    const std::string letter = one.rules.letter == '\0' ? "" : fmt::format("-{}, ", one.rules.letter);
    all.emplace_back(letter + one.name + (one.name.empty() || one.value.empty() ? "" : " ") + one.value, one.help);
  }
  return all;
}

}  // namespace

Verb::Verb(std::string called, std::string about, Action task)
    : name(std::move(called)), summary(std::move(about)), action(std::move(task)) {
  flag("--help", &help_wanted, "Print this help", {.letter = 'h'});
  flag("--help-all", &help_all_wanted, "Print this help, and that of all verbs below");
}

Verb& Verb::verb(const std::string& last_word, const std::string& about, const Action& task) {
  return verbs.emplace_back(name + " " + last_word, about, task);
}

void Verb::argument(const std::string& value, Target target, const std::string& help, const Rules& rules) {
  arguments.push_back({"", value, target, help, rules});
}

void Verb::option(const std::string& called, const std::string& value, Target target, const std::string& help,
                  const Rules& rules) {
  options.push_back({called, value, target, help, rules});
}

void Verb::flag(const std::string& called, Target target, const std::string& help, const Rules& rules) {
  options.push_back({called, "", target, help, rules});
}

std::string Verb::usage() const {
  std::string text = name;
  for (const Option& one : arguments) text += one.rules.required ? " " + one.value : " [" + one.value + "]";
  return text + (verbs.empty() ? " [OPTIONS]" : " VERB");
}

std::string Verb::help() const {
  std::vector<Row> words;
  for (const Verb& one : verbs) words.emplace_back(one.word(), one.summary);
  return summary + "\n\nUsage: " + usage() + "\n" + table(fmt::format("Verbs (more: {} VERB --help)", name), words) +
         table("Arguments", rows(arguments)) + table("Options", rows(options));
}

std::string Verb::help_all() const {
  std::string text = help();
  for (const Verb& one : verbs) text += "\n\n" + one.help_all();
  return text;
}

}  // namespace mesogen::app
