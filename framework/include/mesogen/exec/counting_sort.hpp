#pragma once

#include <omp.h>

#include <cstddef>
#include <utility>
#include <vector>

#include "mesogen/exec/blocks.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen::exec {

/// Sorts i in [0, count) by bucket_of(i) in [0, buckets), in parallel: calls place(i, to), with the place `to` that i
/// takes. Within a bucket the order of i stays, whatever the number of threads. Returns the first place of each bucket,
/// and at the end `count`. Neither function may throw. Each thread counts all buckets: take far fewer buckets than i.
template <class BucketOf, class Place>
std::vector<Index> counting_sort(Index count, std::size_t buckets, const BucketOf& bucket_of, const Place& place) {
  std::vector<Index> begin(buckets + 1, count);
  std::vector<std::vector<Index>> next;  // by thread and bucket: the place of its next
#pragma omp parallel if (count >= parallel_from)
  {
#pragma omp single
    next.resize(static_cast<std::size_t>(omp_get_num_threads()));
    auto& own = next[static_cast<std::size_t>(omp_get_thread_num())];
    own.assign(buckets, 0);
    // Both loops give a thread the same part, so the part of each thread lies behind those of the threads before.
#pragma omp for schedule(static)
    for (Index i = 0; i < count; ++i) ++own[static_cast<std::size_t>(bucket_of(i))];
#pragma omp single
    {
      Index total = 0;
      for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
        begin[bucket] = total;
        for (auto& of_thread : next) total += std::exchange(of_thread[bucket], total);
      }
    }
#pragma omp for schedule(static)
    for (Index i = 0; i < count; ++i) place(i, own[static_cast<std::size_t>(bucket_of(i))]++);
  }
  return begin;
}

}  // namespace mesogen::exec
