/// How the kinetic energy is shared out among wave numbers, in a periodic box.
///
/// With u(x) = sum_k u_k exp(i k x), the spectrum is
///
///     E(k_n) dk = sum over modes of the n-th shell of |u_k|^2 / 2,   |k| within dk / 2 of k_n = n dk,
///
/// so that its integral is half the mean square velocity. dk = 2 pi / L, of the longest edge. Modes are fitted to the
/// velocities of the particles (mesh/observed_modes.hpp).
///
/// What the modes do not hold, of waves beyond the last shell, is recorded as a share of the whole: `energy_beyond`.
///
/// A shell holds more or fewer modes than its area in wave space says, and not all of one length. So a slope s is that
/// of the power law whose sums over the very modes of the shells, sum |k|^(s - d + 1), go with k as E does: log E
/// against log k, by least squares, all shells alike. That is exact for a power law.
#include <cmath>
#include <memory>
#include <numbers>
#include <tuple>

#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "mesogen/mesh/observed_modes.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace mesogen {
namespace {

/// Modes of about one wave number.
struct Shell {
  std::vector<double> wave_numbers;  // one for each mode, 1/m
  double energy = 0.0;               // of all, m2/s2
  double moment = 0.0;               // sum of energy times wave number, m/s2

  [[nodiscard]] double wave_number() const {
    double sum = 0.0;
    for (const double k : wave_numbers) sum += k;
    return sum / static_cast<double>(wave_numbers.size());
  }
  /// What a power law would give.
  [[nodiscard]] double sum_of_powers(double exponent) const {
    double sum = 0.0;
    for (const double k : wave_numbers) sum += std::pow(k, exponent);
    return sum;
  }
};

/// Slope of a line, and its standard error; NaN of fewer than two, or three, points.
struct Slope {
  double value = std::nan("");
  double error = std::nan("");
};

Slope fit_line(const std::vector<std::array<double, 2>>& points) {
  const auto count = static_cast<double>(points.size());
  double x = 0.0;
  double y = 0.0;
  for (const auto& point : points) {
    x += point[0] / count;
    y += point[1] / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const auto& point : points) {
    xx += (point[0] - x) * (point[0] - x);
    xy += (point[0] - x) * (point[1] - y);
    yy += (point[1] - y) * (point[1] - y);
  }
  Slope slope;
  if (points.size() >= 2) slope.value = xy / xx;
  if (points.size() >= 3) slope.error = std::sqrt(std::max(0.0, yy - xy * xy / xx) / xx / (count - 2.0));
  return slope;
}

/// Of E(k), between two wave numbers.
Slope fit_slope(const std::vector<Shell>& shells, double from, double to, int dimension) {
  constexpr int iterations = 8;  // each leaves a tenth of what was wrong, or less
  Slope slope;
  double power = 0.0;
  for (int n = 0; n < iterations; ++n) {
    std::vector<std::array<double, 2>> points;
    for (const Shell& shell : shells)
      if (shell.wave_number() >= from && shell.wave_number() <= to && shell.energy > 0.0)
        points.push_back({std::log(shell.wave_number()),
                          std::log(shell.energy) - std::log(shell.sum_of_powers(power - dimension + 1))});
    slope = fit_line(points);
    power += slope.value;
  }
  slope.value = power;
  return slope;
}

template <int Dim>
class Spectrum {
 public:
  Spectrum(const Scene& scene, double mesh_spacing) : observed_(scene, mesh_spacing) {
    for (int d = 0; d < Dim; ++d) width_ = std::max(width_, observed_.grid().length[static_cast<std::size_t>(d)]);
    width_ = 2.0 * std::numbers::pi / width_;
  }

  struct Seen {
    std::vector<Shell> shells;  // from the first; the mean velocity is in none
    double beyond = 0.0;        // share of the energy that is in none of them
  };

  Seen look(const ObserverContext& context) {
    observed_.locate(context);
    Seen seen{shared_out(observed_.template modes<Dim>(context, "velocity"))};
    double energy = 0.0;
    for (const Shell& shell : seen.shells) energy += shell.energy;
    seen.beyond = observed_.template share_beyond<Dim>(context, "velocity", 2.0 * energy);
    return seen;
  }

