// Which steps a case is given: explicit or stabilised.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "case_run.hpp"
#include "error_of.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

CaseText active(double viscosity, int across, const std::string& time = "") {
  CaseText text(10.0, across);
  text.modes("director", "[[1, 0, 0.05, 0.3], [0, 1, 0.03, 1.1]]")
      .flow(viscosity)
      .nematic(0.4, 0.7, 0.02)
      .active(0.05)
      .section("time", "end = 100.0\n" + time);
  return text;
}

bool stabilised(const CaseText& text) { return CaseRun::unstarted(text).setup().scene.stabilised_steps; }

TEST(Stepping, IsStabilisedWhereThatPays) {
  EXPECT_TRUE(stabilised(active(2.0 / 3.0, 48)));
  EXPECT_TRUE(stabilised(active(2.0 / 3.0, 24)));
  // Taylor and Green's vortices at Re = 100: sound and motion limit the step either way.
  CaseText vortices(10.0, 100);
  vortices.modes("velocity", "[[1, 1, 1.0, 0.0]]").flow(0.1);
  EXPECT_FALSE(stabilised(vortices));
  EXPECT_FALSE(stabilised(active(2.0 / 3.0, 48, "stepping = \"explicit\"")));
  EXPECT_FALSE(stabilised(active(2.0 / 3.0, 48, "scheme = \"half_steps\"")));
  EXPECT_FALSE(stabilised(active(2.0 / 3.0, 48, "step = 0.01")));
  EXPECT_TRUE(stabilised(active(2.0 / 3.0, 48, "step = 0.2")));
}

TEST(Stepping, LinearTermsThenLimitNoStep) {
  const auto limits = [](const std::string& time) {
    CaseText text = active(2.0 / 3.0, 48, time);
    text.section("physics.substrate", "type = \"friction\"\ncoefficient = 100.0");
    CaseRun run = CaseRun::unstarted(text);
    std::map<StepCause, double> all;
    for (const auto& limit : run.setup().limits.all()) all[limit.cause] = limit.seconds;
    return all;
  };
  const auto usual = limits("stepping = \"explicit\"");
  EXPECT_DOUBLE_EQ(usual.at(StepCause::friction), 0.25 / 100.0);
  EXPECT_LT(usual.at(StepCause::viscosity), 0.03);
  const auto free = limits("stepping = \"stabilised\"");
  for (const StepCause cause : {StepCause::friction, StepCause::viscosity, StepCause::elasticity})
    EXPECT_TRUE(std::isinf(free.at(cause)));
  // c0^2 = activity / (rho delta) = 5 m2/s2
  EXPECT_NEAR(free.at(StepCause::sound), 2.0 * (2.0 / 3.0) / 5.0, 1e-12);
}

TEST(Stepping, IsRefusedWhereItCannotBe) {
  EXPECT_NE(
      error_of([] { stabilised(active(1.0, 24, "stepping = \"stabilised\"\nscheme = \"half_steps\"")); },
               ExitCode::bad_case)
          .find("time.stepping: stabilised steps have a scheme of their own: leave time.scheme at \"midpoint\", or "
                "take \"explicit\""),
      std::string::npos);
  CaseText mesh = active(1.0, 24, "stepping = \"stabilised\"");
  mesh.section("physics.flow", "type = \"incompressible\"\ndensity = 1.0\nviscosity = 1.0");
  EXPECT_NE(error_of([&] { stabilised(mesh); }, ExitCode::bad_case)
                .find("time.stepping: stages are for viscosity, elasticity, friction and other linear terms that "
                      "plugins declare, and the flow of this case has none: leave it at \"auto\""),
            std::string::npos);
}

TEST(Stepping, TermsOfAFieldHaveOneDivisor) {
  PassList first;
  first.diffusion("velocity", "acceleration", 1.0, StepCause::viscosity, "rule").divided_by("density", 1.0);
  PassList second;
  second.damping("velocity", "acceleration", 1.0, StepCause::friction, "rule");
  second.damping("velocity", "acceleration", 0.0, StepCause::friction, "rule").divided_by("other", 1.0);
  std::vector<LinearTerms> all;
  add_linear_terms("physics.flow", first, all);
  EXPECT_EQ(error_of([&] { add_linear_terms("physics.drag", second, all); }, ExitCode::bad_case),
            "physics.flow and physics.drag divide the linear terms of 'velocity' by 'density' and by '': remove one of "
            "the plugins");
}

}  // namespace
