#include "diagnostics/trace.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mesogen {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Trace, ASpanCountsWithAndWithoutATrace) {
  Counter counter{"physics.flow: momentum", "plugin"};
  Trace trace;
  {
    const Span span(counter, nullptr);
    EXPECT_EQ(counter.runs, 0);
  }
  EXPECT_EQ(counter.runs, 1);
  EXPECT_EQ(trace.recorded(), 0U);
  { const Span span(counter, &trace); }
  EXPECT_EQ(counter.runs, 2);
  EXPECT_GT(counter.seconds, 0.0);
  EXPECT_EQ(trace.recorded(), 1U);
}

TEST(Trace, WorkThatThrowsIsInIt) {
  Counter counter{"physics.flow: momentum", "plugin"};
  Trace trace;
  EXPECT_THROW(
      {
        const Span span(counter, &trace);
        throw std::runtime_error("broken");
      },
      std::runtime_error);
  EXPECT_EQ(counter.runs, 1);
  EXPECT_EQ(trace.recorded(), 1U);
}

// What it looks like to the programs that read it, number for number.
TEST(Trace, IsInTheTraceEventFormat) {
  Counter pass{"physics.flow: momentum", "plugin", 7};
  Trace trace;
  const auto begun = Trace::Clock::now();
  trace.record(pass, begun, begun + std::chrono::nanoseconds(12'345'678));
  const std::string text = trace.text();
  EXPECT_TRUE(text.starts_with(R"({"displayTimeUnit":"ms","otherData":{"program":"mesogen )")) << text;
  EXPECT_EQ(count(text, R"({"name":"physics.flow: momentum","cat":"plugin","ph":"X","ts":)"), 1U) << text;
  EXPECT_EQ(count(text, R"("dur":12345.678,"pid":1,"tid":1,"args":{"run":7}})"), 1U) << text;
  EXPECT_TRUE(text.ends_with("\n]}\n")) << text;
}

TEST(Trace, IsInTheOrderOfStartsTheOuterOneFirst) {
  Counter outer{"outer"};
  Counter inner{"inner"};
  Counter later{"later"};
  Trace trace;
  const auto at = [now = Trace::Clock::now()](int ms) { return now + std::chrono::milliseconds(ms); };
  trace.record(inner, at(0), at(1));  // as they end
  trace.record(outer, at(0), at(2));
  trace.record(later, at(3), at(4));
  const std::string text = trace.text();
  EXPECT_LT(text.find("outer"), text.find("inner"));
  EXPECT_LT(text.find("inner"), text.find("later"));
}

TEST(Trace, HoldsNoMoreThanItsRoomAndSaysSo) {
  Counter counter{"pass"};
  Trace trace(3);
  for (int n = 0; n < 5; ++n) const Span span(counter, &trace);
  EXPECT_EQ(counter.runs, 5);
  EXPECT_EQ(trace.recorded(), 3U);
  EXPECT_EQ(trace.left_out(), 2);
  EXPECT_EQ(count(trace.text(), R"("events_left_out":2)"), 1U);
  EXPECT_EQ(count(trace.text(), R"("ph":"X")"), 3U);
}

TEST(Trace, NamesAreQuoted) {
  Counter counter{"a \"name\" with \\ and\n"};
  Trace trace;
  { const Span span(counter, &trace); }
  EXPECT_EQ(count(trace.text(), R"("name":"a \"name\" with \\ and\u000a")"), 1U) << trace.text();
}

TEST(Trace, OfNothingIsValid) { EXPECT_EQ(count(Trace(0).text(), R"("ph":"X")"), 0U); }

}  // namespace
}  // namespace mesogen
