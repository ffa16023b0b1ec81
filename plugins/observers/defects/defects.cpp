/// Where the director is singular: defects of charge +1/2 and -1/2, from the winding of the director on a grid.
/// The method is in mesogen/nematics/director_grid.hpp.
#include "mesogen/nematics/defect_search.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace mesogen {
namespace {

class Defects final : public Observer {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override { search_.parameters(list); }

  void plan(const Scene& /*scene*/, ObserverPlan& plan) override {
    plan.reads("order_tensor");
    plan.scalar("count_plus").doc("number of defects of charge +1/2");
    plan.scalar("count_minus").doc("number of defects of charge -1/2");
    plan.scalar("total_charge").doc("sum of the charges; always 0 in a periodic box");
    plan.scalar("pair_distance")
        .unit("m")
        .doc("smallest distance between defects of opposite charges; NaN if there is no such pair");
    auto& table = plan.table("defects", 4);
    table.unit("m, m, 1, rad")
        .doc(
            "one row per defect: x, y, charge, orientation (the direction, seen from the defect, in which the director "
            "is radial: for +1/2 from head to tail; for -1/2 along one of three legs)");
    table.varying = true;
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    const Scene& scene = context.scene();
    double plus = 0.0;
    double minus = 0.0;
    std::vector<double> rows;
    const auto defects = search_.find(context);
    for (const auto& defect : defects) {
      (defect.charge > 0.0 ? plus : minus) += 1.0;
      rows.insert(rows.end(), {defect.position[0], defect.position[1], defect.charge, defect.orientation});
    }
    sample.set("count_plus", plus);
    sample.set("count_minus", minus);
    sample.set("total_charge", 0.5 * (plus - minus));
    sample.set("pair_distance", nematics::pair_distance(defects, scene));
    sample.set("defects", std::move(rows));
  }

 private:
  nematics::DefectSearch search_;
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::Defects, "defects", "1.0.0", "Defects of the director: position, charge, orientation")
