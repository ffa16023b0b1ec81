#include <fmt/format.h>

#include <array>
#include <cmath>

#include "contract_run.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen::testing {

namespace {

TestScene lattice() {
  TestScene scene;
  scene.arrangement = "lattice";
  return scene;
}

std::string inside_problem(const Boundary& boundary, const Scene& scene) {
  for (int axis = 0; axis < scene.dimension; ++axis) {
    const double length = scene.box[static_cast<std::size_t>(axis)];
    for (const double from :
         {0.0, 0.5 * length, std::nextafter(length, 0.0), length, std::nextafter(length, 2 * length), -1e-18,
          -0.25 * length, 1.25 * length, -3.0 * length, 7.0 * length}) {
      // A step carries no particle far through a wall; the run is over before.
      if (!boundary.periodic(axis) && std::abs(from - 0.5 * length) > length) continue;
      std::array<double, 3> position{0.1 * length, 0.1 * length, 0.0};
      std::array<std::int32_t, 3> images{};
      const auto at = static_cast<std::size_t>(axis);
      position[at] = from;
      boundary.keep_inside(scene, position.data(), images.data());
      const std::string came = fmt::format("keep_inside brings the coordinate {} m to {} m", from, position[at]);
      if (from >= 0.0 && from < length && (position[at] != from || images[at] != 0))
        return came + ": a particle inside the box must stay where it is";
      if (!(position[at] >= 0.0 && position[at] <= length)) return fmt::format("{}, outside of [0, {}]", came, length);
      if (boundary.periodic(axis) && std::abs(position[at] + images[at] * length - from) > 1e-12 * length)
        return fmt::format("{} and counts {} boxes: position + images * box must stay the same", came, images[at]);
      const auto once = position;
      const auto crossed = images;
      boundary.keep_inside(scene, position.data(), images.data());
      if (position != once || images != crossed) return came + ", and somewhere else when it is called again";
    }
  }
  return {};
}

/// No particle sees from its sums that the box ends: a face where something is missing, or there twice, shows.
std::string faces_problem(PluginHarness& harness, const Scene& scene) {
  const auto x = harness.position(0);
  const auto y = harness.position(1);
  const auto where = [&](std::size_t id) { return fmt::format("at ({:.4g}, {:.4g}) m", x[id], y[id]); };
  const auto volume = harness.values("volume");
  const std::size_t middle = volume.size() / 2 + static_cast<std::size_t>(std::sqrt(volume.size())) / 2;
  for (std::size_t id = 0; id < volume.size(); ++id)
    if (!(std::abs(volume[id] / volume[middle] - 1.0) < 1e-5))
      return fmt::format(
          "on a lattice the volume of a particle is {:.7g} m2 {}, and {:.7g} m2 in the middle: neighbours "
          "in walls or beyond the faces are missing or are there twice",
          volume[id], where(id), volume[middle]);
  for (int c = 0; c < scene.dimension; ++c) {
    const auto gradient = harness.values("constant_gradient", c);
    for (std::size_t id = 0; id < gradient.size(); ++id)
      if (!(std::abs(gradient[id]) * scene.spacing < 1e-6))
        return fmt::format(
            "a field that is 1 everywhere has the gradient {:.4g} 1/m {}: ghost_rule or wall_rule gives "
            "something else in walls or beyond the faces",
            gradient[id], where(id));
  }
  return {};
}

}  // namespace

void check_boundary(ContractRun& run) {
  run.check("particles are kept inside, their paths unbroken", [&] {
    PluginHarness harness = run.harness();
    return inside_problem(harness.boundary(), harness.scene());
  });
  run.check("sums over neighbours see no face on a lattice", [&]() -> std::string {
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
      TestScene scene = lattice();
      scene.precision = precision;
      PluginHarness harness = run.harness(scene);
      harness.set("constant", {1.0});
      const std::string problem = faces_problem(harness, harness.scene());
      if (!problem.empty()) return problem;
    }
    return {};
  });
  const auto sums = [&](int threads) {
    return with_threads(threads, [&] {
      PluginHarness harness = run.harness();
      harness.give("velocity");
      Numbers numbers;
      for (int c = 0; c < harness.components("velocity_gradient"); ++c)
        numbers[fmt::format("velocity_gradient {}", c)] = harness.values("velocity_gradient", c);
      return numbers;
    });
  };
  run.check("the same input gives the same bits, again and with 3 threads", [&]() -> std::string {
    const Numbers first = sums(1);
    std::string problem = difference(first, sums(1));
    if (!problem.empty()) return problem + ": something is left over from another run, or not set before it is read";
    problem = difference(first, sums(3));
    return problem.empty() ? "" : problem + " (with 3 threads): let wall particles and rules not depend on threads";
  });
}

}  // namespace mesogen::testing
