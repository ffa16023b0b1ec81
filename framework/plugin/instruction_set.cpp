#include "plugin/instruction_set.hpp"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen::plugin {

namespace {

constexpr std::string_view baseline = "baseline";
constexpr std::string_view avx2 = "x86-64-v3";
constexpr std::string_view avx512 = "x86-64-v4";

std::vector<std::string> sets_of_processor() {
  std::vector<std::string> sets;
#if defined(__x86_64__)
  // The features that make up the two levels, as far as the compiler can ask for them. Clang 14 does not know the
  // levels by name.
  const bool third = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
                     __builtin_cpu_supports("bmi2");
  const bool fourth = third && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  if (fourth) sets.emplace_back(avx512);
  if (third) sets.emplace_back(avx2);
#endif
  return sets;
}

}  // namespace

std::vector<std::string> capped(const std::vector<std::string>& sets, std::string_view cap) {
  if (cap.empty() || cap == avx512) return sets;
  if (cap == baseline) return {};
  if (cap != avx2)
    throw Error(ExitCode::bad_case, "MESOGEN_SIMD is \"" + std::string(cap) +
                                        "\"; it must be baseline, x86-64-v3 or x86-64-v4, or not be set");
  std::vector<std::string> allowed = sets;
  std::erase(allowed, avx512);
  return allowed;
}

std::vector<std::string> usable_instruction_sets() {
  const char* cap = std::getenv("MESOGEN_SIMD");
  return capped(sets_of_processor(), cap == nullptr ? "" : cap);
}

std::string narrow_code_text(std::string_view built, const std::vector<std::string>& sets) {
  if (sets.empty() || built == sets.front()) return {};
  if (built != baseline && std::ranges::find(sets, built) == sets.end()) return {};  // wider than asked for
  return "sums over neighbours run in code for " + std::string(built) + ", but this processor has " + sets.front() +
         ": they would be faster if Mesogen were built on this machine, or with -DMESOGEN_INSTRUCTION_SETS=" +
         sets.front();
}

Variant best_variant(const std::filesystem::path& file, const std::vector<std::string>& sets) {
  for (const auto& set : sets) {
    const auto wider = file.parent_path() / set / file.filename();
    std::error_code ignored;
    if (std::filesystem::is_regular_file(wider, ignored)) return {wider, set};
  }
  return {file, std::string(baseline)};
}

std::filesystem::path cuda_variant(const std::filesystem::path& file, std::string_view instruction_set) {
  const auto folder = instruction_set == baseline ? file.parent_path() : file.parent_path().parent_path();
  auto wanted = folder / "cuda" / file.filename();
  std::error_code ignored;
  return std::filesystem::is_regular_file(wanted, ignored) ? wanted : std::filesystem::path();
}

}  // namespace mesogen::plugin
