#pragma once

#include <array>
#include <cstddef>

#include "mesogen/exec/array.hpp"
#include "mesogen/exec/for_each.hpp"

namespace mesogen::mesh {

/// What a device runs: nvcc takes no private classes there.
namespace loops {

inline constexpr Index parts_of_sum = 128;

template <int Count, class Term>
struct EverySoMany {
  Term term;
  double* parts;
  Index count;

  MESOGEN_HOST_DEVICE void operator()(Index part) const {
    double own[Count] = {};
    for (Index i = part; i < count; i += parts_of_sum * parts_of_sum) term(i, own);
    for (int c = 0; c < Count; ++c) parts[c * parts_of_sum * parts_of_sum + part] = own[c];
  }
};

template <int Count>
struct AddParts {
  const double* parts;
  double* sums;

  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    for (int c = 0; c < Count; ++c) {
      double sum = 0.0;
      for (Index part = n; part < parts_of_sum * parts_of_sum; part += parts_of_sum)
        sum += parts[c * parts_of_sum * parts_of_sum + part];
      sums[c * parts_of_sum + n] = sum;
    }
  }
};

}  // namespace loops

/// Adds up `Count` numbers each over all i in [0, count), on a device: a fixed number of threads adds up every so many,
/// then fewer add up theirs, and the host the rest. So a sum has the same bits in every run, on any device.
template <int Count>
class OrderedSum {
  static constexpr Index many = loops::parts_of_sum;

 public:
  explicit OrderedSum(exec::DeviceMemory* memory) : parts_(memory), sums_(memory) {
    parts_.resize_for_overwrite(std::size_t{Count} * many * many);
    sums_.resize_for_overwrite(std::size_t{Count} * many);
  }

  /// term(i, sums) must add what belongs to i. Waits for the device.
  template <class Term>
  std::array<double, Count> operator()(const exec::Space& space, Index count, const Term& term) {
    auto* const parts = parts_.device(exec::Access::write);
    exec::for_each(space, many * many, loops::EverySoMany<Count, Term>{term, parts, count}, "adding up over a mesh");
    exec::for_each(space, many, loops::AddParts<Count>{parts, sums_.device(exec::Access::write)},
                   "adding up over a mesh");
    std::array<double, Count> total{};
    const auto sums = sums_.host();
    for (std::size_t n = 0; n < sums.size(); ++n) total[n / many] += sums[n];
    return total;
  }

 private:
  exec::Array<double> parts_;
  exec::Array<double> sums_;
};

}  // namespace mesogen::mesh
