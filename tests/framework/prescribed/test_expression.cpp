#include "prescribed/expression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "error_of.hpp"
#include "exec/program_evaluation.hpp"
#include "mesogen/exec/for_each.hpp"

namespace mesogen {
namespace {

Vocabulary words() {
  Vocabulary all;
  all.constants = {{"viscosity", 0.5}};
  all.fields = {"solute"};
  all.refused = {{"elastic_constant", "is prescribed itself"}};
  return all;
}

/// The value at (x, y) = (0.3, 0.8), t = 2, where the solute is 0.25.
double value(const std::string& text) {
  const Program program = parse_expression(text, words());
  const double x = 0.3;
  const double y = 0.8;
  const double solute = 0.25;
  double result = 0.0;
  exec::EvaluateArguments<double> arguments{};
  arguments.program = program.view();
  arguments.around.position[0] = &x;
  arguments.around.position[1] = &y;
  arguments.around.dimension = 2;
  arguments.around.time = 2.0;
  arguments.around.field[0] = {&solute, 0};
  arguments.result = &result;
  exec::for_each({}, 1, exec::EvaluateProgram<double, 4>{arguments, 1});
  return result;
}

TEST(Expression, HasTheUsualRules) {
  const double x = 0.3;
  const double y = 0.8;
  const double t = 2.0;
  const std::vector<std::pair<const char*, double>> expected = {
      {"0.08 * (x < 5)", 0.08},
      {"0.08 * (x >= 5)", 0.0},
      {"1 + 2 * 3 - 4 / 8", 6.5},
      {"-x^2", -x * x},
      {"2^3^2", 512.0},
      {"2 - 3 - 4", -5.0},
      {"8 / 4 / 2", 1.0},
      {"2^-1", 0.5},
      {"1e-3 + .5 + 2E2", 200.501},
      {"x > 0.2 && y > 0.9 || t == 2", 1.0},
      {"!(x != 0.3)", 1.0},
      {"x <= 0.3", 1.0},
      {"if(x < y, 10 * t, 3)", 20.0},
      {"min(x, y) + max(x, y)", x + y},
      {"mod(-0.25, 1)", 0.75},
      {"atan2(1, -1)", 0.75 * std::numbers::pi},
      {"exp(-((x - 1)^2 + y^2) / 0.5)", std::exp(-(0.49 + y * y) / 0.5)},
      {"sin(2 * pi * x) * cos(y) + tan(x)", std::sin(2.0 * std::numbers::pi * x) * std::cos(y) + std::tan(x)},
      {"asin(x) + acos(x) + atan(x)", std::asin(x) + std::acos(x) + std::atan(x)},
      {"sinh(x) - cosh(x) + tanh(x)", std::sinh(x) - std::cosh(x) + std::tanh(x)},
      {"log(t) + log10(t) + sqrt(y)", std::log(t) + std::log10(t) + std::sqrt(y)},
      {"abs(-x) + floor(-x) + sign(-x) + sign(0)", x - 1.0 - 1.0},
      {"viscosity * solute", 0.125},
  };
  for (const auto& [text, number] : expected)
    EXPECT_NEAR(value(text), number, 1e-14 * (1.0 + std::abs(number))) << text;
}

// A single number needs no field.
TEST(Expression, ThatIsTheSameEverywhereIsANumber) {
  for (const char* const text : {"0.5", "2 * viscosity", "if(1 < 2, sqrt(4), x)"})
    EXPECT_EQ(parse_expression(text, words()).constant(), std::string(text).find('x') == std::string::npos) << text;
  EXPECT_EQ(parse_expression("sqrt(16) * viscosity", words()).number(), 2.0);
  EXPECT_FALSE(parse_expression("0 * x", words()).constant());
}

TEST(Expression, TellsWhatItDependsOn) {
  EXPECT_TRUE(parse_expression("x + t", words()).changes_in_time());
  EXPECT_FALSE(parse_expression("x + 0", words()).changes_in_time());
  EXPECT_EQ(parse_expression("x + solute", words()).fields, std::vector<std::string>{"solute"});
  EXPECT_TRUE(parse_expression("x", words()).fields.empty());
}

TEST(Expression, ThatCannotBeReadIsRefused) {
  const auto refusal = [](const std::string& text) {
    return error_of([&] { (void)parse_expression(text, words()); }, ExitCode::bad_case);
  };
  EXPECT_NE(
      refusal("0.08 * (visosity < 5)")
          .find("\"visosity\" is not known; did you mean \"viscosity\"? There are pi, solute, t, viscosity, x, y; "
                "and the functions if, sin, cos"),
      std::string::npos)
      << refusal("0.08 * (visosity < 5)");
  EXPECT_NE(refusal("qq").find("\"qq\" is not known. There are pi, "), std::string::npos) << refusal("qq");
  EXPECT_EQ(refusal("2 * elastic_constant"), "\"elastic_constant\" is prescribed itself");
  EXPECT_EQ(refusal("x < 5 ? 1 : 2"), "holds '?': to choose between two values write if(condition, this, otherwise)");
  EXPECT_EQ(refusal("x**2"), "holds '**': a power is x^2");
  EXPECT_EQ(refusal("x % 2"), "holds '%': a remainder is mod(a, b)");
  EXPECT_EQ(refusal("mask.png"), "holds '.png': an image is a table: { image = \"mask.png\", low = 0.0, high = 0.1 }");
  EXPECT_EQ(refusal("x; y"), "holds ';': write one formula");
  EXPECT_EQ(refusal("2 * \xcf\x80"), "holds a character that is on no plain keyboard: write x^2, <=, *, pi");
  EXPECT_EQ(refusal("2 < x < 5"), "compares the result of a comparison: for a range write (2 < x) && (x < 5)");
  EXPECT_EQ(refusal("ln(x)"), "\"ln\" is not known: write log(x)");
  EXPECT_EQ(refusal("if (x < 5) 1 else 2"), "\"if\" is not known: write if(condition, this, otherwise)");
  EXPECT_EQ(refusal("3 Pa"), "\"Pa\" is not known: numbers have no units here");
  EXPECT_EQ(refusal("x, y"), "has several results, apart by commas: it must give one number");
  EXPECT_NE(refusal("0.08 * (x < 5").find("cannot be read: "), std::string::npos);
  EXPECT_NE(refusal("x = 5").find("cannot be read: "), std::string::npos) << refusal("x = 5");
  EXPECT_NE(refusal("").find("cannot be read: "), std::string::npos);
  EXPECT_NE(refusal("sin(x, y)").find("cannot be read: "), std::string::npos);
  std::string longest = "x";
  for (int n = 0; n < 100; ++n) longest += " + x * " + std::to_string(n);
  EXPECT_NE(refusal(longest).find("operations and numbers, and 96 are the most: shorten it"), std::string::npos);
}

}  // namespace
}  // namespace mesogen
