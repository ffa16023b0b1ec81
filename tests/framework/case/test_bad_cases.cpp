#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "case_texts.hpp"

namespace mesogen {
namespace {

/// Every broken case says in its last lines, "# expect: ...", all that must be said about it, and nothing else may be.
class BadCases : public ::testing::TestWithParam<std::filesystem::path> {};

std::string sorted(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  std::sort(lines.begin(), lines.end());
  std::string result;
  for (const auto& line : lines) result += line + "\n";
  return result;
}

TEST_P(BadCases, AreRefusedWithTheseWords) {
  std::ifstream file(GetParam());
  std::ostringstream content;
  content << file.rdbuf();
  const std::string text = content.str();
  std::string expected;
  std::istringstream lines(text);
  const std::string mark = "# expect: ";
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(mark)) expected += line.substr(mark.size()) + "\n";
  ASSERT_NE(expected, "") << "no expectation in " << GetParam();
  Problems problems;
  testing::read_all(text, {}, problems);
  EXPECT_EQ(sorted(problems.text()), sorted(expected));
}

std::vector<std::filesystem::path> fixtures() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(MESOGEN_TEST_FIXTURES "/bad_cases"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

INSTANTIATE_TEST_SUITE_P(Fixtures, BadCases, ::testing::ValuesIn(fixtures()),
                         [](const auto& parameter) { return parameter.param.stem().string(); });

TEST(BadCaseFixtures, AreMany) { EXPECT_GE(fixtures().size(), 20U); }

}  // namespace
}  // namespace mesogen
