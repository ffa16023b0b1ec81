#pragma once

#include <array>
#include <charconv>
#include <string_view>

#include "plugin/plugin_call.hpp"

namespace mesogen {

/// Hands the text of a moment of a run to `write`, piece by piece: " at step 3, t = 0.02 s". Allocates nothing, so a
/// signal handler may use it.
template <class Write>
void write_moment(std::int64_t step, double time, std::string_view time_unit, Write&& write) {
  std::array<char, 32> digits{};
  const auto number = [&](auto... how) {
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), how...).ptr;
    write(std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())));
  };
  write(std::string_view(" at step "));
  number(step);
  write(std::string_view(", t = "));
  number(time, std::chars_format::general, 6);
  write(std::string_view(" "));
  write(time_unit);
}

/// The same for the text of a call.
template <class Write>
void write_call(const PluginCall& call, Write&& write) {
  const bool running = !call.instance.empty();
  if (running) {
    for (const std::string_view piece : {call.section, call.instance, std::string_view(" (")}) write(piece);
  }
  for (const std::string_view piece : {std::string_view("plugin \""), call.plugin, std::string_view("\"")})
    write(piece);
  write(std::string_view(running ? "), " : ", "));
  write(call.call);
  if (!call.subject.empty()) {
    for (const std::string_view piece : {std::string_view(" \""), call.subject, std::string_view("\"")}) write(piece);
  }
  if (call.step != nullptr && call.time != nullptr) write_moment(*call.step, *call.time, call.time_unit, write);
}

}  // namespace mesogen
