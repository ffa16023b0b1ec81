#include "prescribed/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

using exec::Instruction;
using exec::Operation;

/// How many values an operation takes.
int arguments(Operation operation) {
  if (operation < Operation::negative) return 0;
  if (operation < Operation::add) return 1;
  return operation < Operation::choose ? 2 : 3;
}

template <class Action>
void for_arguments(Instruction& one, const Action& action) {
  std::int16_t* const all[] = {&one.a, &one.b, &one.c};
  for (int n = 0; n < arguments(one.operation); ++n) action(*all[n]);
}

}  // namespace

bool Program::varies_along(int axis) const {
  return std::ranges::any_of(code, [&](const Instruction& one) {
    return (one.operation == Operation::coordinate && one.a == axis) || (one.operation == Operation::film && axis < 2);
  });
}

bool Program::changes_in_time() const {
  return reads(Operation::time) || std::ranges::any_of(films, [](const Film& film) { return film.times.size() > 1; });
}

int ProgramWriter::add(const Instruction& one) {
  code_.push_back(one);
  return static_cast<int>(code_.size()) - 1;
}

int ProgramWriter::constant(double number) {
  Instruction one;
  one.number = number;
  return add(one);
}

int ProgramWriter::field(const std::string& name) {
  const auto at = std::ranges::find(fields_, name);
  const auto place = static_cast<std::int16_t>(at - fields_.begin());
  if (at == fields_.end()) fields_.push_back(name);
  return add({Operation::field, place});
}

int ProgramWriter::film(Film film) {
  films_.push_back(std::move(film));
  return add({Operation::film, static_cast<std::int16_t>(films_.size() - 1)});
}

int ProgramWriter::apply(Operation operation, int a, int b, int c) {
  Instruction one{operation, static_cast<std::int16_t>(a), static_cast<std::int16_t>(b), static_cast<std::int16_t>(c)};
  const auto compares = [&](int n) {
    return code_[n].operation == Operation::less || code_[n].operation == Operation::less_or_equal;
  };
  if ((operation == Operation::less || operation == Operation::less_or_equal) && (compares(a) || compares(b)))
    throw Error(ExitCode::bad_case, "compares the result of a comparison: for a range write (2 < x) && (x < 5)");
  bool known = true;
  for_arguments(one, [&](std::int16_t n) { known = known && code_[n].operation == Operation::constant; });
  if (known) return constant(exec::result_of(operation, code_[a].number, code_[b].number, code_[c].number));
  // A square is a product: much faster, and exact where a power may not be.
  if (operation == Operation::power && code_[b].operation == Operation::constant && code_[b].number == 2.0)
    return apply(Operation::multiply, a, a);
  return add(one);
}

Program ProgramWriter::finish(int result) const {
  std::vector<char> needed(code_.size(), 0);
  needed[static_cast<std::size_t>(result)] = 1;
  for (std::size_t n = code_.size(); n-- > 0;) {
    Instruction one = code_[n];
    if (needed[n] != 0) for_arguments(one, [&](std::int16_t source) { needed[source] = 1; });
  }
  Program program;
  std::vector<std::int16_t> moved(code_.size());
  std::vector<std::int16_t> field(fields_.size(), -1);
  for (std::size_t n = 0; n < code_.size(); ++n) {
    if (needed[n] == 0) continue;
    Instruction one = code_[n];
    for_arguments(one, [&](std::int16_t& source) { source = moved[source]; });
    if (one.operation == Operation::field) {
      std::int16_t& place = field[one.a];
      if (place < 0) {
        place = static_cast<std::int16_t>(program.fields.size());
        program.fields.push_back(fields_[one.a]);
      }
      one.a = place;
    }
    moved[n] = static_cast<std::int16_t>(program.code.size());
    program.code.push_back(one);
  }
  program.films = films_;
  if (program.code.size() > exec::most_instructions)
    throw Error(ExitCode::bad_case, fmt::format("takes {} operations and numbers, and {} are the most: shorten it",
                                                program.code.size(), exec::most_instructions));
  if (program.fields.size() > exec::most_read)
    throw Error(ExitCode::bad_case,
                fmt::format("reads {} fields, and {} are the most", program.fields.size(), exec::most_read));
  return program;
}

}  // namespace mesogen
