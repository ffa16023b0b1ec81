#include "run/results_options.hpp"

#include "mesogen/plugin/descriptor.hpp"

namespace mesogen {

ResultsOptions results_options(const Setup& setup, const std::filesystem::path& folder) {
  ResultsOptions o;
  o.folder = folder;
  o.box = setup.scene.box;
  o.length_unit = setup.source.units.length;
  o.time_unit = setup.source.units.time;
  o.dimension = setup.scene.dimension;
  o.periodic.assign(setup.scene.periodic.begin(), setup.scene.periodic.begin() + o.dimension);
  o.case_text = setup.resolved_text;
  o.version = MESOGEN_VERSION;
  o.build = MESOGEN_BUILD_TAG;
  o.seed = setup.source.particles.seed;
  o.count = setup.scene.particle_count;
  return o;
}

}  // namespace mesogen
