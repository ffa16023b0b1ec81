#pragma once

#include <string>
#include <vector>

#include "case_run.hpp"

namespace mesogen::test {

inline constexpr double length = 10.0;

/// An active nematic that is bent, on jittered particles so that nothing is even, with friction and a uniform force.
inline CaseText active(const std::string& activity, const std::string& more_flow = "") {
  CaseText text(length, 40);
  text.section("particles", "spacing = 0.25\narrangement = \"jittered\"\njitter = 0.1\nseed = 3")
      .modes("director", "[[1, 0, 0.3, 0.4], [1, 2, 0.2, 1.1]]")
      .flow(1.0, more_flow)
      .nematic(0.4, 0.7, 0.1)
      .section("physics.activity", "type = \"active_stress\"\nactivity = " + activity)
      .section("physics.substrate", "type = \"friction\"\ncoefficient = 0.5")
      .section("physics.push", "type = \"body_force\"\nforce = [0.1, -0.2]")
      .read("\"acceleration\", \"velocity\", \"order_tensor\"");
  return text;
}

using Settings = std::vector<std::string>;

}  // namespace mesogen::test
