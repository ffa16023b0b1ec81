#include "prescribed/program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "error_of.hpp"
#include "exec/program_evaluation.hpp"

namespace mesogen {
namespace {

using exec::Operation;

/// At x = 0.5.
double value(const Program& program) {
  const exec::Surroundings<double> around;
  exec::LocalSlots<1> slots;
  exec::Evaluation<double, 1, exec::LocalSlots<1>> evaluation(program.view(), around, slots);
  const exec::Place<1> place{{{0.5}, {0.0}, {0.0}}, 0, 1};
  return *evaluation.at(place);
}

/// 0 x + (1 x + (2 x + ...)), where all products are made before the first sum if nobody looks ahead.
Program long_sum(int terms) {
  ProgramWriter writer;
  const int x = writer.coordinate(0);
  std::vector<int> all;
  for (int n = 0; n < terms; ++n) all.push_back(writer.apply(Operation::multiply, x, writer.constant(n)));
  int sum = all.back();
  for (int n = terms - 2; n >= 0; --n) sum = writer.apply(Operation::add, all[static_cast<std::size_t>(n)], sum);
  return writer.finish(sum);
}

TEST(Program, KeepsFewValues) {
  const Program program = long_sum(30);
  EXPECT_LE(program.slots, 5);
  EXPECT_EQ(value(program), 0.5 * 29 * 30 / 2);
}

// Loops over several particles at a time count on it.
TEST(Program, WritesToNoSlotThatItReads) {
  ProgramWriter writer;
  int last = writer.coordinate(0);
  for (int n = 0; n < 10; ++n) {
    const int root = writer.apply(Operation::root, last);
    const int less = writer.apply(Operation::less, root, writer.constant(n));
    last = writer.apply(Operation::choose, less, writer.apply(Operation::negative, root), root);
  }
  for (const Program& program : {long_sum(20), writer.finish(last)})
    for (const exec::Instruction& one : program.code) {
      if (one.operation < Operation::negative) continue;  // it reads no slot
      EXPECT_NE(one.to, one.a);
      EXPECT_TRUE(one.operation < Operation::add || one.to != one.b);
      EXPECT_TRUE(one.operation != Operation::choose || one.to != one.c);
    }
}

TEST(Program, KeepsWhatIsReadLater) {
  ProgramWriter writer;
  const int x = writer.coordinate(0);
  const int root = writer.apply(Operation::root, x);
  const int shared = writer.apply(Operation::add, root, root);
  const int chosen = writer.apply(Operation::choose, shared, writer.apply(Operation::multiply, shared, root), x);
  EXPECT_NEAR(value(writer.finish(writer.apply(Operation::subtract, chosen, shared))), 1.0 - std::sqrt(2.0), 1e-15);
}

TEST(Program, ThatKeepsTooManyValuesIsRefused) {
  ProgramWriter writer;
  std::vector<int> all = {writer.coordinate(0)};
  for (int n = 0; n < 30; ++n) all.push_back(writer.apply(Operation::arctangent, all.back()));
  int sum = all.front();
  int product = all.front();
  for (const int one : all) {
    sum = writer.apply(Operation::add, sum, one);
    product = writer.apply(Operation::multiply, product, one);
  }
  const int both = writer.apply(Operation::divide, product, sum);
  const std::string text = error_of([&] { (void)writer.finish(both); }, ExitCode::bad_case);
  EXPECT_NE(text.find("numbers for later, and 24 are the most: shorten it"), std::string::npos) << text;
}

}  // namespace
}  // namespace mesogen
