// Copies of values that go on to change: on the host, on a device, and on a device without room for copies.

#include "exec/snapshot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "counting_memory.hpp"

namespace {

using namespace mesogen;
using exec::Access;
using exec::Array;
using exec::Side;
using exec::Snapshot;
using test::CountingMemory;

template <class T>
std::vector<T> copy_at(const std::byte* place, std::size_t count) {
  std::vector<T> values(count);
  std::memcpy(values.data(), place, count * sizeof(T));
  return values;
}

/// Three doubles on the device and five integers on the host.
struct Values {
  explicit Values(exec::DeviceMemory* memory) : numbers(memory), counts(memory) {
    numbers.resize_for_overwrite(3);
    counts.assign(std::vector<std::int32_t>{1, 2, 3, 4, 5});
    set(1.5);
  }
  void set(double value) { std::fill_n(numbers.device(Access::write), 3, value); }
  [[nodiscard]] std::vector<Snapshot::Source> sources() const {
    return {{counts.on(Side::host), 5 * sizeof(std::int32_t), Side::host},
            {numbers.on(Side::device), 3 * sizeof(double), Side::device},
            {counts.on(Side::host) + 3, 2 * sizeof(std::int32_t), Side::host}};
  }
  Array<double> numbers;
  Array<std::int32_t> counts;
};

void expect_kept(const Snapshot& snapshot, double value) {
  const auto places = snapshot.wait();
  ASSERT_EQ(places.size(), 3U);
  EXPECT_EQ(copy_at<std::int32_t>(places[0], 5), (std::vector<std::int32_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(copy_at<double>(places[1], 3), std::vector<double>(3, value));
  EXPECT_EQ(copy_at<std::int32_t>(places[2], 2), (std::vector<std::int32_t>{4, 5}));
}

TEST(Snapshot, HoldsValuesAsTheyWere) {
  CountingMemory memory;
  Values values(&memory);
  ASSERT_FALSE(values.numbers.is_on(Side::host));
  Snapshot snapshot(&memory);
  for (const double value : {2.0, 3.0, 4.0}) {
    values.set(value);
    snapshot.take(values.sources());
    values.set(-1.0);
    expect_kept(snapshot, value);
  }
  EXPECT_EQ(memory.brought, 0U);
  EXPECT_FALSE(values.numbers.is_on(Side::host)) << "the values themselves stay where they are";
}

TEST(Snapshot, KeepsItsRoom) {
  CountingMemory memory;
  Values values(&memory);
  Snapshot snapshot(&memory);
  snapshot.take(values.sources());
  const std::size_t held = memory.held();
  snapshot.take(values.sources());
  EXPECT_EQ(memory.held(), held);
}

TEST(Snapshot, OfADeviceWithoutRoomIsWaitedFor) {
  CountingMemory memory;
  Values values(&memory);
  Snapshot snapshot(&memory);
  memory.full = true;
  snapshot.take(values.sources());
  values.set(-1.0);
  expect_kept(snapshot, 1.5);
  EXPECT_EQ(memory.brought, 3 * sizeof(double));
  memory.full = false;
  values.set(7.0);
  snapshot.take(values.sources());
  values.set(-1.0);
  expect_kept(snapshot, 7.0);
  EXPECT_EQ(memory.brought, 3 * sizeof(double)) << "there is room again";
}

TEST(Snapshot, OnTheHostIsACopy) {
  Values values(nullptr);
  Snapshot snapshot(nullptr);
  auto sources = values.sources();
  for (Snapshot::Source& source : sources) source.side = Side::host;
  snapshot.take(sources);
  values.set(-1.0);
  expect_kept(snapshot, 1.5);
}

// What makes the tests of runs fail where a copy on the device is forgotten.
TEST(Fetch, OfAnEmulatedDeviceCopiesWhenItIsWaitedFor) {
  exec::EmulatedMemory memory;
  Array<double> array(&memory);
  array.resize_for_overwrite(1);
  array.device(Access::write)[0] = 1.0;
  const auto fetch = memory.make_fetch();
  fetch->begin(array.device(), sizeof(double));
  array.device(Access::read_write)[0] = 2.0;
  EXPECT_EQ(*static_cast<const double*>(fetch->wait()), 2.0);
}

}  // namespace
