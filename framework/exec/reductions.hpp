#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>

#include "exec/backend.hpp"
#include "mesogen/exec/blocks.hpp"
#include "mesogen/exec/cuda_check.hpp"
#include "mesogen/exec/for_each.hpp"
#include "mesogen/exec/subnormals.hpp"
#include "mesogen/exec/work_stealing.hpp"

namespace mesogen::exec {

/// Where loops leave the numbers that they look for. On a device a loop is only asked for, and all results come to the
/// host together: to wait for each would take longer than the loops.
class Reductions {
 public:
  static constexpr int size = 64;

  /// On a device: as many numbers there, all of them 0, and as many on the host in pinned memory, which can be copied
  /// to while both work.
  explicit Reductions(double* device = nullptr, double* pinned = nullptr)
      : device_(device), pinned_(pinned == nullptr ? own_ : pinned) {}
  Reductions(const Reductions&) = delete;
  Reductions& operator=(const Reductions&) = delete;

  /// The first of the next `count` numbers. Throws std::logic_error if that would overwrite what was not waited for.
  Reduction take(int count) {
    if (next_ + count > size) {
      next_ = 0;
      ++rounds_;
    }
    if (rounds_ > 1 || (rounds_ == 1 && next_ + count > waited_))
      throw std::logic_error("more is looked for at a time than there is room to note");
    next_ += count;
    return {next_ - count};
  }
  /// Waits for all that was asked for. Throws Error(run_failed) if some of it failed: no result is to be read then.
  void wait(const Space& space) {
#ifdef __CUDACC__
    if (space.device) {
      const auto stream = static_cast<cudaStream_t>(space.stream);
      if (rounds_ > 0) {
        fetch(waited_, size, stream);
        fetch(0, next_, stream);
      } else {
        fetch(waited_, next_, stream);
      }
      check_cuda(cudaStreamSynchronize(stream), "the results of reductions");
    }
#else
    (void)space;
#endif
    rounds_ = 0;
    waited_ = next_;
  }
  /// Infinite if something was not a number.
  [[nodiscard]] double found(Reduction reduction) const {
    const double largest = pinned_[reduction.place];
    return std::isnan(largest) ? HUGE_VAL : largest;
  }

  [[nodiscard]] std::span<double> all() { return {pinned_, size}; }
  [[nodiscard]] double* device(Reduction reduction) const { return device_ + reduction.place; }
  [[nodiscard]] double* pinned(Reduction reduction) const { return pinned_ + reduction.place; }

 private:
#ifdef __CUDACC__
  // Brings the results of these places, and makes the places ready for the next loops that look: so a loop need not be
  // preceded by a start of its own that sets its place to zero.
  void fetch(int first, int end, cudaStream_t stream) {
    if (first == end) return;
    const auto bytes = static_cast<std::size_t>(end - first) * sizeof(double);
    check_cuda(cudaMemcpyAsync(pinned_ + first, device_ + first, bytes, cudaMemcpyDeviceToHost, stream),
               "the results of reductions");
    check_cuda(cudaMemsetAsync(device_ + first, 0, bytes, stream), "the results of reductions");
  }
#endif

  double own_[size] = {};
  double* device_;
  double* pinned_;
  int next_ = 0;
  int waited_ = 0;  // the place behind the last whose result came
  int rounds_ = 0;  // how often the places were begun anew since
};

/// The largest of `Count` numbers each, none of them below zero, kept as the integers of their bits: those are in the
/// same order, what is not a number comes after infinity, and a compiler finds the largest of several at a time.
template <int Count>
struct Maxima {
  std::uint64_t bits[Count] = {};

  MESOGEN_HOST_DEVICE void raise(int n, double number) {
    std::uint64_t of_number;
    memcpy(&of_number, &number, sizeof(number));
    bits[n] = of_number > bits[n] ? of_number : bits[n];
  }
  MESOGEN_HOST_DEVICE void raise(const Maxima& other) {
    for (int n = 0; n < Count; ++n) bits[n] = other.bits[n] > bits[n] ? other.bits[n] : bits[n];
  }
};

#ifdef __CUDACC__
namespace detail {

using ReducingBlocks = ThreadBlocks<256>;

template <int Count, class Function>
__global__ void __launch_bounds__(ReducingBlocks::size) find_largest(Index count, Function function, double* largest) {
  const unsigned i = ReducingBlocks::thread(blockIdx.x, threadIdx.x);
  Maxima<Count> own{};
  if (i < static_cast<unsigned>(count)) function(static_cast<Index>(i), own);
  for (int n = 0; n < Count; ++n) {
    auto most = static_cast<unsigned long long>(own.bits[n]);
    for (int step = 16; step > 0; step /= 2) {
      const unsigned long long other = __shfl_xor_sync(0xFFFFFFFFU, most, step);
      if (other > most) most = other;
    }
    // A look first: most warps find no more than others did before them, and additions to one place wait for each
    // other.
    auto* const all = reinterpret_cast<unsigned long long*>(largest + n);
    if (threadIdx.x % 32 == 0 && most > *static_cast<volatile unsigned long long*>(all)) atomicMax(all, most);
  }
}

}  // namespace detail
#endif

/// Looks for the largest of each of `Count` numbers over all i: function(i, maxima) raises those that are larger at i.
/// `what`: of the loop, for the error if it cannot start.
template <int Count, class Function>
Reduction find_largest(const Space& space, Reductions& reductions, Index count, const Function& function,
                       [[maybe_unused]] const char* what) {
  const Reduction reduction = reductions.take(Count);
#ifdef __CUDACC__
  if (space.device) {
    const auto stream = static_cast<cudaStream_t>(space.stream);
    using Blocks = detail::ReducingBlocks;
    if (count > 0)
      detail::find_largest<Count>
          <<<Blocks::number(count), Blocks::size, 0, stream>>>(count, function, reductions.device(reduction));
    check_launch(what);
    return reduction;
  }
#else
  (void)space;
#endif
  Maxima<Count> all;
  const Blocks blocks(count);
  WorkStealing stealing(blocks.number());
#pragma omp parallel
  {
    [[maybe_unused]] const FlushSubnormals flush;
    const Function copy = function;  // what the loop writes cannot change it, so a compiler may keep it in registers
    Maxima<Count> own;
    stealing.take([&](Index block) {
      Maxima<Count> of_block = own;
      MESOGEN_TURNS_ARE_INDEPENDENT
      for (Index i = blocks.begin(block), end = blocks.end(block); i < end; ++i) copy(i, of_block);
      own = of_block;
    });
#pragma omp critical(mesogen_find_largest)
    all.raise(own);
  }
  std::memcpy(reductions.pinned(reduction), all.bits, sizeof(all.bits));
  return reduction;
}

}  // namespace mesogen::exec
