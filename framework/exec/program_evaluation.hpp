#pragma once

#include <cmath>

#include "exec/program.hpp"
#include "mesogen/exec/for_each.hpp"
#include "mesogen/exec/unroll.hpp"

// glibc has these for several numbers at a time (libmvec), and gcc calls them in loops if told so.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__)
extern "C" {
__attribute__((simd("notinbranch"))) double sin(double) noexcept;
__attribute__((simd("notinbranch"))) double cos(double) noexcept;
__attribute__((simd("notinbranch"))) double exp(double) noexcept;
__attribute__((simd("notinbranch"))) double log(double) noexcept;
}
#endif

/// Programs evaluated at particles, on host and device.
namespace mesogen::exec {

/// `count` particles, from `first` on.
template <int Lanes>
struct Place {
  double at[3][Lanes];
  Index first;
  int count;

  int moved = 3;       ///< the axis along which they are elsewhere than `at`
  double to[Lanes]{};  ///< namely there

  /// The choice of the axis is written out, so that a device keeps coordinates in registers.
  [[nodiscard]] MESOGEN_HOST_DEVICE double along(int axis, int n) const {
    if (axis == moved) return to[n];
    return axis == 0 ? at[0][n] : axis == 1 ? at[1][n] : at[2][n];
  }
};

/// Where the values of a program lie on the host.
template <int Lanes>
class LocalSlots {
 public:
  double* operator[](int slot) { return value_[slot]; }

 private:
  double value_[most_slots][Lanes];
};

#ifdef __CUDACC__
/// The same on a device: in shared memory, each slot for all threads of a block side by side.
class SharedSlots {
 public:
  static constexpr unsigned threads = LoopBlocks::size;
  static constexpr std::size_t bytes(int slots) { return static_cast<std::size_t>(slots) * threads * sizeof(double); }

  __device__ explicit SharedSlots(double* block) : own_(block + threadIdx.x) {}
  __device__ double* operator[](int slot) const { return own_ + slot * static_cast<int>(threads); }

 private:
  double* own_;
};
#endif

namespace program_detail {

MESOGEN_HOST_DEVICE inline double into_box(double at, double length) {
  const double inside = at - std::floor(at / length) * length;
  return inside < length ? inside : 0.0;
}

/// Between the middles of pixels.
struct PixelsBetween {
  int low, high;
  double share;

  MESOGEN_HOST_DEVICE PixelsBetween(double at, double length, int count, bool periodic) {
    const double place = at / length * count - 0.5;
    const double below = std::floor(place);
    share = place - below;
    low = static_cast<int>(below);
    high = low + 1;
    if (periodic) {
      low = (low + count) % count;
      high = high % count;
    } else {
      low = low < 0 ? 0 : (low < count ? low : count - 1);
      high = high < 0 ? 0 : (high < count ? high : count - 1);
    }
  }
};

template <class Real>
MESOGEN_HOST_DEVICE double brightness(const Surroundings<Real>& around, const FilmView& film, double x, double y) {
  const PixelsBetween column(x, around.box[0], film.width, around.periodic[0]);
  const PixelsBetween row(around.box[1] - y, around.box[1], film.height, around.periodic[1]);
  const auto in = [&](const float* picture) {
    const auto pixel = [&](int r, int c) {
      return static_cast<double>(picture[static_cast<std::ptrdiff_t>(r) * film.width + c]);
    };
    const double low = pixel(row.low, column.low) * (1.0 - column.share) + pixel(row.low, column.high) * column.share;
    const double high =
        pixel(row.high, column.low) * (1.0 - column.share) + pixel(row.high, column.high) * column.share;
    return low * (1.0 - row.share) + high * row.share;
  };
  return in(film.before) * (1.0 - film.share) + in(film.after) * film.share;
}

}  // namespace program_detail

/// Evaluates a program at a few particles at a time: on the host as many as keep vector units busy, on a device one.
/// `Slots`: LocalSlots or SharedSlots.
template <class Real, int Lanes, class Slots>
class Evaluation {
 public:
  MESOGEN_HOST_DEVICE Evaluation(const ProgramView& program, const Surroundings<Real>& around, Slots& slots)
      : program_(program), around_(around), slots_(slots) {}

