// Arrays know on which side their newest values lie; what is out of date on an emulated device cannot pass for a value.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "exec/emulated_memory.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/array.hpp"

namespace {

using namespace mesogen;
using exec::Access;
using exec::Array;

/// Counts what crosses from side to side.
class CountingMemory final : public exec::EmulatedMemory {
 public:
  using EmulatedMemory::EmulatedMemory;
  void to_device(void* device, const void* host, std::size_t bytes) override {
    ++uploads;
    EmulatedMemory::to_device(device, host, bytes);
  }
  void to_host(void* host, const void* device, std::size_t bytes) override {
    ++downloads;
    EmulatedMemory::to_host(host, device, bytes);
  }
  int uploads = 0;
  int downloads = 0;
};

std::vector<double> values_of(const Array<double>& array) { return {array.host().begin(), array.host().end()}; }

TEST(Array, OnTheHostBothSidesAreOne) {
  Array<double> array;
  array.assign(std::vector{1.0, 2.0});
  EXPECT_EQ(array.device(), array.host().data());
  array.device(Access::read_write)[1] = 5.0;
  EXPECT_EQ(values_of(array), (std::vector{1.0, 5.0}));
  const double* const before = array.device();
  EXPECT_EQ(array.device(Access::write), before);
  EXPECT_EQ(array.host(Access::write).data(), before);
}

TEST(Array, BringsTheNewestValuesToWhoAsks) {
  CountingMemory memory;
  Array<double> array(&memory);
  array.assign(std::vector{1.0, 2.0});
  EXPECT_NE(std::as_const(array).device(), array.host().data());
  array.device(Access::read_write)[0] = 7.0;
  EXPECT_EQ(values_of(array), (std::vector{7.0, 2.0}));
  array.host(Access::read_write)[1] = 8.0;
  EXPECT_EQ(array.device()[0], 7.0);
  EXPECT_EQ(array.device()[1], 8.0);
}

TEST(Array, CopiesOnlyWhatIsNeeded) {
  CountingMemory memory;
  Array<double> array(&memory);
  array.resize(3);
  EXPECT_EQ(values_of(array), (std::vector{0.0, 0.0, 0.0}));
  EXPECT_EQ(memory.downloads, 1) << "zeros were made on the device";
  (void)array.host();
  (void)array.device();
  (void)array.device(Access::read_write);
  (void)array.device(Access::read_write);
  EXPECT_EQ(std::pair(memory.downloads, memory.uploads), std::pair(1, 0)) << "both sides had them";
  std::ranges::fill(array.host(Access::write), 1.0);
  EXPECT_EQ(std::pair(memory.downloads, memory.uploads), std::pair(1, 0)) << "all are replaced";
  (void)array.device();
  (void)array.device();
  EXPECT_EQ(std::pair(memory.downloads, memory.uploads), std::pair(1, 1));
}

// The fixture of a forgotten copy: a pointer that was kept while the other side wrote.
TEST(Array, AKeptPointerSeesPoison) {
  exec::EmulatedMemory memory;
  Array<double> array(&memory);
  array.assign(std::vector{1.0, 2.0});
  const double* const kept_on_host = array.host().data();
  const double* const kept_on_device = array.device();
  EXPECT_EQ(kept_on_host[1], 2.0);
  array.device(Access::read_write)[0] = 3.0;
  EXPECT_TRUE(std::isnan(kept_on_host[0]));
  EXPECT_TRUE(std::isnan(kept_on_host[1]));
  EXPECT_EQ(kept_on_device[1], 2.0);
  array.host(Access::read_write)[0] = 4.0;
  EXPECT_TRUE(std::isnan(kept_on_device[0]));
  EXPECT_TRUE(std::isnan(kept_on_device[1]));

  Array<std::int32_t> indices(&memory);
  indices.assign(std::vector<std::int32_t>{5});
  const std::int32_t* const kept = indices.host().data();
  (void)indices.device(Access::write);
  EXPECT_EQ(*kept, -1) << "no place in an array";
}

TEST(Array, WhatNobodyWroteIsPoison) {
  exec::EmulatedMemory memory;
  Array<double> array(&memory);
  array.resize_for_overwrite(2);
  EXPECT_TRUE(std::isnan(array.host()[0]));
  EXPECT_TRUE(std::isnan(array.device()[1]));
  array.assign(std::vector{1.0, 2.0});
  (void)array.device();
  array.resize_for_overwrite(1);
  EXPECT_TRUE(std::isnan(array.host()[0]));
  EXPECT_TRUE(std::isnan(array.device()[0]));
}

class ArrayIn : public testing::TestWithParam<bool> {
 protected:
  [[nodiscard]] exec::DeviceMemory* memory() { return GetParam() ? &memory_ : nullptr; }
  exec::EmulatedMemory memory_;
};

TEST_P(ArrayIn, KeepsValuesWhenItGrowsWhereverTheyAre) {
  for (const bool newest_on_device : {false, true}) {
    Array<double> array(memory());
    array.assign(std::vector{1.0, 2.0});
    if (newest_on_device) array.device(Access::read_write)[0] = 1.5;
    const double first = newest_on_device ? 1.5 : 1.0;
    array.resize(1000);
    EXPECT_EQ(array.host()[0], first);
    EXPECT_EQ(array.host()[1], 2.0);
    EXPECT_EQ(std::accumulate(array.host().begin(), array.host().end(), 0.0), first + 2.0) << "new ones are 0";
    array.resize(1);
    array.resize(3);
    EXPECT_EQ(values_of(array), (std::vector{first, 0.0, 0.0}));
  }
}

TEST_P(ArrayIn, CopiesMovesAndSwaps) {
  Array<double> one(memory());
  Array<double> other(memory());
  one.assign(std::vector{1.0, 2.0});
  other.assign(std::vector{3.0});
  one.device(Access::read_write)[0] = 5.0;
  Array<double> copy = one;
  one.swap(other);
  EXPECT_EQ(values_of(one), (std::vector{3.0}));
  EXPECT_EQ(values_of(other), (std::vector{5.0, 2.0}));
  EXPECT_EQ(values_of(copy), (std::vector{5.0, 2.0}));
  copy = one;
  EXPECT_EQ(copy.device()[0], 3.0);
  const Array<double> moved = std::move(other);
  EXPECT_EQ(values_of(moved), (std::vector{5.0, 2.0}));
  copy.resize(3);
  copy.copy(moved, 0, 2, 1);
  EXPECT_EQ(values_of(copy), (std::vector{3.0, 5.0, 2.0}));
  copy.zero(1);
  EXPECT_EQ(values_of(copy), (std::vector{3.0, 0.0, 0.0}));
}

TEST_P(ArrayIn, OfNothing) {
  Array<double> array(memory());
  EXPECT_TRUE(array.empty());
  EXPECT_TRUE(array.host().empty());
  array.resize(0);
  array.assign(std::vector<double>{});
  (void)array.device(Access::read_write);
  const Array<double> copy = array;
  EXPECT_TRUE(copy.host().empty());
}

INSTANTIATE_TEST_SUITE_P(Memory, ArrayIn, testing::Bool(),
                         [](const auto& set) { return set.param ? "device" : "host"; });

TEST(DeviceMemory, IsCountedAndGivenBack) {
  exec::EmulatedMemory memory;
  {
    Array<double> array(&memory);
    array.assign(std::vector<double>(100));
    EXPECT_EQ(memory.held(), 0U) << "the host has it";
    (void)array.device();
    EXPECT_EQ(memory.held(), 800U);
    Array<double> other = array;
    EXPECT_EQ(memory.held(), 1600U);
    other.resize_for_overwrite(1000);
    EXPECT_EQ(memory.held(), 800U) << "given back before more is taken";
  }
  EXPECT_EQ(memory.held(), 0U);
}

TEST(DeviceMemory, RefusesWhatLeavesTooLittleFree) {
  exec::EmulatedMemory memory(10'000'000'000);
  void* const taken = memory.allocate(8'000'000'000);
  try {
    (void)memory.allocate(1'900'000'000);
    FAIL() << "more than nine tenths of what is free";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::run_failed);
    EXPECT_STREQ(error.what(),
                 "the emulated device has too little memory: an array needs 1.9 GB, and of its 10 GB only 2 GB are "
                 "free, of which a tenth is left alone (this run holds 8 GB there). Take fewer particles (a larger "
                 "particles.spacing), run.precision = \"single\", or run.device = \"cpu\"");
  }
  EXPECT_EQ(memory.held(), 8'000'000'000U);
  void* const more = memory.allocate(1'700'000'000);
  memory.release(more, 1'700'000'000);
  memory.release(taken, 8'000'000'000);
  EXPECT_EQ(memory.held(), 0U);
}

}  // namespace
