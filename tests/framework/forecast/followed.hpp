#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "case_run.hpp"
#include "forecast/advice.hpp"

namespace mesogen::test {

/// The advice of this name that a case is given; nothing if it is not given.
inline std::optional<Suggestion> advised(const CaseText& text, const std::string& name, double free_disk = 0.0) {
  CaseRun run = CaseRun::unstarted(text);
  const auto all = advice({run.setup(), forecast_steps(run.setup()), free_disk});
  const auto found = std::find_if(all.begin(), all.end(), [&](const Suggestion& one) { return one.name == name; });
  if (found == all.end()) return std::nullopt;
  EXPECT_FALSE(found->finding.empty());
  EXPECT_FALSE(found->gain.empty());
  EXPECT_FALSE(found->settings.empty());
  return *found;
}

/// Followed, it is not given again.
inline void expect_settled(const CaseText& text, const Suggestion& followed) {
  CaseRun run(text, followed.settings);
  for (const Suggestion& one : advice({run.setup(), forecast_steps(run.setup()), 0.0}))
    EXPECT_NE(one.name, followed.name);
}

/// Taylor-Green vortices, Re = 100 with 0.01 Pa s, `flow`: keys of the flow.
inline CaseText vortices(const std::string& flow = "", double viscosity = 0.01) {
  CaseText text(1.0, 30);
  text.modes("velocity", "[[1, 1, 0.079577471545947673, 0.0], [1, -1, 0.079577471545947673, 0.0]]")
      .flow(viscosity, flow)
      .read("\"velocity\", \"density\", \"volume\", \"velocity_gradient\"");
  return text;
}

/// Largest minus smallest density, over the mean.
inline double density_variation(CaseRun& run) {
  const auto density = run.field("density");
  const auto [low, high] = std::minmax_element(density.begin(), density.end());
  return *high - *low;
}

}  // namespace mesogen::test
