#include "forecast/memory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "domain/neighbourhood.hpp"
#include "simulation/planned_fields.hpp"

namespace mesogen {

namespace {

constexpr double exact = sizeof(double);
constexpr double single = sizeof(float);

// What a run touches beyond what a check has: the code that computes and writes, HDF5's own tables.
constexpr double running_code = 8.5e6;

// The allocator keeps some of what is freed: of what comes and goes, more is resident than is in use.
constexpr double kept = 1.25;

class Counted {
 public:
  explicit Counted(const Setup& setup)
      : setup_(setup),
        scene_(setup.scene),
        number_(scene_.precision == Precision::single_precision ? single : exact),
        particles_(scene_.particle_count),
        axes_(scene_.dimension),
        reach_(scene_.support + Neighbourhood::skin_in_spacings * scene_.spacing),
        grid_(scene_, *setup.boundary, reach_),
        block_width_(number_ == single ? NeighbourBlock::width<float> : NeighbourBlock::width<double>),
        blocks_(particles_ *
                NeighbourBlocks::expected(reach_ / scene_.spacing, grid_.width(1) / scene_.spacing, block_width_)),
        neighbours_(std::numbers::pi * std::pow(scene_.support / scene_.spacing, 2)) {
    Copies copies;
    const auto& position = setup.arrangement.position;
    const double* axes[3] = {position[0].data(), position[1].data(), position[2].data()};
    setup.boundary->copies(scene_, axes, scene_.particle_count, reach_, copies);
    copies_ = static_cast<double>(copies.source.size());
    Dummies dummies;
    setup.boundary->dummies(scene_, reach_, dummies);
    dummies_ = static_cast<double>(dummies.position.size());
  }

  [[nodiscard]] double positions() const {
    const double start = axes_ * exact;              // where the case puts them
    const double now = axes_ * (exact + 4.0) + 8.0;  // position, image, id
    // Position at the last sorting, cell, order, blocks; room in which particles change places.
    const double sorted = axes_ * exact + 4.0 + 4.0 + 8.0 + (exact + 4.0 + 8.0);
    return particles_ * (start + now + sorted + axes_ * number_);  // and relative to a tile
  }

  [[nodiscard]] double neighbour_search() const {
    const double beyond = axes_ * (exact + number_);             // tile, and position relative to it
    const double wall = 48.0 + neighbours_ / 2.0 * 16.0 + 64.0;  // dummy and mirror; weights; a vector's room
    return 8.0 * grid_.padded_count() + blocks() + copies_ * (32.0 + axes_ * exact + beyond) +
           dummies_ * (wall + beyond);
  }

  [[nodiscard]] double blocks() const { return blocks_ * sizeof(NeighbourBlock); }

  [[nodiscard]] double fields() const {
    double numbers = 0.0;  // a particle
    bool masters = false;
    const auto keep = [&](int components, bool integrated) {
      numbers += components * (number_ == exact ? exact : single + (integrated ? exact : 0.0));
      masters = masters || integrated;
    };
    for (const PlannedField& field : planned_fields(setup_)) keep(field.components, field.integrated);
    // What is predicted is kept as it was at the start of a step too; see Integrator.
    if (setup_.source.time.scheme == "midpoint")
      for (const auto& [name, entry] : setup_.catalogue.all())
        if (entry.declaration.advance == Advance::predicted) numbers += setup_.catalogue.components(name) * exact;
    for (const auto& [name, entry] : setup_.catalogue.all())
      if (entry.declaration.advance == Advance::by_passes) numbers += setup_.catalogue.components(name) * exact;
    for (const std::string& name : derived()) keep(setup_.catalogue.components(name), false);
    const double scratch = (number_ == exact || masters ? exact : 0.0) + (number_ == single ? single : 0.0);
    // Room is taken for a sixteenth more than there is.
    return (particles_ + copies_ + dummies_) * numbers * 17.0 / 16.0 + particles_ * scratch;
  }

