// Smoothing lengths that leave a particle too few neighbours: refused with the least that is enough, and that is.

#include "run/fewest_neighbours.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>
#include <vector>

#include "case_run.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen::test {
namespace {

constexpr double length = 3.2;
constexpr int across = 32;
const double k = 2.0 * std::numbers::pi / length;

/// A nematic, with or without a flow, that reads gradient and Laplacian of its order tensor.
CaseText nematic(const std::string& kernel, double smoothing_length, const std::string& arrangement, bool moving) {
  CaseText text(length, across);
  text.section("particles", fmt::format("spacing = {}\n{}", length / across, arrangement))
      .section("kernel", fmt::format("type = \"{}\"\nsmoothing_length = {}", kernel, smoothing_length))
      .modes("director", "[[1, 0, 0.2, 0.3]]")
      .nematic(0.4, 0.7, 0.02)
      .read("\"order_tensor\", \"order_tensor_gradient\", \"order_tensor_laplacian\"");
  if (moving) text.flow(0.5);
  return text;
}

std::string refusal_of(const CaseText& text) {
  try {
    const CaseRun run(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    return error.what();
  }
  return {};
}

/// The least smoothing length that a refusal names.
double least_of(const std::string& refusal) {
  std::smatch found;
  return std::regex_search(refusal, found, std::regex("needs at least ([0-9.]+) here")) ? std::stod(found[1]) : 0.0;
}

/// Error of the Laplacian of the first component of the order tensor, cos(2 theta), relative to its root mean square.
double error_of_laplacian(CaseRun& run) {
  const auto x = run.path(0);
  const auto found = run.field("order_tensor_laplacian", 0);
  double wrong = 0.0;
  double whole = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double angle = 0.2 * std::cos(k * x[i] + 0.3);
    const double slope = -0.2 * k * std::sin(k * x[i] + 0.3);
    const double curvature = -k * k * angle;
    const double exact = -4.0 * slope * slope * std::cos(2.0 * angle) - 2.0 * curvature * std::sin(2.0 * angle);
    wrong += (found[i] - exact) * (found[i] - exact);
    whole += exact * exact;
  }
  return std::sqrt(wrong / whole);
}

const char* const lattice = "";
const char* const hexagonal = "arrangement = \"hexagonal\"";
const char* const jittered = "arrangement = \"jittered\"\njitter = 0.1";
const char* const random = "arrangement = \"jittered\"\njitter = 0.5";

TEST(FewestNeighbours, AreRefusedByNameOfTheKernelWithTheLeastThatIsEnough) {
  for (const char* const kernel : {"quintic", "wendland_c2", "wendland_c4", "wendland_c6"})
    for (const char* const arrangement : {lattice, hexagonal, jittered, random})
      for (const bool moving : {false, true}) {
        SCOPED_TRACE(std::string(kernel) + " " + arrangement + (moving ? " moving" : ""));
        const std::string refusal = refusal_of(nematic(kernel, 0.1, arrangement, moving));
        EXPECT_NE(refusal.find("kernel.smoothing_length: is 0.1 particle spacings, which leaves a particle too few "
                               "neighbours for second derivatives: the kernel \"" +
                               std::string(kernel) + "\" needs at least "),
                  std::string::npos)
            << refusal;
        const double least = least_of(refusal);
        EXPECT_LT(least, std::string(kernel) == "quintic" ? 1.0 : 1.5);
        CaseRun run(nematic(kernel, least, arrangement, moving));
        EXPECT_LT(error_of_laplacian(run), 0.1) << least;
        EXPECT_EQ(least_of(refusal_of(nematic(kernel, least - 0.01, arrangement, moving))), least);
      }
}

TEST(FewestNeighbours, ThePlainLaplacianNeedsThoseOfAGradientAlone) {
  CaseText text = nematic("quintic", 0.1, lattice, false);
  text.section("kernel", "type = \"quintic\"\nsmoothing_length = 0.1\nlaplacian = \"plain\"");
  const std::string refusal = refusal_of(text);
  EXPECT_NE(refusal.find("too few neighbours for a gradient"), std::string::npos) << refusal;
  EXPECT_LT(least_of(refusal), least_of(refusal_of(nematic("quintic", 0.1, lattice, false))));
}

TEST(FewestNeighbours, DoNotMatterWhereNobodySumsOverThem) {
  CaseText text(length, across);
  text.section("kernel", "type = \"quintic\"\nsmoothing_length = 0.1")
      .modes("director", "[[1, 0, 0.2, 0.3]]")
      .section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 0.5")
      .nematic(0.4, 0.7, 0.02)
      .active(0.05);
  EXPECT_EQ(refusal_of(text), "");
  text.read("\"velocity\", \"volume\"");
  EXPECT_NE(refusal_of(text).find("too few neighbours"), std::string::npos);
}

}  // namespace
}  // namespace mesogen::test
