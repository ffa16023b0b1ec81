/// How far a flow is alike: autocorrelation of velocity and vorticity in a periodic box, and the lengths at which it
/// comes down to a level and to 0 (for active nematics: Thampi, Golestanian and Yeomans, Phys. Rev. Lett. 111, 118101
/// (2013)).
///
/// With modes u_k that are fitted to the velocities of the particles (mesh/observed_modes.hpp), those of the
/// vorticity are i k x u_k. Means over the box are left out, so a flow and the same flow carried along are one.
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "autocorrelation.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "mesogen/mesh/observed_modes.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace mesogen {
namespace {

using correlation::Autocorrelation;
using correlation::first_crossing;

/// |f_k|^2 of every stored mode, of a flow.
struct Powers {
  std::vector<double> velocity;
  std::vector<double> vorticity;
};

/// Of a scalar: "velocity_zero_axes".
std::string crossing(const std::string& field, const char* of, const std::string& along) {
  return field + "_" + of + "_" + along;
}

/// |k x u|^2: of the one component in a plane, or of three.
template <int Dim>
double curl_square(const std::array<double, Dim>& k, const std::array<mesh::Complex, Dim>& u) {
  double square = 0.0;
  for (std::size_t a = 0; a < Dim; ++a)
    for (std::size_t b = a + 1; b < Dim; ++b) square += norm(k[a] * u[b] - k[b] * u[a]);
  return square;
}

template <int Dim>
class Flow {
 public:
  Flow(const Scene& scene, double mesh_spacing) : observed_(scene, mesh_spacing) {}

  Powers powers(const ObserverContext& context) {
    observed_.locate(context);
    const auto modes = observed_.template modes<Dim>(context, "velocity");
    Powers powers{std::vector<double>(modes[0].size()), std::vector<double>(modes[0].size())};
    observed_.spectrum().kept().for_each([&](std::size_t n, const auto& k) {
      std::array<mesh::Complex, Dim> u{};
      for (std::size_t d = 0; d < Dim; ++d) u[d] = modes[d][n];
      for (const mesh::Complex& component : u) powers.velocity[n] += norm(component);
      powers.vorticity[n] = curl_square<Dim>(k, u);
    });
    leave_out_rounding(powers);
    return powers;
  }

  /// Share of the velocity's mean square about its mean beyond modes which hold so much of it.
  [[nodiscard]] double beyond(const ObserverContext& context, double mean_square) const {
    return observed_.template share_beyond<Dim>(context, "velocity", mean_square);
  }

  [[nodiscard]] const mesh::Grid<Dim>& grid() const { return observed_.grid(); }

 private:
  // Of a fluid that moves as a whole nothing is left but the rounding of its mean.
  static void leave_out_rounding(Powers& powers) {
    constexpr double rounding = 1e-13;
    double fluctuating = 0.0;
    for (std::size_t n = 1; n < powers.velocity.size(); ++n) fluctuating += powers.velocity[n];
    if (fluctuating > rounding * rounding * powers.velocity[0]) return;
    for (auto* const power : {&powers.velocity, &powers.vorticity}) std::fill(power->begin(), power->end(), 0.0);
  }

  mesh::ObservedModes<Dim> observed_;
};

class Correlation final : public Observer {
 public:
  void parameters(ParameterList& list) override {
    list.number("mesh_spacing", mesh_spacing_)
        .unit("particle spacings")
        .at_least(1.0)
        .at_most(10.0)
        .doc("approximate spacing of the mesh; waves shorter than 3 mesh spacings are left out");
    list.number_or("separation_step", separation_step_, "auto")
        .unit("m")
        .above(0.0)
        .doc("step from one separation r of the tables to the next; auto: the particle spacing");
    list.number("level", level_)
        .above(0.0)
        .below(1.0)
        .doc("level of the autocorrelation whose first crossing is recorded, in addition to that of 0");
  }

  void plan(const Scene& scene, ObserverPlan& plan) override {
    mesh::needs_periodic_box(
        scene, "correlations exist only for periodic fields, and this box has walls: remove this observer");
    plan_table(scene);
    plan.reads("velocity");
    plan.scalar("velocity_beyond")
        .unit("1")
        .doc(
            "share of the variance of the velocity in waves too short for the mesh; the correlations are those of the "
            "rest");
    for (const std::string field : {"velocity", "vorticity"}) {
      plan.table(field, 3).unit("m, 1, 1").doc(
          "separation r, up to half the shortest edge; autocorrelation of the " + field +
          " without its mean, averaged over separations along the axes; the same averaged over all directions");
      for (const std::string along : {"axes", "radial"}) {
        const std::string which = along == "axes" ? " along the axes" : " over all directions";
        plan.scalar(crossing(field, "zero", along))
            .unit("m")
            .doc("separation at which its autocorrelation" + which + " first falls to 0; NaN if it does not");
        plan.scalar(crossing(field, "level", along))
            .unit("m")
            .doc("separation at which its autocorrelation" + which + " first falls to `level`; NaN if it does not");
      }
    }
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    dispatch<AllDimensions>(context.scene().dimension, [&]<int Dim>() { look<Dim>(context, sample); });
  }

 private:
  void plan_table(const Scene& scene) {
    step_ = separation_step_.value_or(scene.spacing);
    double shortest = scene.box[0];
    for (int d = 1; d < scene.dimension; ++d) shortest = std::min(shortest, scene.box[static_cast<std::size_t>(d)]);
    // A last separation that falls short by rounding is one of them.
    const double last = std::floor(0.5 * shortest / step_ + 1e-9);
    if (last < 1.0)
      throw Error(ExitCode::bad_case,
                  "separation_step: must be at most half the shortest edge of the box, where the correlations end");
    rows_ = static_cast<std::size_t>(last) + 1;
  }

  template <int Dim>
  void look(const ObserverContext& context, Sample& sample) {
    auto& flow = std::get<std::unique_ptr<Flow<Dim>>>(flow_);
    if (!flow) flow = std::make_unique<Flow<Dim>>(context.scene(), mesh_spacing_);
    const Powers powers = flow->powers(context);
    const Autocorrelation<Dim> of_velocity(flow->grid(), powers.velocity);
    record(sample, "velocity", of_velocity);
    sample.set("velocity_beyond", flow->beyond(context, of_velocity.mean_square()));
    record(sample, "vorticity", Autocorrelation<Dim>(flow->grid(), powers.vorticity));
  }

  template <int Dim>
  void record(Sample& sample, const std::string& field, const Autocorrelation<Dim>& autocorrelation) const {
    std::vector<double> rows;
    const auto tabulate = [&](const std::string& along, const std::function<double(double)>& c) {
      std::vector<double> table(rows_);
      for (std::size_t n = 0; n < rows_; ++n) table[n] = c(static_cast<double>(n) * step_);
      sample.set(crossing(field, "zero", along), first_crossing(c, table, step_, 0.0));
      sample.set(crossing(field, "level", along), first_crossing(c, table, step_, level_));
      return table;
    };
    const auto axes = tabulate("axes", [&](double r) { return autocorrelation.along_axes(r); });
    const auto radial = tabulate("radial", [&](double r) { return autocorrelation.radial(r); });
    for (std::size_t n = 0; n < rows_; ++n)
      rows.insert(rows.end(), {static_cast<double>(n) * step_, axes[n], radial[n]});
    sample.set(field, rows);
  }

  double mesh_spacing_ = 1.5;
  std::optional<double> separation_step_;
  double level_ = 0.2;
  double step_ = 0.0;  // of separations, m
  std::size_t rows_ = 0;
  std::tuple<std::unique_ptr<Flow<2>>, std::unique_ptr<Flow<3>>> flow_;  // that of the scene's dimension
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::Correlation, "correlation", "1.0.0",
                        "Autocorrelation of velocity and vorticity, and its lengths")
