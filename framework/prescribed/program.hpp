#pragma once

#include <string>
#include <vector>

#include "exec/program.hpp"
#include "mesogen/export.hpp"
#include "prescribed/film.hpp"

namespace mesogen {

/// A formula of place, time and fields, ready to be evaluated at particles.
struct MESOGEN_EXPORT Program {
  std::vector<exec::Instruction> code;
  std::vector<std::string> fields;  ///< that it reads, in the order of their numbers
  std::vector<Film> films;          ///< the same of films
  int slots = 0;                    ///< that its values need

  [[nodiscard]] exec::ProgramView view() const { return {code.data(), static_cast<int>(code.size()), slots}; }
  /// The number that it always gives, if it reads nothing; of a program without this, any.
  [[nodiscard]] bool constant() const { return code.size() == 1 && code[0].operation == exec::Operation::constant; }
  [[nodiscard]] double number() const { return code[0].number; }
  /// Does it read this anywhere?
  [[nodiscard]] bool reads(exec::Operation what) const {
    for (const exec::Instruction& one : code)
      if (one.operation == what) return true;
    return false;
  }
  /// Does it depend on the coordinate along an axis?
  [[nodiscard]] bool varies_along(int axis) const;
  /// Does it change while nothing moves and no field changes?
  [[nodiscard]] bool changes_in_time() const;
};

/// Puts a program together, one instruction after the other. Each call returns the number of the value that it made.
class MESOGEN_EXPORT ProgramWriter {
 public:
  int constant(double number);
  int coordinate(int axis) {
    return add({.operation = exec::Operation::coordinate, .a = static_cast<std::int16_t>(axis)});
  }
  int time() { return add({.operation = exec::Operation::time}); }
  int field(const std::string& name);
  int film(Film film);
  /// What follows from numbers alone is computed at once.
  int apply(exec::Operation operation, int a, int b = 0, int c = 0);

  /// The program whose result is this value; what does not lead to it is left out. Throws Error(bad_case) if it is too
  /// long, keeps too many values at a time, or reads too much.
  [[nodiscard]] Program finish(int result) const;

 private:
  int add(const exec::Instruction& one);

  std::vector<exec::Instruction> code_;
  std::vector<std::string> fields_;
  std::vector<Film> films_;
};

}  // namespace mesogen