  /// The result at a place; valid until the next call.
  MESOGEN_HOST_DEVICE const double* at(const Place<Lanes>& place) {
    for (int n = 0; n < program_.count; ++n) run(program_.code[n], place);
    return slots_[program_.code[program_.count - 1].to];
  }

 private:
  MESOGEN_HOST_DEVICE void run(const Instruction& one, const Place<Lanes>& place) {
    double* const result = slots_[one.to];
    const auto each = [&](auto&& value) {
      for (int n = 0; n < Lanes; ++n) result[n] = value(n);
    };
    const double* const a = slots_[one.a];
    const double* const b = slots_[one.b];
    const double* const c = slots_[one.c];
    // The frequent ones by themselves, in loops that vector units take.
    switch (one.operation) {
      case Operation::constant: return each([&](int) { return one.number; });
      case Operation::coordinate:
        if (one.a == place.moved) return each([&](int n) { return place.to[n]; });
        return unroll<3>([&](auto d) {
          if (one.a == d) each([&](int n) { return place.at[d][n]; });
        });
      case Operation::time: return each([&](int) { return around_.time; });
      case Operation::field:
        return each(
            [&](int n) { return n < place.count ? static_cast<double>(around_.field[one.a](place.first + n)) : 0.0; });
      case Operation::film:
        return each([&](int n) {
          return program_detail::brightness(around_, around_.film[one.a], place.along(0, n), place.along(1, n));
        });
      case Operation::add: return each([&](int n) { return a[n] + b[n]; });
      case Operation::subtract: return each([&](int n) { return a[n] - b[n]; });
      case Operation::multiply: return each([&](int n) { return a[n] * b[n]; });
      case Operation::divide: return each([&](int n) { return a[n] / b[n]; });
      case Operation::less: return each([&](int n) { return a[n] < b[n] ? 1.0 : 0.0; });
      case Operation::root: return each([&](int n) { return std::sqrt(a[n]); });
      case Operation::sine: return each([&](int n) { return sine(a[n]); });
      case Operation::cosine: return each([&](int n) { return cosine(a[n]); });
      case Operation::exponential: return each([&](int n) { return std::exp(a[n]); });
      case Operation::logarithm: return each([&](int n) { return std::log(a[n]); });
      default: return each([&](int n) { return result_of(one.operation, a[n], b[n], c[n]); });
    }
  }

  ProgramView program_;
  const Surroundings<Real>& around_;
  Slots& slots_;
};

/// The coordinates of some particles.
template <class Real, int Lanes>
MESOGEN_HOST_DEVICE Place<Lanes> place_of(const Surroundings<Real>& around, Index first, int count) {
  Place<Lanes> place;
  place.first = first;
  place.count = count;
  for (int d = 0; d < 3; ++d)
    for (int n = 0; n < Lanes; ++n) {
      // Behind the last particle the first of the group stands for it.
      const double at = d < around.dimension ? around.position[d][first + (n < count ? n : 0)] : 0.0;
      place.at[d][n] = d < around.dimension && around.periodic[d] ? program_detail::into_box(at, around.box[d]) : at;
    }
  return place;
}

/// Of a group of particles. On a device it needs SharedSlots::bytes of shared memory: evaluate_program() sees to that.
template <class Real, int Lanes>
struct EvaluateProgram {
  EvaluateArguments<Real> a;
  Index particles;

  MESOGEN_HOST_DEVICE void operator()(Index group) const {
#ifdef __CUDA_ARCH__
    extern __shared__ double program_slots[];
    SharedSlots slots(program_slots);
#else
    LocalSlots<Lanes> slots;
#endif
    evaluate(group, slots);
  }

