/// How well a colour has spread. At the start, particles of the quarter x < Lx/2, y < Ly/2 have colour 1, the others 0.
///
/// The box is divided into C cells. With n_c particles and the mean colour p_c in cell c, and the mean colour p of all
/// N particles, the mixing index is that of Lacey (J. Appl. Chem. 4, 257, 1954),
///
///     M = (s0 - s) / (s0 - sr),    s = sum_c n_c (p_c - p)^2 / N,    s0 = p (1 - p),    sr = s0 (C - 1) / (N - 1)
///
/// kept within [0, 1]. s0 is the variance between cells of one colour each, as at the start (cell edges fall on the
/// edges of the quarter), and sr is its expectation when colours are dealt to the particles at random: a cell of few
/// particles does not hold the mean colour exactly even in a perfect mixture. So M is 0 at the start, 1 on average in a
/// random mixture, and 1 where every cell holds the mean colour. Only cells that hold particles count. NaN if there is
/// one colour only, or no cell with more than one particle.
///
/// In two dimensions, there is also the length of the line between the colours (contour.hpp), and how much longer it is
/// than at the start: stirring stretches the line well before the cells of the index take notice. Both say something
/// while the strips of colour are wider than about two nodes of the mesh. Thinner ones merge, and the line with them:
/// its length stops growing, and at last falls.
///
/// In a scene with a field `colour` (values from 0 to 1) that is used, as it is at the time of the sample.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "contour.hpp"
#include "mesogen/diagnostics/error.hpp"
#include "mesogen/exec/blocks.hpp"
#include "mesogen/exec/compensated_sum.hpp"
#include "mesogen/plugin/observer.hpp"
#include "mesogen/plugin/plugin.hpp"

namespace mesogen {
namespace {

class Mixing final : public Observer {
 public:
  void parameters(ParameterList& list) override {
    list.number_or("cells", cells_, "auto")
        .at_least(2.0)
        .at_most(10000.0)
        .doc(
            "number of cells along the shortest edge of the box, even; auto: as many as possible that are at least 5 "
            "spacings wide");
    list.number("mesh_spacing", mesh_spacing_)
        .unit("particle spacings")
        .at_least(1.0)
        .at_most(10.0)
        .doc("distance of the nodes at which the colour is averaged, to find the line where it is 1/2");
  }

  void plan(const Scene& scene, ObserverPlan& plan) override {
    if (cells_ && std::fmod(*cells_, 2.0) != 0.0)
      throw Error(ExitCode::bad_case,
                  "mixing: `cells` must be an even number, so that the edges of the initial quarter "
                  "are edges of cells, but is " +
                      std::to_string(*cells_));
    plan.traces_particles();
    plan.reads_if_present("colour");
    plan.scalar("mixing_index").doc("0: colours apart, as at the start; 1: mixed (Lacey's index)");
    if (scene.dimension == 2) {
      plan.scalar("interface_length").unit("m").doc("length of the line where the averaged colour is 1/2");
      plan.scalar("stretching").doc("interface_length divided by its value at the start");
    }
    double shortest = scene.box[0];
    for (int d = 1; d < scene.dimension; ++d) shortest = std::min(shortest, scene.box[static_cast<std::size_t>(d)]);
    for (int d = 0; d < scene.dimension; ++d) {
      const double length = scene.box[static_cast<std::size_t>(d)];
      const double pairs =
          cells_ ? std::round(0.5 * *cells_ * length / shortest) : std::floor(length / (10.0 * scene.spacing));
      cells_along_[static_cast<std::size_t>(d)] = 2 * std::max(1, static_cast<int>(pairs));
    }
  }

  void start(const ObserverContext& context) override {
    const Scene& scene = context.scene();
    const auto position = positions(context);
    if (!context.has("colour")) {
      const auto id = context.id();
      colour_.resize(id.size());  // a third coordinate does not matter
      for (std::size_t i = 0; i < id.size(); ++i)
        colour_[static_cast<std::size_t>(id[i])] =
            position[0][i] < 0.5 * scene.box[0] && position[1][i] < 0.5 * scene.box[1] ? 1.0 : 0.0;
    }
    if (scene.dimension == 2) initial_length_ = line(scene).length(position, colour_now(context));
  }

