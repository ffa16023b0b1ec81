#pragma once

#include <cmath>
#include <cstdint>

#include "exec/angle.hpp"
#include "mesogen/export.hpp"
#include "mesogen/fields/field_view.hpp"

/// A formula of place and time as a list of instructions, which host and device can evaluate at many particles.
namespace mesogen::exec {

enum class Operation : std::uint8_t {
  constant,    ///< `number`
  coordinate,  ///< along axis a
  time,
  field,  ///< the a-th scalar field
  film,   ///< brightness of the a-th film, 0 to 1
  // one argument, a
  negative,
  invert,
  sine,
  cosine,
  tangent,
  arcsine,
  arccosine,
  arctangent,
  hyperbolic_sine,
  hyperbolic_cosine,
  hyperbolic_tangent,
  exponential,
  logarithm,
  decimal_logarithm,
  root,
  absolute,
  lower_integer,
  sign,
  // two arguments, a and b
  add,
  subtract,
  multiply,
  divide,
  power,
  modulus,
  angle,
  minimum,
  maximum,
  less,
  less_or_equal,
  equal,
  unequal,
  both,
  either,
  // three
  choose,  ///< b where a is not 0, otherwise c
};

/// One instruction. Values lie in slots: it takes those in a, b and c, and leaves its result in another.
struct Instruction {
  Operation operation = Operation::constant;
  std::uint8_t to = 0;
  std::int16_t a = 0, b = 0, c = 0;
  double number = 0.0;
};

/// More instructions, slots, or things to read, than these has no program.
inline constexpr int most_instructions = 96;
inline constexpr int most_slots = 24;
inline constexpr int most_read = 4;

/// Pictures as they are at one time: that before, that after, and how far it is on the way from the one to the other.
struct FilmView {
  const float* before = nullptr;  ///< rows from the top down, each from the left
  const float* after = nullptr;
  double share = 0.0;
  int width = 0, height = 0;
};

/// The result of a program is that of its last instruction.
struct ProgramView {
  const Instruction* code = nullptr;
  int count = 0;
  int slots = 0;
};

/// Where and when a program is evaluated, and what it reads. Coordinates along periodic axes are brought into the box.
template <class Real>
struct Surroundings {
  const double* position[3]{};
  double box[3]{};
  bool periodic[3]{};
  int dimension = 0;
  double time = 0.0;
  FieldView<const Real> field[most_read]{};
  FilmView film[most_read]{};
};

/// What operations on numbers give.
MESOGEN_HOST_DEVICE inline double result_of(Operation operation, double a, double b, double c) {
  switch (operation) {
    case Operation::negative: return -a;
    case Operation::invert: return a == 0.0 ? 1.0 : 0.0;
    case Operation::sine: return sine(a);
    case Operation::cosine: return cosine(a);
    case Operation::tangent: return tangent(a);
    case Operation::arcsine: return std::asin(a);
    case Operation::arccosine: return std::acos(a);
    case Operation::arctangent: return std::atan(a);
    case Operation::hyperbolic_sine: return std::sinh(a);
    case Operation::hyperbolic_cosine: return std::cosh(a);
    case Operation::hyperbolic_tangent: return std::tanh(a);
    case Operation::exponential: return std::exp(a);
    case Operation::logarithm: return std::log(a);
    case Operation::decimal_logarithm: return std::log10(a);
    case Operation::root: return std::sqrt(a);
    case Operation::absolute: return std::fabs(a);
    case Operation::lower_integer: return std::floor(a);
    case Operation::sign: return a > 0.0 ? 1.0 : (a < 0.0 ? -1.0 : a);
    case Operation::add: return a + b;
    case Operation::subtract: return a - b;
    case Operation::multiply: return a * b;
    case Operation::divide: return a / b;
    case Operation::power: return std::pow(a, b);
    case Operation::modulus: return a - std::floor(a / b) * b;
    case Operation::angle: return std::atan2(a, b);
    case Operation::minimum: return a < b ? a : b;
    case Operation::maximum: return a > b ? a : b;
    case Operation::less: return a < b ? 1.0 : 0.0;
    case Operation::less_or_equal: return a <= b ? 1.0 : 0.0;
    case Operation::equal: return a == b ? 1.0 : 0.0;
    case Operation::unequal: return a != b ? 1.0 : 0.0;
    case Operation::both: return a != 0.0 && b != 0.0 ? 1.0 : 0.0;
    case Operation::either: return a != 0.0 || b != 0.0 ? 1.0 : 0.0;
    case Operation::choose: return a != 0.0 ? b : c;
    default: return 0.0;  // takes no numbers
  }
}

/// A program for a component of a field, and of its gradient if that is wanted: by differences over `reach` to both
/// sides, whose sum over particles on a lattice gives a jump its height.
template <class Real>
struct EvaluateArguments {
  ProgramView program;
  Surroundings<Real> around;
  Real* result;
  Real* gradient[3];     ///< null where it is not wanted
  bool varies_along[3];  ///< false where that component is 0
  double reach;
};

}  // namespace mesogen::exec
