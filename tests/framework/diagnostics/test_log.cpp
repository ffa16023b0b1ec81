#include "diagnostics/log.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string on_stderr(bool quiet) {
  ::testing::internal::CaptureStderr();
  Log log(quiet);
  log.info("begins with {} in it");
  log.warn("odd");
  log.error("broken");
  return ::testing::internal::GetCapturedStderr();
}

TEST(Log, TellsTheUser) { EXPECT_EQ(on_stderr(false), "begins with {} in it\nwarning: odd\nerror: broken\n"); }

TEST(Log, TellsOnlyTroubleWhenQuiet) { EXPECT_EQ(on_stderr(true), "warning: odd\nerror: broken\n"); }

TEST(Log, KeepsEverythingInAFile) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "mesogen_test.log";
  std::filesystem::remove(file);
  for (const char* const text : {"first", "second"}) {
    Log log(true);
    log.open_file(file);
    log.info(text);
  }
  const std::regex lines(R"(\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3} info first\n\d{4}-.* info second\n)");
  EXPECT_TRUE(std::regex_match(content(file), lines)) << content(file);
  std::filesystem::remove(file);
}

TEST(Log, SaysWhereItCannotWrite) {
  Log log;
  try {
    log.open_file("/proc/no/run.log");
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::run_failed);
    EXPECT_TRUE(std::string(error.what()).starts_with("the log /proc/no/run.log cannot be written: ")) << error.what();
  }
}

}  // namespace
}  // namespace mesogen