 private:
  template <class Slots>
  MESOGEN_HOST_DEVICE void evaluate(Index group, Slots& slots) const {
    const Index first = group * Lanes;
    const int count = particles - first < Lanes ? static_cast<int>(particles - first) : Lanes;
    Evaluation<Real, Lanes, Slots> evaluation(a.program, a.around, slots);
    const Place<Lanes> place = place_of<Real, Lanes>(a.around, first, count);
    double here[Lanes];
    copy(evaluation.at(place), here);
    for (int n = 0; n < count && a.result != nullptr; ++n) a.result[first + n] = static_cast<Real>(here[n]);
    for (int d = 0; d < a.around.dimension; ++d) {
      if (a.gradient[d] == nullptr) continue;
      double slope[Lanes] = {};
      if (a.varies_along[d]) find_slope(evaluation, place, d, here, slope);
      for (int n = 0; n < count; ++n) a.gradient[d][first + n] = static_cast<Real>(slope[n]);
    }
  }
  MESOGEN_HOST_DEVICE static void copy(const double* from, double* to) {
    for (int n = 0; n < Lanes; ++n) to[n] = from[n];
  }
  /// The values a way to one side of a place, and how far that is: less in front of a wall, and nothing where the
  /// program gives no number, as it may in a solid.
  template <class Slots>
  MESOGEN_HOST_DEVICE void look_aside(Evaluation<Real, Lanes, Slots>& evaluation, const Place<Lanes>& place, int d,
                                      double way, const double* here, double* value, double* distance) const {
    const double length = a.around.box[d];
    Place<Lanes> there = place;
    there.moved = d;
    for (int n = 0; n < Lanes; ++n) {
      const double from = place.along(d, n);
      double to = from + way;
      if (!a.around.periodic[d]) to = to < 0.0 ? 0.0 : (to > length ? length : to);
      distance[n] = to - from;
      there.to[n] = a.around.periodic[d] ? program_detail::into_box(to, length) : to;
    }
    copy(evaluation.at(there), value);
    for (int n = 0; n < Lanes; ++n) {
      if (value[n] - value[n] == 0.0) continue;
      value[n] = here[n];
      distance[n] = 0.0;
    }
  }
  template <class Slots>
  MESOGEN_HOST_DEVICE void find_slope(Evaluation<Real, Lanes, Slots>& evaluation, const Place<Lanes>& place, int d,
                                      const double* here, double* slope) const {
    double above[Lanes];
    double below[Lanes];
    double up[Lanes];
    double down[Lanes];
    look_aside(evaluation, place, d, a.reach, here, above, up);
    look_aside(evaluation, place, d, -a.reach, here, below, down);
    for (int n = 0; n < Lanes; ++n) {
      const double width = up[n] - down[n];
      slope[n] = width > 0.0 ? (above[n] - below[n]) / width : 0.0;
    }
  }
};

/// Evaluates a program at `count` particles.
template <class Real>
void evaluate_program(const Space& space, const EvaluateArguments<Real>& arguments, Index count) {
  constexpr const char* what = "prescribed values";
#ifdef __CUDACC__
  const EvaluateProgram<Real, 1> evaluate{arguments, count};
  if (!space.device) return for_each(space, count, evaluate, what);
  if (count == 0) return;
  // As for_each does, but with shared memory.
  run_for_each<<<LoopBlocks::number(count), LoopBlocks::size, SharedSlots::bytes(arguments.program.slots),
                 static_cast<cudaStream_t>(space.stream)>>>(count, evaluate);
  check_launch(what);
#else
  constexpr int lanes = 32;
  for_each(space, (count + lanes - 1) / lanes, EvaluateProgram<Real, lanes>{arguments, count}, what);
#endif
}

}  // namespace mesogen::exec
