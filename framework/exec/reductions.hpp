#pragma once

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
  [[nodiscard]] double found(Reduction reduction) const { return pinned_[reduction.place]; }

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

/// `Count` numbers, none of them below zero or not a number.
template <int Count>
struct Maxima {
  double value[Count];
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
    for (int step = 16; step > 0; step /= 2) {
      const double other = __shfl_xor_sync(0xFFFFFFFFU, own.value[n], step);
      if (other > own.value[n]) own.value[n] = other;
    }
    // Maxima that are not negative are in order as the integers of their bits are.
    if (threadIdx.x % 32 == 0 && own.value[n] > 0.0)
      atomicMax(reinterpret_cast<unsigned long long*>(largest + n),
                static_cast<unsigned long long>(__double_as_longlong(own.value[n])));
  }
}

}  // namespace detail
#endif

/// Looks for the largest of each of `Count` numbers over all i: function(i, maxima) raises those that are larger at i.
/// It raises to infinity where something is not a number. `what`: of the loop, for the error if it cannot start.
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
  double* const largest = reductions.pinned(reduction);
  for (int n = 0; n < Count; ++n) largest[n] = 0.0;
  const Blocks blocks(count);
  WorkStealing stealing(blocks.number());
#pragma omp parallel
  {
    [[maybe_unused]] const FlushSubnormals flush;
    Maxima<Count> own{};
    stealing.take([&](Index block) {
      for (Index i = blocks.begin(block); i < blocks.end(block); ++i) function(i, own);
    });
#pragma omp critical(mesogen_find_largest)
    for (int n = 0; n < Count; ++n)
      if (own.value[n] > largest[n]) largest[n] = own.value[n];
  }
  return reduction;
}

}  // namespace mesogen::exec
