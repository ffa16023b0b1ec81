#include "mesogen/exec/dispatch.hpp"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {
namespace {

template <class Real>
std::string name_of() {
  return std::is_same_v<Real, float> ? "float" : "double";
}

TEST(Dispatch, ByPrecision) {
  const auto name = [](Precision precision) {
    return dispatch(precision, [&]<class Real>() { return name_of<Real>(); });
  };
  EXPECT_EQ(name(Precision::single_precision), "float");
  EXPECT_EQ(name(Precision::double_precision), "double");
}

TEST(Dispatch, ByDimension) {
  const auto twice = [](int dimension) {
    return dispatch<AllDimensions>(dimension, [&]<int Dim>() { return 2 * Dim; });
  };
  EXPECT_EQ(twice(2), 4);
  EXPECT_EQ(twice(3), 6);
}

TEST(Dispatch, ByBoth) {
  std::string called;
  dispatch(Precision::single_precision, 2,
           [&]<class Real, int Dim>() { called = name_of<Real>() + " " + std::to_string(Dim); });
  EXPECT_EQ(called, "float 2");
}

TEST(Dispatch, ReturnsWhatTheActionDoes) {
  int number = 1;
  const auto same = [&](int dimension) -> int& {
    return dispatch(dimension, [&]<int Dim>() -> int& { return number; });
  };
  same(2) = 5;
  EXPECT_EQ(number, 5);
}

TEST(Dispatch, RefusesADimensionThatIsNotBuilt) {
  const auto refusal = [](int dimension) -> std::string {
    try {
      dispatch(Precision::double_precision, dimension, [&]<class Real, int Dim>() { static_assert(Dim == 2); });
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_case);
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(refusal(2), "no error");
  EXPECT_EQ(refusal(3), "there is no code for 3 dimensions, only for 2");
  // A scene that nobody has given its dimension.
  EXPECT_EQ(refusal(0), "there is no code for 0 dimensions, only for 2");
}

TEST(DimensionSet, HoldsWhatItIsGiven) {
  const DimensionSet both{3, 2};
  EXPECT_TRUE(both.contains(2));
  EXPECT_TRUE(both.contains(3));
  for (const int other : {-1, 0, 1, 4, 32, 99}) EXPECT_FALSE(both.contains(other)) << other;
  EXPECT_EQ(both.list(), (std::vector<int>{2, 3}));
  EXPECT_EQ(both.text(), "2 and 3");
  EXPECT_EQ(both.common(DimensionSet{2}), DimensionSet{2});
  EXPECT_TRUE(both.common(DimensionSet{1}).empty());
  EXPECT_EQ(DimensionSet{}.text(), "");
}

}  // namespace
}  // namespace mesogen