  /// Of derivatives where nothing moves; see sph/fixed_weights.hpp.
  [[nodiscard]] double weights() const {
    const Transport& flow = setup_.graph->transport();
    if (!flow.velocity.empty() && !flow.fixed) return 0.0;
    bool gradient = false;
    bool laplacian = false;
    for (const std::string& name : setup_.graph->derived_for_integration()) {
      gradient = gradient || name.ends_with("_gradient");
      laplacian = laplacian || name.ends_with("_laplacian");
    }
    const double kinds = (gradient ? axes_ : 0.0) + (laplacian ? 1.0 : 0.0);
    if (kinds == 0.0) return 0.0;
    return blocks_ * block_width_ * kinds * number_;
  }

  [[nodiscard]] double checkpoint() const {
    double numbers = 2.0 * axes_;  // position, and that at the last sorting
    for (const std::string& name : checkpointed_fields(setup_)) numbers += setup_.catalogue.components(name);
    const double integers = 1.0 + axes_;  // id, images
    double kept_by_plugins = 0.0;
    for (const auto& member : setup_.physics)
      for (const auto& kept_numbers : member.passes.kept()) kept_by_plugins += static_cast<double>(kept_numbers.count);
    return 8.0 * (particles_ * (numbers + integers) + kept_by_plugins);
  }

  [[nodiscard]] double frame(bool in_memory) const {
    double bytes = axes_ * (exact + (in_memory ? exact : 4.0));  // position, image
    for (const std::string& name : setup_.output_fields) {
      bytes += setup_.catalogue.components(name) * (in_memory ? exact : number_);
      // Made of it for ParaView: a component of the tensor, and of the nematic's the director in single precision.
      if (in_memory || setup_.catalogue.rank(name) != Rank::order_tensor) continue;
      bytes += number_;
      if (setup_.catalogue.unit(name) == "1") bytes += 2.0 * 4.0;
    }
    return particles_ * bytes;
  }

  /// The most that an observer reads at a time: its fields, positions and the order of ids, in double.
  [[nodiscard]] double sample() const {
    double most = 0.0;
    for (const auto& observer : setup_.observers) {
      double numbers = axes_ + 1.0;
      for (const std::string& name : observer.fields) numbers += setup_.catalogue.components(name);
      most = std::max(most, particles_ * exact * numbers);
    }
    return most;
  }

 private:
  [[nodiscard]] std::set<std::string> derived() const {
    std::set<std::string> all = setup_.graph->derived_for_integration();
    for (std::size_t n = 0; n <= setup_.observers.size(); ++n) {
      const auto& more = setup_.graph->derived_for_reader(n);
      all.insert(more.begin(), more.end());
    }
    if (!all.empty()) all.insert("volume");
    return all;
  }

  const Setup& setup_;
  const Scene& scene_;
  double number_;  // bytes
  double particles_;
  double axes_;
  double reach_;
  CellGrid grid_;
  int block_width_;
  double blocks_;
  double neighbours_;
  double copies_ = 0.0;
  double dummies_ = 0.0;
};

}  // namespace

double MemoryForecast::peak() const {
  double all = 0.0;
  for (const Item& item : lasting) all += item.bytes;
  double most = 0.0;
  for (const Item& item : now_and_then) most = std::max(most, item.bytes);
  return all + most;
}

MemoryForecast forecast_memory(const Setup& setup, double program) {
  const Counted counted(setup);
  MemoryForecast forecast;
  forecast.lasting = {{"the program and its plugins", program + running_code},
                      {"positions", counted.positions()},
                      {"neighbour search", counted.neighbour_search()},
                      {"fields", counted.fields()}};
  double of_plugins = 0.0;
  for (const auto& member : setup.physics) of_plugins += member.passes.memory();
  if (of_plugins > 0.0) forecast.lasting.push_back({"what plugins keep", of_plugins});
  if (const double weights = counted.weights(); weights > 0.0) forecast.lasting.push_back({"weights", weights});
  // Encoding holds the values, the file in memory, and the bytes that are written.
  const double frame = counted.frame(true) + 2.0 * counted.frame(false);
  // Threads find their parts of the blocks before these are put together.
  forecast.now_and_then = {{"a sorting", kept * counted.blocks()},
                           {"a checkpoint", kept * 3.0 * counted.checkpoint()},
                           {"a frame", kept * frame},
                           {"a sample", kept * counted.sample()}};
  return forecast;
}

double frame_bytes(const Setup& setup) { return Counted(setup).frame(false); }

double checkpoint_bytes(const Setup& setup) { return Counted(setup).checkpoint(); }

}  // namespace mesogen