  void sample(const ObserverContext& context, Sample& sample) override {
    const Scene& scene = context.scene();
    const auto position = positions(context);
    const auto colour = colour_now(context);
    sample.set("mixing_index", index(colour, cells_of(scene, position)));
    if (scene.dimension != 2) return;
    const double length = line(scene).length(position, colour);
    sample.set("interface_length", length);
    sample.set("stretching", length / initial_length_);
  }

  [[nodiscard]] std::map<std::string, std::vector<double>> save() const override {
    return {{"colour", colour_}, {"initial_length", {initial_length_}}};
  }

  void restore(const std::map<std::string, std::vector<double>>& saved) override {
    colour_ = saved.at("colour");
    initial_length_ = saved.at("initial_length").at(0);
  }

 private:
  using Values = std::vector<double>;  // in the order of storage

  /// Coordinates in the box, m, by axis.
  static std::vector<Values> positions(const ObserverContext& context) {
    std::vector<Values> position;
    for (int d = 0; d < context.scene().dimension; ++d) position.push_back(context.position(d));
    return position;
  }

  [[nodiscard]] Values colour_now(const ObserverContext& context) const {
    if (context.has("colour")) return context.values("colour");
    const auto id = context.id();
    Values colour(id.size());
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < id.size(); ++i) colour[i] = colour_[static_cast<std::size_t>(id[i])];
    return colour;
  }

  ColourLine& line(const Scene& scene) {
    if (!line_) line_.emplace(scene, mesh_spacing_);
    return *line_;
  }

  /// Number of the cell that holds each particle.
  [[nodiscard]] std::vector<int> cells_of(const Scene& scene, const std::vector<Values>& position) const {
    const auto count = static_cast<Index>(position[0].size());
    std::vector<int> cell(position[0].size());
#pragma omp parallel for schedule(static) if (count >= exec::parallel_from)
    for (Index i = 0; i < count; ++i) {
      int number = 0;
      for (std::size_t d = position.size(); d-- > 0;) {
        const int at = static_cast<int>(position[d][static_cast<std::size_t>(i)] / scene.box[d] * cells_along_[d]);
        number = number * cells_along_[d] + std::clamp(at, 0, cells_along_[d] - 1);
      }
      cell[static_cast<std::size_t>(i)] = number;
    }
    return cell;
  }

  [[nodiscard]] double index(const Values& colour, const std::vector<int>& cell) const {
    const auto total = static_cast<double>(colour.size());
    std::size_t cells = 1;
    for (const int along : cells_along_) cells *= static_cast<std::size_t>(along);
    std::vector<double> held(cells, 0.0);
    std::vector<double> count(cells, 0.0);
    for (std::size_t i = 0; i < colour.size(); ++i) {
      held[static_cast<std::size_t>(cell[i])] += colour[i];
      count[static_cast<std::size_t>(cell[i])] += 1.0;
    }
    exec::CompensatedSum sum;
    for (const double of_cell : held) sum.add(of_cell);
    const double mean = sum.value() / total;
    double used = 0.0;
    exec::CompensatedSum squares;
    for (std::size_t c = 0; c < held.size(); ++c) {
      if (count[c] == 0.0) continue;
      used += 1.0;
      squares.add(count[c] * std::pow(held[c] / count[c] - mean, 2));
    }
    const double apart = mean * (1.0 - mean);
    const double random = apart * (used - 1.0) / (total - 1.0);
    if (!(apart > random)) return std::numeric_limits<double>::quiet_NaN();
    return std::clamp((apart - squares.value() / total) / (apart - random), 0.0, 1.0);
  }

  std::optional<double> cells_;
  double mesh_spacing_ = 1.5;
  std::array<int, 3> cells_along_{1, 1, 1};
  std::vector<double> colour_;   // by id; empty where the scene has such a field
  double initial_length_ = 0.0;  // m
  std::optional<ColourLine> line_;
};

}  // namespace
}  // namespace mesogen

MESOGEN_OBSERVER_PLUGIN(mesogen::Mixing, "mixing", "1.1.0",
                        "How well the colour of the initial quarter has spread, and how long the line around it is")
