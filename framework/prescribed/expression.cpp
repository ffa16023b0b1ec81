#include "prescribed/expression.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <deque>
#include <numbers>

#include "mesogen/diagnostics/error.hpp"
#include "text/nearest.hpp"

namespace mesogen {

namespace {

using exec::Operation;

// muParser reads the text and calls an operator or a function for each step of the evaluation. Here its numbers are the
// numbers of values of a program, and the steps write that program: one evaluation records the formula.
thread_local ProgramWriter* recording = nullptr;

template <Operation operation>
double one(double a) {
  return recording->apply(operation, static_cast<int>(a));
}
template <Operation operation>
double two(double a, double b) {
  return recording->apply(operation, static_cast<int>(a), static_cast<int>(b));
}
template <Operation operation>
double swapped(double a, double b) {
  return two<operation>(b, a);
}
double three(double a, double b, double c) {
  return recording->apply(Operation::choose, static_cast<int>(a), static_cast<int>(b), static_cast<int>(c));
}
double same(double a) { return a; }

int read_number(const char* text, int* position, double* value) {
  if (std::isdigit(static_cast<unsigned char>(*text)) == 0 && *text != '.') return 0;
  double number = 0.0;
  const auto [end, failure] = std::from_chars(text, text + std::strlen(text), number);
  if (failure != std::errc()) return 0;
  *position += static_cast<int>(end - text);
  *value = recording->constant(number);
  return 1;
}

struct Function {
  const char* name;
  double (*call)(double);
};
constexpr Function functions[] = {{"sin", one<Operation::sine>},
                                  {"cos", one<Operation::cosine>},
                                  {"tan", one<Operation::tangent>},
                                  {"asin", one<Operation::arcsine>},
                                  {"acos", one<Operation::arccosine>},
                                  {"atan", one<Operation::arctangent>},
                                  {"sinh", one<Operation::hyperbolic_sine>},
                                  {"cosh", one<Operation::hyperbolic_cosine>},
                                  {"tanh", one<Operation::hyperbolic_tangent>},
                                  {"exp", one<Operation::exponential>},
                                  {"log", one<Operation::logarithm>},
                                  {"log10", one<Operation::decimal_logarithm>},
                                  {"sqrt", one<Operation::root>},
                                  {"abs", one<Operation::absolute>},
                                  {"floor", one<Operation::lower_integer>},
                                  {"sign", one<Operation::sign>}};

struct Function2 {
  const char* name;
  double (*call)(double, double);
};
constexpr Function2 functions_of_two[] = {{"min", two<Operation::minimum>},
                                          {"max", two<Operation::maximum>},
                                          {"mod", two<Operation::modulus>},
                                          {"atan2", two<Operation::angle>}};

struct Operator {
  const char* name;
  double (*call)(double, double);
  unsigned precedence;
};
constexpr Operator operators[] = {
    {"||", two<Operation::either>, mu::prLOR},      {"&&", two<Operation::both>, mu::prLAND},
    {"<", two<Operation::less>, mu::prCMP},         {"<=", two<Operation::less_or_equal>, mu::prCMP},
    {">", swapped<Operation::less>, mu::prCMP},     {">=", swapped<Operation::less_or_equal>, mu::prCMP},
    {"==", two<Operation::equal>, mu::prCMP},       {"!=", two<Operation::unequal>, mu::prCMP},
    {"+", two<Operation::add>, mu::prADD_SUB},      {"-", two<Operation::subtract>, mu::prADD_SUB},
    {"*", two<Operation::multiply>, mu::prMUL_DIV}, {"/", two<Operation::divide>, mu::prMUL_DIV},
    {"^", two<Operation::power>, mu::prPOW}};

void define_grammar(mu::Parser& parser) {
  parser.ClearConst();
  parser.ClearFun();
  parser.EnableBuiltInOprt(false);
  parser.AddValIdent(read_number);
  for (const auto& [name, call] : functions) parser.DefineFun(name, call, false);
  for (const auto& [name, call] : functions_of_two) parser.DefineFun(name, call, false);
  parser.DefineFun("if", three, false);
  for (const auto& [name, call, precedence] : operators)
    parser.DefineOprt(name, call, precedence, *name == '^' ? mu::oaRIGHT : mu::oaLEFT, false);
  parser.DefineInfixOprt("-", one<Operation::negative>, mu::prINFIX, false);
  parser.DefineInfixOprt("+", same, mu::prINFIX, false);
  parser.DefineInfixOprt("!", one<Operation::invert>, mu::prINFIX, false);
}

/// Third parties may publish constants by other names.
bool is_name(const std::string& text) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) == 0 &&
         std::ranges::all_of(text, fits);
}

