// The director of a nematic when a run starts: Q = q (2 n n - I), n at the angle theta to the x axis. The angle is the
// sum of the parameter `angle` and what the type adds: random deviations, waves, or defects.

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "defect_field.hpp"
#include "mesogen/exec/random.hpp"
#include "mesogen/plugin/initial.hpp"
#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/waves.hpp"

namespace {

using namespace mesogen;
using director::DefectField;
using director::DirectorValue;

// Of the random numbers; streams 0 to 2 shift particles.
constexpr std::int64_t stream = 3;

class Director final : public Initial {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.text("type", type_)
        .doc("how the director is oriented at the start")
        .choices({"uniform", "perturbed", "modes", "defects"})
        .required();
    list.number("order", order_).doc("magnitude q of the order tensor").at_least(0.0);
    list.number("angle", angle_)
        .unit("degree")
        .at_least(-360)
        .at_most(360)
        .doc("angle of the director to the x axis; added to the angle that the type gives");
    list.number("amplitude", amplitude_)
        .unit("rad")
        .doc("largest random deviation of the angle")
        .at_least(0.0)
        .required()
        .only_with("type", {"perturbed"});
    list.integer("seed", seed_).doc("seed of the random deviations").only_with("type", {"perturbed"});
    list.rows("modes", modes_)
        .doc(
            "rows mx, my, amplitude (rad), phase (rad): cosine waves of the angle, with mx and my waves in the box "
            "along x and y")
        .sizes({4})
        .required()
        .only_with("type", {"modes"});
    list.rows("defects", defects_)
        .doc("rows x (m), y (m), charge (0.5 or -0.5); a position beyond a periodic face is moved into the box")
        .sizes({3})
        .required()
        .only_with("type", {"defects"});
    list.number_or("core", core_, "auto")
        .unit("m")
        .doc("core radius of the defects; auto: the particle spacing")
        .above(0.0)
        .only_with("type", {"defects"});
  }

  void plan(InitialPlan& plan) const override {
    plan.sets("order_tensor", Rank::order_tensor)
        .doc("Q = q (2 n n - I), stored as (Q11, Q12) = q (cos 2 theta, sin 2 theta)")
        .shown();
  }

  void publish(Scene& scene) override {
    value_ = value_function(scene);
    // Of what is uniform but for small disturbances, instabilities can be told beforehand.
    if (type_ != "defects") scene.constants["initial_director_angle"] = radians();
  }

  void set(InitialState& state) const override {
    const auto x = state.position(0);
    const auto y = state.position(1);
    const auto q11 = state.component("order_tensor", 0);
    const auto q12 = state.component("order_tensor", 1);
#pragma omp parallel for schedule(static)
    for (Index id = 0; id < state.count(); ++id) {
      const auto i = static_cast<std::size_t>(id);
      const DirectorValue value = value_(id, x[i], y[i]);
      q11[i] = value.order * std::cos(2.0 * value.angle);
      q12[i] = value.order * std::sin(2.0 * value.angle);
    }
  }

 private:
  /// Order and angle (rad) at a particle.
  using Value = std::function<DirectorValue(Index id, double x, double y)>;

  [[nodiscard]] double radians() const { return angle_ * std::numbers::pi / 180.0; }

  [[nodiscard]] Value value_function(const Scene& scene) const {
    const double order = order_;
    const double angle = radians();
    if (type_ == "perturbed")
      return [order, angle, amplitude = amplitude_, seed = seed_](Index id, double, double) {
        return DirectorValue{order, angle + amplitude * (2.0 * exec::random_uniform(seed, id, stream) - 1.0)};
      };
    if (type_ == "modes")
      return [order, angle, waves = box_waves("modes", modes_, scene)](Index, double x, double y) {
        double sum = angle;
        for (const BoxWave& wave : waves) sum += wave.amplitude * std::cos(wave.argument(x, y));
        return DirectorValue{order, sum};
      };
    if (type_ == "defects")
      return [order, angle, defects = DefectField(defects_, core_.value_or(scene.spacing), scene, unit("m"))](
                 Index, double x, double y) {
        const DirectorValue value = defects.at(x, y);
        return DirectorValue{order * value.order, angle + value.angle};
      };
    return [order, angle](Index, double, double) { return DirectorValue{order, angle}; };
  }

  std::string type_ = "uniform";
  double order_ = 1.0;
  double angle_ = 0.0;
  double amplitude_ = 0.0;
  std::int64_t seed_ = 1;
  Parameter::Rows modes_;
  Parameter::Rows defects_;
  std::optional<double> core_;
  Value value_;
};

}  // namespace

MESOGEN_INITIAL_PLUGIN(Director, "director", "1.0.0", "Director of a nematic: uniform, noise, waves or defects")
