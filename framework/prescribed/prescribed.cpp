#include "prescribed/prescribed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/given_value.hpp"
#include "case/toml_text.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "text/nearest.hpp"

namespace mesogen {

namespace {

/// What is wrong at a place of the case.
struct Wrong {
  SourcePlace place;
  std::string text;
};

double number_in(const Value& value, const std::string& what) {
  if (const auto* const number = value.as<double>(); number != nullptr && std::isfinite(*number)) return *number;
  if (const auto* const integer = value.as<std::int64_t>()) return static_cast<double>(*integer);
  throw Wrong{value.place, fmt::format("{} must be a number, but is {}", what, shown(value))};
}

/// The elements of a list, or the value alone.
std::vector<Value> elements(const Value& value) {
  const auto* const list = value.as<Value::List>();
  return list != nullptr ? *list : std::vector<Value>{value};
}

std::vector<std::string> files_in(const Value& value) {
  std::vector<std::string> files;
  for (const Value& one : elements(value)) {
    const auto* const name = one.as<std::string>();
    if (name == nullptr)
      throw Wrong{one.place,
                  fmt::format("image must be the name of a PNG file, or a list of such, but is {}", shown(one))};
    files.push_back(*name);
  }
  if (files.empty()) throw Wrong{value.place, "image must name at least one PNG file, but is []"};
  return files;
}

std::vector<double> times_in(const Value* value, std::size_t count, const SourcePlace& table) {
  if (value == nullptr && count == 1) return {0.0};
  if (value == nullptr) throw Wrong{table, fmt::format("{} images need as many times: add times = [...]", count)};
  std::vector<double> times;
  for (const Value& one : elements(*value)) times.push_back(number_in(one, "each of times"));
  if (times.size() != count)
    throw Wrong{value->place, fmt::format("times must be as many as the images, {}, but are {}", count, times.size())};
  for (std::size_t n = 1; n < times.size(); ++n)
    if (!(times[n] > times[n - 1]))
      throw Wrong{value->place, fmt::format("times must rise, but {} comes after {}", times[n], times[n - 1])};
  return times;
}

/// { image = "mask.png", low = 0.0, high = 0.08 }, or several images with times.
Program image_program(const Value& table) {
  const std::vector<std::string> known = {"image", "low", "high", "times"};
  for (const auto& [key, place, value] : *table.as<Value::Table>())
    if (std::ranges::find(known, key) == known.end())
      throw Wrong{place, fmt::format("unknown key \"{}\"{}; known here: image, low, high, times", key,
                                     did_you_mean(key, known))};
  const auto needed = [&](const char* key) -> const Value& {
    const Value* const value = table.find(key);
    if (value == nullptr)
      throw Wrong{table.place, fmt::format("{} must be given: write {{ image = \"mask.png\", low = 0.0, high = 1.0 }}, "
                                           "where black is low and white is high",
                                           key)};
    return *value;
  };
  const Value& image = needed("image");
  const double low = number_in(needed("low"), "low");
  const double high = number_in(needed("high"), "high");
  const std::vector<std::string> files = files_in(image);
  std::vector<double> times = times_in(table.find("times"), files.size(), table.place);
  ProgramWriter writer;
  try {
    const int brightness = writer.film(read_film(files, std::move(times)));
    const int range = writer.constant(high - low);
    return writer.finish(writer.apply(exec::Operation::add, writer.constant(low),
                                      writer.apply(exec::Operation::multiply, range, brightness)));
  } catch (const Error& error) {
    throw Wrong{image.place, error.what()};
  }
}

Program program_of(const Value& value, const Vocabulary& words) {
  if (value.as<Value::Table>() != nullptr) return image_program(value);
  if (const auto* const text = value.as<std::string>()) try {
      return parse_expression(*text, words);
    } catch (const Error& error) {
      throw Wrong{value.place, fmt::format("{}: {}", shown(value), error.what())};
    }
  ProgramWriter writer;
  return writer.finish(writer.constant(number_in(value, "it")));
}

}  // namespace

bool Prescribed::is_list() const { return std::holds_alternative<std::vector<double>*>(parameter.target); }

bool Prescribed::reads_fields() const {
  return std::ranges::any_of(components, [](const Program& program) { return !program.fields.empty(); });
}

bool Prescribed::constant() const { return std::ranges::all_of(components, &Program::constant); }

bool Prescribed::changes_in_time() const { return std::ranges::any_of(components, &Program::changes_in_time); }

std::string full_key(const Prescribed& prescribed) { return prescribed.section.full_key(prescribed.parameter.name); }

std::vector<Prescribed> prescribed_in(const std::string& owner, const CaseSection& section, const ParameterList& list) {
  std::vector<Prescribed> all;
  for (const Parameter& parameter : list.all())
    if (parameter.given && parameter.given->value) all.push_back({owner, section, parameter});
  return all;
}

void make_programs(Prescribed& prescribed, const Vocabulary& words, Problems& problems) {
  const Value& value = *prescribed.parameter.given->value;
  const auto is_text = [](const Value& one) { return one.as<std::string>() != nullptr; };
  // Images stay as they were read.
  if (!prescribed.components.empty() && std::ranges::none_of(elements(value), is_text)) return;
  prescribed.components.clear();
  for (const Value& one : prescribed.is_list() ? elements(value) : std::vector<Value>{value}) try {
      prescribed.components.push_back(program_of(one, words));
    } catch (const Wrong& wrong) {
      problems.add(wrong.place, full_key(prescribed), wrong.text);
    }
}

const Value& value_of(const Prescribed& prescribed, std::size_t component) {
  const Value& value = *prescribed.parameter.given->value;
  const auto* const list = value.as<Value::List>();
  return list != nullptr ? (*list)[component] : value;
}

std::string what_is_wrong(const Prescribed& prescribed, double value) {
  const Parameter& parameter = prescribed.parameter;
  if (!std::isfinite(value)) return "must be finite everywhere";
  const bool low = value < parameter.lowest || (parameter.lowest_excluded && value == parameter.lowest);
  const bool high = value > parameter.highest || (parameter.highest_excluded && value == parameter.highest);
  if (!low && !high) return {};
  const std::string unit = prescribed.section.units().text(parameter.unit_text);
  return fmt::format("must be {}{} everywhere", parameter.range_text(), unit == "1" ? "" : " " + unit);
}

// What a step is stable for has some room; what rounds has a little.
FieldBounds bounds_of(const Prescribed& prescribed) {
  constexpr double room = 1.2;
  constexpr double rounding = 1e-6;
  double square = 0.0;
  for (const double one : prescribed.largest) square += one * one;
  const double largest = std::sqrt(square);
  const std::string remedy =
      prescribed.reads_fields()
          ? "Limits on the step go by the largest value that " + full_key(prescribed) +
                " was expected to have: raise the key `largest` in the section that brings what it reads"
          : "Mend " + full_key(prescribed) +
                ", or let it be as large where the particles start or at an earlier time: limits on the step go by the "
                "largest value that is found there";
  FieldBounds bounds{-room * largest, room * largest, remedy};
  if (prescribed.is_list()) return bounds;
  bounds.lowest = std::max(bounds.lowest, prescribed.parameter.lowest - rounding * largest);
  bounds.highest = std::min(bounds.highest, prescribed.parameter.highest + rounding * largest);
  return bounds;
}

void take_numbers(Prescribed& prescribed) {
  prescribed.components.clear();
  prescribed.largest = prescribed.is_list() ? *std::get<std::vector<double>*>(prescribed.parameter.target)
                                            : std::vector{*std::get<double*>(prescribed.parameter.target)};
  for (const double number : prescribed.largest) {
    ProgramWriter writer;
    prescribed.components.push_back(writer.finish(writer.constant(number)));
  }
}

std::string shown(const Prescribed& prescribed) {
  return prescribed.parameter.given->value ? shown(*prescribed.parameter.given->value) : "a number";
}

void set_numbers(const Prescribed& prescribed) {
  if (prescribed.is_list()) {
    *std::get<std::vector<double>*>(prescribed.parameter.target) = prescribed.largest;
  } else {
    *std::get<double*>(prescribed.parameter.target) = prescribed.largest.front();
  }
}

}  // namespace mesogen
