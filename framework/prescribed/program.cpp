#include "prescribed/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
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

/// Puts values in the order in which a program makes them. Of what an instruction takes, first comes what itself keeps
/// most values at a time, so that few are kept meanwhile.
class Order {
 public:
  explicit Order(const std::vector<Instruction>& code) : code_(code), kept_(code.size(), 1), done_(code.size(), false) {
    for (std::size_t n = 0; n < code_.size(); ++n)
      for (int before = 0; const std::size_t source : sources(n))
        kept_[n] = std::max(kept_[n], kept_[source] + before++);
  }

  /// What leads to a value, and the value itself as the last.
  [[nodiscard]] std::vector<std::size_t> to(std::size_t result) {
    visit(result);
    return std::move(order_);
  }

 private:
  [[nodiscard]] std::vector<std::size_t> sources(std::size_t n) const {
    std::vector<std::size_t> all;
    Instruction one = code_[n];
    for_arguments(one, [&](std::int16_t source) { all.push_back(static_cast<std::size_t>(source)); });
    std::ranges::stable_sort(all, std::greater{}, [&](std::size_t source) { return kept_[source]; });
    return all;
  }
  void visit(std::size_t n) {
    if (done_[n]) return;
    for (const std::size_t source : sources(n)) visit(source);
    done_[n] = true;
    order_.push_back(n);
  }

  const std::vector<Instruction>& code_;
  std::vector<int> kept_;  // until a value is made, itself included
  std::vector<bool> done_;
  std::vector<std::size_t> order_;
};

/// Instructions name the values that they take by number. Now they get slots: one is free again behind the last
/// instruction that reads it. None is written by an instruction that reads it, as loops over lanes would then not be
/// taken several lanes at a time. Returns the number of slots.
int give_slots(std::vector<Instruction>& code) {
  std::vector<std::size_t> last_reader(code.size());
  for (std::size_t n = 0; n < code.size(); ++n)
    for_arguments(code[n], [&](std::int16_t source) { last_reader[static_cast<std::size_t>(source)] = n; });
  std::vector<bool> taken;
  for (std::size_t n = 0; n < code.size(); ++n) {
    const auto free = std::ranges::find(taken, false);
    code[n].to = static_cast<std::uint8_t>(free - taken.begin());
    if (free == taken.end()) taken.push_back(true);
    taken[code[n].to] = true;
    for_arguments(code[n], [&](std::int16_t& source) {
      const auto value = static_cast<std::size_t>(source);
      source = code[value].to;
      if (last_reader[value] == n) taken[code[value].to] = false;
    });
  }
  return static_cast<int>(taken.size());
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
  return add({.operation = Operation::field, .a = place});
}

int ProgramWriter::film(Film film) {
  films_.push_back(std::move(film));
  return add({.operation = Operation::film, .a = static_cast<std::int16_t>(films_.size() - 1)});
}

int ProgramWriter::apply(Operation operation, int a, int b, int c) {
  Instruction one{.operation = operation,
                  .a = static_cast<std::int16_t>(a),
                  .b = static_cast<std::int16_t>(b),
                  .c = static_cast<std::int16_t>(c)};
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
  std::vector<bool> needed(code_.size(), false);
  needed[static_cast<std::size_t>(result)] = true;
  for (std::size_t n = code_.size(); n-- > 0;) {
    Instruction one = code_[n];
    if (needed[n]) for_arguments(one, [&](std::int16_t source) { needed[static_cast<std::size_t>(source)] = true; });
  }
  if (const auto count = std::ranges::count(needed, true); count > exec::most_instructions)
    throw Error(ExitCode::bad_case, fmt::format("takes {} operations and numbers, and {} are the most: shorten it",
                                                count, exec::most_instructions));
  Program program;
  std::vector<Instruction> code = code_;
  std::vector<std::int16_t> number(fields_.size(), -1);
  for (std::size_t n = 0; n < code.size(); ++n) {
    if (!needed[n] || code[n].operation != Operation::field) continue;
    std::int16_t& of_field = number[static_cast<std::size_t>(code[n].a)];
    if (of_field < 0) {
      of_field = static_cast<std::int16_t>(program.fields.size());
      program.fields.push_back(fields_[static_cast<std::size_t>(code[n].a)]);
    }
    code[n].a = of_field;
  }
  if (program.fields.size() > exec::most_read)
    throw Error(ExitCode::bad_case,
                fmt::format("reads {} fields, and {} are the most", program.fields.size(), exec::most_read));
  std::vector<std::int16_t> moved(code.size());
  for (const std::size_t n : Order(code_).to(static_cast<std::size_t>(result))) {
    Instruction one = code[n];
    for_arguments(one, [&](std::int16_t& source) { source = moved[static_cast<std::size_t>(source)]; });
    moved[n] = static_cast<std::int16_t>(program.code.size());
    program.code.push_back(one);
  }
  program.films = films_;
  program.slots = give_slots(program.code);
  if (program.slots > exec::most_slots)
    throw Error(ExitCode::bad_case, fmt::format("keeps {} numbers for later, and {} are the most: shorten it",
                                                program.slots, exec::most_slots));
  return program;
}

}  // namespace mesogen
