#include "particles/field.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using namespace mesogen;

constexpr auto host = exec::Side::host;

TEST(Field, KeepsDoublesOfIntegratedFieldsInSinglePrecision) {
  Field field("u", 2, Precision::single_precision, true);
  field.resize(3, 0);
  field.set(1, 2, 1.0 + 1e-12);
  EXPECT_EQ(field.value(1, 2), 1.0 + 1e-12);
  EXPECT_EQ(field.master(host)(1, 2), 1.0 + 1e-12);
  EXPECT_EQ(field.view<float>(host)(1, 2), 1.0F);
  EXPECT_FALSE(field.is_double());
}

TEST(Field, HoldsFloatsAloneOtherwise) {
  Field field("p", 1, Precision::single_precision, false);
  field.resize(2, 0);
  field.set(0, 1, 1.0 + 1e-12);
  EXPECT_EQ(field.value(0, 1), 1.0);
  EXPECT_EQ(field.master(host).base, nullptr);
}

TEST(Field, KeepsValuesWhenItGrows) {
  Field field("u", 2, Precision::double_precision, false);
  field.resize(3, 0);
  for (int c = 0; c < 2; ++c)
    for (Index i = 0; i < 3; ++i) field.set(c, i, 10.0 * c + i);
  field.resize(3, 1000);
  for (int c = 0; c < 2; ++c)
    for (Index i = 0; i < 3; ++i) EXPECT_EQ(field.value(c, i), 10.0 * c + i);
}

TEST(Field, PermutesAllComponentsAndTheMaster) {
  Field field("u", 2, Precision::single_precision, true);
  field.resize(4, 0);
  for (int c = 0; c < 2; ++c)
    for (Index i = 0; i < 4; ++i) field.set(c, i, 10.0 * c + i + 1e-13);
  const auto before = field.version;
  Field::Scratch scratch;
  exec::Array<Index> order;
  order.assign(std::vector<Index>{2, 0, 3, 1});
  field.permute(order, scratch);
  EXPECT_EQ(field.version, before) << "no particle has another value";
  const Index from[] = {2, 0, 3, 1};
  for (int c = 0; c < 2; ++c) {
    for (Index n = 0; n < 4; ++n) {
      EXPECT_EQ(field.value(c, n), 10.0 * c + from[n] + 1e-13);
      EXPECT_EQ(field.view<float>(host)(c, n), static_cast<float>(10.0 * c + from[n] + 1e-13));
    }
  }
}

TEST(Field, ZeroingLeavesNothing) {
  Field field("a", 2, Precision::double_precision, false);
  field.resize(3, 2);
  for (int c = 0; c < 2; ++c)
    for (Index i = 0; i < 3; ++i) field.set(c, i, 1.0);
  field.fill_zero();
  for (int c = 0; c < 2; ++c)
    for (Index i = 0; i < 3; ++i) EXPECT_EQ(field.value(c, i), 0.0);
}

TEST(FieldStore, FindsByNameAndRefusesTwins) {
  FieldStore store;
  store.add(std::make_unique<Field>("u", 1, Precision::double_precision, false));
  EXPECT_NE(store.find("u"), nullptr);
  EXPECT_EQ(store.find("v"), nullptr);
  try {
    (void)store.at("v");
    FAIL();
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "there is no field 'v'");
  }
  try {
    store.add(std::make_unique<Field>("u", 1, Precision::double_precision, false));
    FAIL();
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "field 'u' exists already");
  }
}

TEST(Field, ExchangesWhatIsAdvancedAndLeavesWhatPassesSee) {
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    Field field("u", 2, precision, true);
    Field start("start of u", 2, Precision::double_precision, true);
    for (Field* const one : {&field, &start}) one->resize(3, 2);
    for (int c = 0; c < 2; ++c) {
      for (Index i = 0; i < 3; ++i) {
        field.set(c, i, 10.0 * c + i);
        start.set(c, i, -10.0 * c - i);
      }
    }
    const auto versions = std::pair(field.version, start.version);
    field.exchange_master(start);
    for (int c = 0; c < 2; ++c) {
      for (Index i = 0; i < 3; ++i) {
        EXPECT_EQ(start.value(c, i), 10.0 * c + i);
        EXPECT_EQ(field.value(c, i), -10.0 * c - i);
        if (precision == Precision::single_precision) {
          EXPECT_EQ(field.view<float>(host)(c, i), static_cast<float>(10.0 * c + i));
        }
      }
    }
    EXPECT_GT(field.version, versions.first) << "what lies beyond the faces is out of date";
    EXPECT_GT(start.version, versions.second);
  }
}

TEST(Field, ExchangesOnlyWhatIsStoredAlike) {
  Field field("u", 2, Precision::double_precision, true);
  Field other("q", 1, Precision::double_precision, true);
  for (Field* const one : {&field, &other}) one->resize(3, 0);
  try {
    field.exchange_master(other);
    FAIL() << "two components and one";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(), "'u' and 'q' are stored in different ways");
  }
}

}  // namespace
