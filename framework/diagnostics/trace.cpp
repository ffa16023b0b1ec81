#include "diagnostics/trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace mesogen {

namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<int>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace

Trace::Trace(std::size_t most) : most_(most) { events_.reserve(most); }

void Trace::record(const Counter& counter, Clock::time_point begun, Clock::time_point ended) {
  if (events_.size() < most_) {
    events_.push_back({&counter, counter.runs, begun, ended});
  } else {
    ++left_out_;
  }
}

std::string Trace::text() const {
  // They were recorded as they ended, so what lies inside another stands before it.
  std::vector<Event> events(events_.rbegin(), events_.rend());
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.begun < b.begun; });
  const auto microseconds = [](Clock::duration time) {
    return std::chrono::duration<double, std::micro>(time).count();
  };
  std::string out = fmt::format("{{\"displayTimeUnit\":\"ms\",\"otherData\":{{\"program\":\"mesogen " MESOGEN_VERSION
                                "\",\"events_left_out\":{}}},\"traceEvents\":[\n"
                                R"({{"name":"process_name","ph":"M","pid":1,"tid":1,"args":{{"name":"mesogen"}}}})",
                                left_out_);
  for (const Event& event : events)
    fmt::format_to(std::back_inserter(out),
                   ",\n"
                   R"({{"name":{},"cat":"{}","ph":"X","ts":{:.3f},"dur":{:.3f},"pid":1,"tid":1,"args":{{"run":{}}}}})",
                   quoted(event.counter->title), event.counter->category, microseconds(event.begun - origin_),
                   microseconds(event.ended - event.begun), event.run);
  return out + "\n]}\n";
}

}  // namespace mesogen
