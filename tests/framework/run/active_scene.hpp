#pragma once

#include <array>
#include <vector>

#include "case_run.hpp"

namespace mesogen::test {

/// A lively little case: particles cross faces and are sorted anew. No force on the fluid is from outside.
inline CaseText freely_active_scene(const std::string& precision, const std::string& boundary = "periodic_ghosts",
                                    const std::string& stepping = "explicit") {
  CaseText text(4.0, 20);
  text.section("time", "end = 1e6\nstepping = \"" + stepping + "\"")
      .boundary(boundary)
      .precision(precision)
      .modes("director", "[[1, 0, 0.4, 0.3], [0, 1, 0.3, 1.1], [2, -1, 0.1, 0.7]]")
      .section("velocity", "type = \"uniform\"\nvalue = [1.0, -0.6]")
      .flow(0.05)
      .nematic(0.4, 0.7, 0.02)
      .active(0.5)
      .section("physics.elasticity", "type = \"elastic_stress\"");
  return text;
}

/// The same with friction: every part of a step does something.
inline CaseText active_scene(const std::string& precision, const std::string& boundary = "periodic_ghosts",
                             const std::string& stepping = "explicit") {
  CaseText text = freely_active_scene(precision, boundary, stepping);
  text.section("physics.substrate", "type = \"friction\"\ncoefficient = 0.1");
  return text;
}

/// All that the run integrates, by id.
inline std::vector<std::vector<double>> state_of(CaseRun& run) {
  std::vector<std::vector<double>> all;
  for (const int c : {0, 1}) {
    all.push_back(run.path(c));
    all.push_back(run.field("velocity", c));
    all.push_back(run.field("order_tensor", c));
  }
  all.push_back(run.field("compression"));
  return all;
}

}  // namespace mesogen::test