std::vector<std::string> names_of(const std::map<std::string, int>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) names.push_back(name);
  return names;
}

struct Habit {
  const char* written;
  const char* advice;
};
/// What other languages write, and what to write here.
constexpr Habit habits[] = {{"**", "a power is x^2"},
                            {"%", "a remainder is mod(a, b)"},
                            {"?", "to choose between two values write if(condition, this, otherwise)"},
                            {":", "to choose between two values write if(condition, this, otherwise)"},
                            {".png", "an image is a table: { image = \"mask.png\", low = 0.0, high = 0.1 }"},
                            {";", "write one formula"},
                            {"\"", "write one formula, without quotes in it"}};
constexpr Habit habits_of_names[] = {{"and", "write &&"},
                                     {"or", "write ||"},
                                     {"not", "write !"},
                                     {"ln", "write log(x)"},
                                     {"pow", "a power is x^2"},
                                     {"hypot", "write sqrt(x^2 + y^2)"},
                                     {"if", "write if(condition, this, otherwise)"},
                                     {"m", "numbers have no units here"},
                                     {"s", "numbers have no units here"},
                                     {"Pa", "numbers have no units here"}};

void refuse_habits(const std::string& text) {
  for (const auto& [written, advice] : habits)
    if (text.find(written) != std::string::npos)
      throw Error(ExitCode::bad_case, fmt::format("holds '{}': {}", written, advice));
  if (std::ranges::any_of(text, [](unsigned char c) { return c > 127; }))
    throw Error(ExitCode::bad_case, "holds a character that is on no plain keyboard: write x^2, <=, *, pi");
}

[[noreturn]] void refuse_name(const std::string& name, const std::vector<std::string>& known, const Vocabulary& words) {
  if (const auto found = words.refused.find(name); found != words.refused.end())
    throw Error(ExitCode::bad_case, fmt::format("\"{}\" {}", name, found->second));
  for (const auto& [written, advice] : habits_of_names)
    if (name == written) throw Error(ExitCode::bad_case, fmt::format("\"{}\" is not known: {}", name, advice));
  std::vector<std::string> calls = {"if"};
  for (const auto& [function, call] : functions) calls.emplace_back(function);
  for (const auto& [function, call] : functions_of_two) calls.emplace_back(function);
  std::vector<std::string> all = known;
  all.insert(all.end(), calls.begin(), calls.end());
  const std::string meant = did_you_mean(name, all);
  throw Error(ExitCode::bad_case,
              fmt::format("\"{}\" is not known{} There are {}; and the functions {}", name, meant.empty() ? "." : meant,
                          fmt::join(known, ", "), fmt::join(calls, ", ")));
}

}  // namespace

Vocabulary vocabulary_of(const Scene& scene) {
  Vocabulary words;
  words.dimension = scene.dimension;
  words.constants = scene.constants;
  constexpr const char* edges[] = {"Lx", "Ly", "Lz"};
  for (int d = 0; d < words.dimension; ++d) words.constants[edges[d]] = scene.box[static_cast<std::size_t>(d)];
  return words;
}

Program parse_expression(const std::string& text, const Vocabulary& words) {
  refuse_habits(text);
  ProgramWriter writer;
  std::map<std::string, int> values;
  constexpr const char* axes[] = {"x", "y", "z"};
  for (int d = 0; d < words.dimension; ++d) values[axes[d]] = writer.coordinate(d);
  if (words.time) values["t"] = writer.time();
  values["pi"] = writer.constant(std::numbers::pi);
  for (const auto& [name, value] : words.constants)
    if (!values.contains(name) && is_name(name)) values[name] = writer.constant(value);
  for (const std::string& field : words.fields)
    if (!values.contains(field)) values[field] = writer.field(field);

  recording = &writer;
  try {
    mu::Parser parser;
    define_grammar(parser);
    std::deque<double> places;  // muParser keeps pointers
    for (const auto& [name, value] : values) parser.DefineVar(name, &places.emplace_back(value));
    parser.SetExpr(text);
    const double result = parser.Eval();
    if (parser.GetNumResults() > 1)
      throw Error(ExitCode::bad_case, "has several results, apart by commas: it must give one number");
    return writer.finish(static_cast<int>(result));
  } catch (const mu::Parser::exception_type& error) {
    const std::string& token = error.GetToken();
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN && !token.empty() &&
        std::isalpha(static_cast<unsigned char>(token.front())) != 0)
      refuse_name(token, names_of(values), words);
    throw Error(ExitCode::bad_case, "cannot be read: " + error.GetMsg());
  }
}

}  // namespace mesogen