 private:
  // One mode after the other: the same sum each time.
  std::vector<Shell> shared_out(const std::array<std::vector<mesh::Complex>, Dim>& modes) {
    const auto& grid = observed_.grid();
    double highest = HUGE_VAL;
    for (int d = 0; d < Dim; ++d) highest = std::min(highest, observed_.spectrum().kept().cutoff(d));
    // Shells that lie within the cutoff along all axes: beyond, corners alone would be left.
    std::vector<Shell> shells(static_cast<std::size_t>(std::max(1.0, std::floor(highest / width_ - 0.5))));
    std::size_t mode = 0;
    for (int row = 0; row < grid.row_count(); ++row) {
      std::array<int, Dim> at{};
      grid.row_coordinates(row, at);
      for (int n = 0; n < grid.modes_in_row(); ++n, ++mode) {
        double square = std::pow(grid.wave_number(0, n), 2);
        for (int d = 1; d < Dim; ++d) square += std::pow(grid.wave_number(d, at[static_cast<std::size_t>(d)]), 2);
        const auto shell = static_cast<std::size_t>(std::sqrt(square) / width_ + 0.5);
        if (shell == 0 || shell > shells.size()) continue;
        // Of a mode and its mirror image only one is stored, but along the plane between the two.
        const int times = n == 0 || 2 * n == grid.points[0] ? 1 : 2;
        Shell& into = shells[shell - 1];
        const double k = std::sqrt(square);
        into.wave_numbers.insert(into.wave_numbers.end(), static_cast<std::size_t>(times), k);
        double energy = 0.0;
        for (std::size_t d = 0; d < Dim; ++d) energy += 0.5 * times * norm(modes[d][mode]);
        into.energy += energy;
        into.moment += energy * k;
      }
    }
    return shells;
  }

  mesh::ObservedModes<Dim> observed_;
  double width_ = 0.0;  // of a shell, 1/m
};

class EnergySpectrum final : public Observer {
 public:
  void parameters(ParameterList& list) override {
    list.number("mesh_spacing", mesh_spacing_)
        .unit("particle spacings")
        .at_least(1.0)
        .at_most(10.0)
        .doc("approximate spacing of the mesh; the spectrum ends at the wave number 2 pi / 3 divided by this spacing");
    list.rows("slopes", ranges_)
        .unit("1/m")
        .sizes({2})
        .above(0.0)
        .doc("ranges of wave numbers, each [from, to], over which the slope of log E against log k is fitted");
  }

  void plan(const Scene& scene, ObserverPlan& plan) override {
    mesh::needs_periodic_box(
        scene, "a spectrum exists only for periodic fields, and this box has walls: remove this observer");
    for (const auto& range : ranges_)
      if (!(range[0] < range[1]))
        throw Error(ExitCode::bad_case, "slopes: a range must go from a wave number to a larger one");
    plan.reads("velocity");
    plan.table("spectrum", 3)
        .unit("1/m, m3/s2, 1")
        .doc("one row per shell of wave numbers: mean wave number of its modes, E(k), number of modes");
    plan.scalar("energy").unit("m2/s2").doc("sum over the spectrum: half the mean square velocity of the waves in it");
    plan.scalar("energy_beyond")
        .unit("1")
        .doc("share of the energy (without that of the mean velocity) in waves beyond the spectrum");
    plan.scalar("mean_wave_number").unit("1/m").doc("mean of k, weighted with the energy");
    if (!ranges_.empty())
      plan.table("slopes", 4)
          .unit("1/m, 1/m, 1, 1")
          .doc("one row per range: from, to, slope, standard error of the slope in the fit");
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    dispatch<AllDimensions>(context.scene().dimension, [&]<int Dim>() { record(context, look<Dim>(context), sample); });
  }

 private:
  template <class Seen>
  void record(const ObserverContext& context, const Seen& seen, Sample& sample) const {
    const std::vector<Shell>& shells = seen.shells;
    double longest = 0.0;
    for (int d = 0; d < context.scene().dimension; ++d)
      longest = std::max(longest, context.scene().box[static_cast<std::size_t>(d)]);
    const double width = 2.0 * std::numbers::pi / longest;
    std::vector<double> rows;
    double energy = 0.0;
    double moment = 0.0;
    for (const Shell& shell : shells) {
      rows.insert(rows.end(),
                  {shell.wave_number(), shell.energy / width, static_cast<double>(shell.wave_numbers.size())});
      energy += shell.energy;
      moment += shell.moment;
    }
    sample.set("spectrum", rows);
    sample.set("energy", energy);
    sample.set("energy_beyond", seen.beyond);
    sample.set("mean_wave_number", moment / energy);
    if (ranges_.empty()) return;
    std::vector<double> slopes;
    for (const auto& range : ranges_) {
      const Slope slope = fit_slope(shells, range[0], range[1], context.scene().dimension);
      slopes.insert(slopes.end(), {range[0], range[1], slope.value, slope.error});
    }
    sample.set("slopes", slopes);
  }

  template <int Dim>
  typename Spectrum<Dim>::Seen look(const ObserverContext& context) {
    auto& spectrum = std::get<std::unique_ptr<Spectrum<Dim>>>(spectrum_);
    if (!spectrum) spectrum = std::make_unique<Spectrum<Dim>>(context.scene(), mesh_spacing_);
    return spectrum->look(context);
  }

  double mesh_spacing_ = 1.5;
  Parameter::Rows ranges_;
  std::tuple<std::unique_ptr<Spectrum<2>>, std::unique_ptr<Spectrum<3>>> spectrum_;  // that of the scene's dimension
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::EnergySpectrum, "energy_spectrum", "1.0.0",
                        "Kinetic energy by wave number, and its slopes")
