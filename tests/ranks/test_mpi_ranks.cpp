// Messages among processes: mpirun starts several of this program, and each runs all tests.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "ranks/journey.hpp"
#include "ranks/mpi_library.hpp"

namespace {

using namespace mesogen;

const Ranks& ranks() { return ranks_of_process(); }

TEST(MpiRanks, AreAsManyAsWereStarted) {
  EXPECT_GT(ranks().count(), 1);
  EXPECT_EQ(ranks().count(), processes_started());
  EXPECT_TRUE(ranks().several());
}

TEST(MpiRanks, FindTheLargestOfAll) {
  std::vector<double> numbers{static_cast<double>(ranks().rank()), 1.0 / (1.0 + ranks().rank()), 0.0};
  ranks().largest(numbers);
  EXPECT_EQ(numbers, (std::vector<double>{ranks().count() - 1.0, 1.0, 0.0}));
}

TEST(MpiRanks, FindWhatIsNotANumberOnOneOfThem) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> numbers{ranks().rank() == 1 ? nan : 5.0, ranks().is_first() ? HUGE_VAL : 5.0};
  ranks().largest(numbers);
  EXPECT_TRUE(std::isnan(numbers[0]));
  EXPECT_EQ(numbers[1], HUGE_VAL);
}

// So many that each rank adds up several, and fewer than there are ranks.
TEST(MpiRanks, AddInTheirOrder) {
  for (const std::size_t count : {std::size_t{1000}, std::size_t{2}}) {
    std::vector<double> sums(count);
    std::vector<double> expected(count, 0.0);
    const auto term = [](int rank, std::size_t n) { return std::pow(10.0, 5 * rank) / (3.0 + static_cast<double>(n)); };
    for (std::size_t n = 0; n < count; ++n) {
      sums[n] = term(ranks().rank(), n);
      expected[n] = term(0, n);
      for (int rank = 1; rank < ranks().count(); ++rank) expected[n] += term(rank, n);
    }
    ranks().add(std::span(sums));
    EXPECT_EQ(sums, expected);
  }
  std::vector<float> single{1.5F, 2.0F};
  ranks().add(std::span(single));
  EXPECT_EQ(single, (std::vector<float>{1.5F * static_cast<float>(ranks().count()),
                                        2.0F * static_cast<float>(ranks().count())}));
  std::vector<std::int64_t> whole{std::int64_t{1} << 60, -1};
  ranks().add(std::span(whole));
  EXPECT_EQ(whole, (std::vector<std::int64_t>{ranks().count() * (std::int64_t{1} << 60), -ranks().count()}));
}

TEST(MpiRanks, TellAllWhatTheFirstHas) {
  std::vector<int> numbers(10, ranks().rank());
  ranks().broadcast(std::as_writable_bytes(std::span(numbers)));
  EXPECT_EQ(numbers, std::vector<int>(10, 0));
}

TEST(MpiRanks, GatherAtTheFirst) {
  // Rank 0 has nothing, rank 1 one number, ...
  const std::vector<int> own(static_cast<std::size_t>(ranks().rank()), ranks().rank());
  std::vector<int> expected;
  for (int rank = 0; rank < ranks().count() && ranks().is_first(); ++rank)
    expected.insert(expected.end(), static_cast<std::size_t>(rank), rank);
  EXPECT_EQ(gather(ranks(), std::span<const int>(own)), expected);
}

TEST(MpiRanks, SwapNumbers) {
  std::vector<std::int64_t> to_each(static_cast<std::size_t>(ranks().count()));
  for (std::size_t to = 0; to < to_each.size(); ++to) to_each[to] = 10 * ranks().rank() + static_cast<int>(to);
  const std::vector<std::int64_t> from_each = ranks().swap(to_each);
  for (std::size_t from = 0; from < from_each.size(); ++from)
    EXPECT_EQ(from_each[from], 10 * static_cast<int>(from) + ranks().rank());
}

TEST(MpiRanks, FindNoMinusZero) {
  std::vector<double> numbers{ranks().rank() == 1 ? -0.0 : 2.0};
  ranks().largest(numbers);
  EXPECT_EQ(numbers[0], 2.0);
}

TEST(MpiRanks, SayWhatTheWorstOffSays) {
  const std::string own(static_cast<std::size_t>(ranks().rank()) + 1, static_cast<char>('a' + ranks().rank()));
  EXPECT_EQ(text_of_worst(ranks(), ranks().rank() == 1 ? HUGE_VAL : 1.0, own), "bb");
  EXPECT_EQ(text_of_worst(ranks(), 0.0, own), "a");  // the first of equals
}

TEST(MpiRanks, NoticeWhereTextsDiffer) {
  EXPECT_TRUE(same_on_all(ranks(), "a case"));
  EXPECT_FALSE(same_on_all(ranks(), ranks().rank() == 1 ? "another case" : "a case"));
}

TEST(MpiRanks, TellWhetherItIsSoAnywhere) {
  EXPECT_TRUE(any(ranks(), ranks().rank() == ranks().count() - 1));
  EXPECT_FALSE(any(ranks(), false));
}

TEST(Journeys, BringElementsToTheirRanks) {
  // Rank r has elements 100 r + i; every element goes to rank i % count.
  const int count = ranks().count();
  const int elements = 2 * count + 1;
  std::vector<int> owner(static_cast<std::size_t>(elements));
  std::vector<int> own(owner.size());
  for (int i = 0; i < elements; ++i) {
    owner[static_cast<std::size_t>(i)] = i % count;
    own[static_cast<std::size_t>(i)] = 100 * ranks().rank() + i;
  }
  const Journey journey(ranks(), owner);
  EXPECT_TRUE(journey.anybody());
  const std::vector<int> after = journey.carry(std::span<const int>(own));
  std::vector<int> expected;
  const auto add = [&](int from) {
    for (int i = ranks().rank(); i < elements; i += count) expected.push_back(100 * from + i);
  };
  add(ranks().rank());
  for (int from = 0; from < count; ++from)
    if (from != ranks().rank()) add(from);
  EXPECT_EQ(after, expected);
  EXPECT_EQ(journey.size(), expected.size());
  EXPECT_EQ(journey.bring_back(std::span<const int>(after)), own);
}

TEST(Journeys, OfNobodyChangeNothing) {
  const std::vector<int> owner(3, ranks().rank());
  const Journey journey(ranks(), owner);
  EXPECT_FALSE(journey.anybody());
  const std::vector<double> own{1.0, 2.0, 3.0};
  EXPECT_EQ(journey.carry(std::span<const double>(own)), own);
}

}  // namespace
