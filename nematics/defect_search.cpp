#include "mesogen/nematics/defect_search.hpp"

namespace mesogen::nematics {

void DefectSearch::parameters(ParameterList& list) {
  list.number("merge_distance", merge_distance)
      .unit("spacings")
      .at_least(0.0)
      .at_most(100.0)
      .doc("pairs of opposite charges closer than this are left out, because they are about to vanish or are noise");
  list.number("smoothing_length", smoothing_length)
      .unit("spacings")
      .above(0.25)
      .at_most(10.0)
      .doc(
          "smoothing length of the kernel that averages the order tensor of the particles; it has the shape of the "
          "run's kernel");
}

std::vector<Defect> DefectSearch::find(const ObserverContext& context) const {
  const Scene& scene = context.scene();
  return without_close_pairs(DirectorGrid(context, smoothing_length).defects(), scene, merge_distance * scene.spacing);
}

}  // namespace mesogen::nematics
