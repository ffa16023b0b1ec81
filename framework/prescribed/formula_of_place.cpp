#include <algorithm>

#include "exec/program_evaluation.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/plugin/expression.hpp"
#include "prescribed/expression.hpp"
#include "prescribed/surroundings.hpp"

namespace mesogen {

struct Expression::Implementation {
  Program program;
  exec::Surroundings<double> around;
};

Expression::Expression(const std::string& text, const Scene& scene) {
  Vocabulary words = vocabulary_of(scene);
  words.time = false;
  words.refused["t"] = "is the time, on which this must not depend";
  Program program = parse_expression(text, words);
  implementation_ =
      std::make_unique<const Implementation>(Implementation{std::move(program), surroundings<double>(scene, 0.0)});
}

Expression::~Expression() = default;

namespace {

template <int Count>
std::array<double, Count> values_at(const Program& program, const exec::Surroundings<double>& around,
                                    const exec::Place<Count>& place) {
  exec::LocalSlots<Count> slots;
  exec::Evaluation<double, Count, exec::LocalSlots<Count>> evaluation(program.view(), around, slots);
  std::array<double, Count> values;
  std::copy_n(evaluation.at(place), Count, values.begin());
  return values;
}

}  // namespace

double Expression::operator()(const std::array<double, 3>& at) const {
  exec::Place<1> place{{{at[0]}, {at[1]}, {at[2]}}, 0, 1};
  return values_at(implementation_->program, implementation_->around, place).front();
}

std::array<double, 9> Expression::around(const std::array<double, 3>& at, double step) const {
  exec::Place<9> place{};
  place.count = 9;
  for (int n = 0; n < 9; ++n) {
    place.at[0][n] = at[0] + (n % 3 - 1) * step;
    place.at[1][n] = at[1] + (n / 3 - 1) * step;
    place.at[2][n] = at[2];
  }
  return values_at(implementation_->program, implementation_->around, place);
}

}  // namespace mesogen
