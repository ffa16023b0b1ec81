// A shear wave u_y = U sin(k x) decays as exp(-nu k^2 t).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_run.hpp"

namespace {

using namespace mesogen::test;

constexpr double k = 2.0 * std::numbers::pi;  // box of 1 m
constexpr double viscosity = 0.1;

/// Measured over exact rate of decay, minus 1. So slow a wave leaves the particles on their lattice.
double error_of_decay(int across, const std::string& published = "", const std::string& kernel = "quintic",
                      const std::string& laplacian = "consistent") {
  constexpr double speed = 1e-4;
  CaseText text(1.0, across);
  text.kernel(kernel, laplacian).modes("velocity", fmt::format("[[1, 0, {}, 0.0]]", speed / k));
  published.empty() ? text.flow(viscosity) : text.published_flow(viscosity, published);
  CaseRun run(text);
  const auto amplitude = [&] { return wave_of(run, run.field("velocity", 1), 1, 0).sine; };
  const double begun = amplitude();
  EXPECT_NEAR(begun, speed, 1e-6 * speed);
  const double end = 1.0 / (viscosity * k * k);
  run.run_to(end);
  return std::log(begun / amplitude()) / (viscosity * k * k * end) - 1.0;
}

TEST(ShearWave, DecaysAtTheExactRateInSecondOrder) {
  const double coarse = error_of_decay(16);
  const double fine = error_of_decay(32);
  EXPECT_LT(std::abs(fine), 0.02);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.25) << "errors " << coarse << ", " << fine;
}

// Its fourth kernel moment on a lattice is 1.893 where 2 is needed, whatever the resolution.
TEST(ShearWave, RadialViscosityIsKnownToBeTooThin) {
  for (const int across : {32, 48}) {
    const double component = error_of_decay(across, "", "quintic", "plain");
    const double radial = error_of_decay(across, "viscosity_form = \"monaghan_gingold\"");
    EXPECT_NEAR(radial - component, 1.893 / 2.0 - 1.0, 0.003) << across << " particles across";
  }
}

// There the moment is 1.636; correction and the component-wise form's own bias on a lattice take part of it back.
TEST(ShearWave, RadialViscosityIsThinnerStillWithWendlandC2) {
  const double component = error_of_decay(32, "", "wendland_c2", "plain");
  const double radial = error_of_decay(32, "viscosity_form = \"monaghan_gingold\"", "wendland_c2");
  EXPECT_NEAR(radial - component, -0.143, 0.003);
}

}  // namespace
