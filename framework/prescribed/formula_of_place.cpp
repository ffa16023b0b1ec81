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
  Program program = parse_expression(text, vocabulary_of(scene));
  if (program.changes_in_time()) throw Error(ExitCode::bad_case, "depends on the time t, and here it must not");
  implementation_ =
      std::make_unique<const Implementation>(Implementation{std::move(program), surroundings<double>(scene, 0.0)});
}

Expression::~Expression() = default;

double Expression::operator()(const std::array<double, 3>& at) const {
  const auto& [program, around] = *implementation_;
  const exec::ProgramView view{program.code.data(), static_cast<int>(program.code.size())};
  exec::Place<1> place{};
  for (std::size_t d = 0; d < at.size(); ++d) place.at[d][0] = at[d];
  place.count = 1;
  return *exec::Evaluation<double, 1>(view, around).at(place);
}

}  // namespace mesogen
