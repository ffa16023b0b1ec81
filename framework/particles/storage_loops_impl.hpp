#pragma once

#include <cstdint>

#include "mesogen/exec/for_each.hpp"
#include "particles/storage_loops.hpp"

namespace mesogen::exec {

template <class T>
struct Gather {
  const T* from;
  const Index* order;
  T* to;
  MESOGEN_HOST_DEVICE void operator()(Index n) const { to[n] = from[order[n]]; }
};

template <class T>
struct Copy {
  const T* from;
  T* to;
  MESOGEN_HOST_DEVICE void operator()(Index n) const { to[n] = from[n]; }
};

struct GatherUnwrapped {
  UnwrappedAlong along;
  const Index* places;
  double* to;
  MESOGEN_HOST_DEVICE void operator()(Index n) const {
    const Index i = places[n];
    to[n] = along.position[i] + along.images[i] * along.length;
  }
};

class StorageLoopsImpl final : public StorageLoops {
 public:
  explicit StorageLoopsImpl(const Space& space) : space_(space) {}

  void gather(const float* from, const Index* order, Index count, float* to) const override {
    gathered(from, order, count, to);
  }
  void gather(const double* from, const Index* order, Index count, double* to) const override {
    gathered(from, order, count, to);
  }
  void gather(const std::int32_t* from, const Index* order, Index count, std::int32_t* to) const override {
    gathered(from, order, count, to);
  }
  void gather(const std::int64_t* from, const Index* order, Index count, std::int64_t* to) const override {
    gathered(from, order, count, to);
  }
  void gather_unwrapped(const UnwrappedAlong& along, const Index* places, Index count, double* to) const override {
    for_each(space_, count, GatherUnwrapped{along, places, to}, "paths of particles");
  }
  void copy(const float* from, float* to, Index count) const override {
    for_each(space_, count, Copy<float>{from, to}, "copying values");
  }
  void copy(const double* from, double* to, Index count) const override {
    for_each(space_, count, Copy<double>{from, to}, "copying values");
  }

 private:
  template <class T>
  void gathered(const T* from, const Index* order, Index count, T* to) const {
    for_each(space_, count, Gather<T>{from, order, to}, "putting particles in order");
  }

  Space space_;
};

}  // namespace mesogen::exec
