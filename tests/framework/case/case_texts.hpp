#pragma once

#include <string>
#include <vector>

#include "case/case.hpp"

namespace mesogen::testing {

/// A complete case, as short as it is sensible.
inline const std::string good_case = R"(title = "A case"
[domain]
size = [10.0, 10]
boundary = "periodic_ghosts"
[particles]
spacing = 0.625
arrangement = "lattice"
seed = 3
[kernel]
type = "quintic"
smoothing_length = 1.3333333
[director]
type = "modes"
modes = [[1, 0, 0.05, 0.3], [0, 1, 0.03, 1.1]]
order = 1.0
[physics.flow]
type = "flow"
density = 1.0
viscosity = 0.6667
[physics.activity]
type = "activity"
activity = 0.05
[physics.nematic]
type = "nematic"
elastic_constant = 0.02
bulk = { A = -1.0, C = 0.5 }
[time]
end = 60.0
[observers.flow]
type = "statistics"
interval = 1.0
[observers.area]
type = "statistics"
every = 20
[output]
interval = 10.0
checkpoint_interval = 30
fields = ["position", "velocity", "order_tensor"]
[run]
precision = "double"
device = "cpu"
)";

/// Parameters such as plugins have.
struct FakeParameters {
  double density = 1.0;
  double viscosity = 0.0;
  std::optional<double> sound_speed;
  std::string form = "component_wise";
  bool shift = true;
  double activity = 0.0;
  double elastic_constant = 0.0;
  double bulk_a = -1.0;
  double bulk_b = 0.0;
  double bulk_c = 0.5;
  std::int64_t filter_every = 30;
  std::vector<double> angles;
  std::vector<std::string> names = {"a"};
  std::string director = "uniform";
  double order = 1.0;
  Parameter::Rows modes;

  ParameterList list(const std::string& type) {
    ParameterList keys;
    if (type == "flow") {
      keys.number("density", density).unit("kg/m^3").doc("at rest").above(0.0);
      keys.number("viscosity", viscosity).unit("Pa s").doc("dynamic viscosity").above(0.0).required();
      keys.number_or("sound_speed", sound_speed, "auto").unit("m/s").above(0.0);
      keys.text("viscosity_form", form).choices({"component_wise", "monaghan_gingold"});
      keys.flag("shift", shift);
      keys.integer("filter_every", filter_every).unit("steps").at_least(0.0);
    } else if (type == "activity") {
      keys.number("activity", activity).unit("Pa").doc("> 0 extensile").required();
    } else if (type == "nematic") {
      keys.number("elastic_constant", elastic_constant).unit("N").doc("one elastic constant").at_least(0.0).required();
      keys.number("bulk.A", bulk_a).unit("Pa");
      keys.number("bulk.B", bulk_b).unit("Pa");
      keys.number("bulk.C", bulk_c).unit("Pa").above(0.0).required();
    } else if (type == "director") {
      keys.text("type", director).choices({"uniform", "perturbed", "modes", "defects"}).required();
      keys.number("order", order).at_least(0.0);
      keys.rows("modes", modes).sizes({4}).required().only_with("type", {"modes"});
    } else if (type == "statistics") {
      keys.numbers("angles", angles).unit("rad").at_least(0.0).below(7.0);
      keys.texts("names", names).choices({"a", "b"});
    }
    return keys;
  }
};

/// Reads a case and the parameters of its plugins as the builder of a simulation does.
inline Case read_all(const std::string& text, const std::vector<std::string>& overrides, Problems& problems) {
  Case result = read_case_text(text, "case.toml", overrides, problems);
  FakeParameters parameters;
  for (const auto* const group : {&result.initial, &result.physics, &result.observers})
    for (const auto& choice : *group)
      if (!choice.type.empty() && choice.type != "directr") choice.read(parameters.list(choice.type), problems);
  return result;
}

/// The good case with one part replaced, which must be in it.
inline std::string changed(const std::string& from, const std::string& to) {
  std::string text = good_case;
  text.replace(text.find(from), from.size(), to);
  return text;
}

}  // namespace mesogen::testing
