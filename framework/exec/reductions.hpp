#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
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

  /// On a device: as many numbers there, and as many on the host in pinned memory, which can be copied to while both
  /// work.
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
      check_cuda(cudaMemcpyAsync(pinned_, device_, size * sizeof(double), cudaMemcpyDeviceToHost, stream),
                 "the results of reductions");
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

  [[nodiscard]] double* device(Reduction reduction) const { return device_ + reduction.place; }
  [[nodiscard]] double* pinned(Reduction reduction) const { return pinned_ + reduction.place; }

 private:
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

constexpr int reducing_block = 256;

template <int Count, class Function>
__global__ void find_largest(Index count, Function function, double* largest) {
  const Index i = static_cast<Index>(blockIdx.x) * static_cast<Index>(blockDim.x) + static_cast<Index>(threadIdx.x);
  Maxima<Count> own{};
  if (i < count) function(i, own);
  for (int n = 0; n < Count; ++n) {
    auto most = static_cast<unsigned long long>(own.bits[n]);
    for (int step = 16; step > 0; step /= 2) {
      const unsigned long long other = __shfl_xor_sync(0xFFFFFFFFU, most, step);
      if (other > most) most = other;
    }
    if (threadIdx.x % 32 == 0 && most > 0) atomicMax(reinterpret_cast<unsigned long long*>(largest + n), most);
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
    constexpr int block = detail::reducing_block;
    check_cuda(cudaMemsetAsync(reductions.device(reduction), 0, Count * sizeof(double), stream), what);
    if (count > 0)
      detail::find_largest<Count>
          <<<(count + block - 1) / block, block, 0, stream>>>(count, function, reductions.device(reduction));
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
