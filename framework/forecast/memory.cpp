#include "forecast/memory.hpp"

#include <algorithm>
#include <set>

#include "ghosts/neighbourhood.hpp"
#include "mesogen/exec/dispatch.hpp"
#include "run/planned_fields.hpp"

namespace mesogen {

namespace {

constexpr double exact = sizeof(double);

// What a run touches beyond what a check has: the code that computes and writes, HDF5's own tables, and what the
// allocator keeps for the thread that writes frames.
constexpr double running_code = 13.5e6;

// The allocator keeps some of what is freed: of what comes and goes, more is resident than is in use.
constexpr double kept = 1.25;

class Counted {
 public:
  explicit Counted(const Setup& setup)
      : setup_(setup),
        scene_(setup.scene),
        number_(dispatch(scene_.precision, []<class Real>() { return double{sizeof(Real)}; })),
        particles_(scene_.particle_count),
        axes_(scene_.dimension),
        reach_(scene_.support + Neighbourhood::skin_in_spacings * scene_.spacing),
        grid_(scene_, *setup.boundary, reach_),
        block_width_(dispatch(scene_.precision, []<class Real>() { return NeighbourBlock::width<Real>; })),
        blocks_(particles_ *
                NeighbourBlocks::expected(reach_ / scene_.spacing, grid_.width(1) / scene_.spacing, block_width_)) {
    const auto& position = setup.arrangement.position;
    const double* axes[3] = {position[0].data(), position[1].data(), position[2].data()};
    const Images images = images_of(scene_, *setup.boundary);
    ghosts_ = count_ghosts(scene_, images, axes, scene_.particle_count, reach_);
    walls_ = WallSet(scene_, *setup.boundary, grid_, images, reach_, nullptr).count();
  }

  [[nodiscard]] double positions() const {
    const double start = axes_ * exact;              // where the case puts them
    const double now = axes_ * (exact + 4.0) + 8.0;  // position, image, id
    // Position at the last sorting, cell, order, blocks; room in which particles change places.
    const double sorted = axes_ * exact + 4.0 + 4.0 + 8.0 + (exact + 4.0 + 8.0);
    return particles_ * (start + now + sorted + axes_ * number_);  // and relative to a tile
  }

  [[nodiscard]] double neighbour_search() const {
    const double beyond = axes_ * (exact + number_);  // tile, and position relative to it
    // Source, image, cell and offset, twice while they are put in order; their numbers.
    const double ghost = 2.0 * (4.0 + 1.0 + 4.0 + axes_ * exact) + 8.0 + 4.0;
    const double cells = grid_.padded_count() * (walls_ > 0.0 ? 16.0 : 8.0);
    const double listing = ghosts_ > 0.0 ? particles_ * 4.0 : 0.0;
    return cells + blocks() + listing + ghosts_ * (ghost + beyond) + walls_ * (wall() + beyond);
  }

  /// The wall particle itself, its place, its mirror point, the way between them and the normal; blocks and both kinds
  /// of weights of the particles around the mirror point, about three quarters of what a particle has around it.
  [[nodiscard]] double wall() const {
    const double around =
        0.75 * NeighbourBlocks::expected_around(reach_ / scene_.spacing, grid_.width(1) / scene_.spacing, block_width_);
    return sizeof(WallSet::Member) + axes_ * 4.0 * exact + 12.0 +
           around * (sizeof(NeighbourBlock) + 2.0 * block_width_ * exact);
  }

  [[nodiscard]] double blocks() const { return blocks_ * sizeof(NeighbourBlock); }

  [[nodiscard]] double fields() const {
    double numbers = 0.0;                      // a particle
    std::set<std::pair<int, double>> scratch;  // see Field::Scratch
    const auto keep_numbers = [&](int components, double number) {
      numbers += components * number;
      scratch.emplace(components, number);
    };
    const auto keep = [&](int components, bool integrated) {
      keep_numbers(components, number_);
      if (integrated && number_ != exact) keep_numbers(components, exact);
    };
    for (const PlannedField& field : planned_fields(setup_)) keep(field.components, field.integrated);
    // What is predicted is kept as it was at the start of a step too; see Integrator.
    if (setup_.source.time.scheme == "midpoint")
      for (const auto& [name, entry] : setup_.catalogue.all())
        if (entry.declaration.advance == Advance::predicted) keep_numbers(setup_.catalogue.components(name), exact);
    for (const auto& [name, entry] : setup_.catalogue.all())
      if (entry.declaration.advance == Advance::by_passes) keep_numbers(setup_.catalogue.components(name), exact);
    for (const LinearTerms& terms : setup_.graph->staged())  // see Stages
      keep((terms.diffusion.any() ? 3 : 2) * setup_.catalogue.components(terms.field), false);
    for (const std::string& name : derived()) keep(setup_.catalogue.components(name), false);
    for (const auto& [components, number] : scratch) numbers += components * number;
    // Room is taken for a sixteenth more than there is.
    return (particles_ + ghosts_ + walls_) * numbers * 17.0 / 16.0;
  }

  /// Of derivatives where nothing moves, and of stages; see sph/fixed_weights.hpp.
  [[nodiscard]] double weights() const {
    const Transport& flow = setup_.graph->transport();
    const bool still = flow.velocity.empty() || flow.fixed;
    bool gradient = false;
    bool laplacian =
        std::ranges::any_of(setup_.graph->staged(), [](const auto& terms) { return terms.diffusion.any(); });
    for (const std::string& name : setup_.graph->derived_for_integration()) {
      if (!still) break;
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

  /// The values of a frame as they are copied when it is taken: id, position, image, and the fields as they are stored.
  [[nodiscard]] double taken_frame() const {
    double bytes = 8.0 + axes_ * (exact + 4.0);
    const std::vector<PlannedField> planned = planned_fields(setup_);
    for (const std::string& name : setup_.output_fields) {
      const auto field = std::ranges::find(planned, name, &PlannedField::name);
      const bool doubles = field != planned.end() && field->integrated;
      bytes += setup_.catalogue.components(name) * (doubles ? exact : number_);
    }
    return particles_ * bytes;
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
  double ghosts_ = 0.0;
  double walls_ = 0.0;
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
                      {"fields", counted.fields()},
                      {"the frame taken last", counted.taken_frame()}};
  double of_plugins = 0.0;
  for (const auto& member : setup.physics) of_plugins += member.passes.memory();
  if (of_plugins > 0.0) forecast.lasting.push_back({"what plugins keep", of_plugins});
  double pixels = 0.0;
  for (const Prescribed& one : setup.prescribed)
    for (const Program& formula : one.components)
      for (const Film& film : formula.films) pixels += static_cast<double>(film.pixels.size());
  // With those of the setup.
  if (pixels > 0.0) forecast.lasting.push_back({"images", 2.0 * sizeof(float) * pixels});
  if (const double weights = counted.weights(); weights > 0.0) forecast.lasting.push_back({"weights", weights});
  // Encoding holds the values, the file in memory, and the bytes that are written.
  const double frame = counted.frame(true) + 2.0 * counted.frame(false);
  // Threads find their parts of the blocks before these are put together.
  const double sorting = counted.blocks();
  // A run goes on while a frame is written, but makes no checkpoint until it is.
  forecast.now_and_then = {
      {"a checkpoint", kept * 3.0 * counted.checkpoint()},
      {"a frame, and beside it a sorting or a sample", kept * (frame + std::max(sorting, counted.sample()))}};
  return forecast;
}

double frame_bytes(const Setup& setup) { return Counted(setup).frame(false); }

double checkpoint_bytes(const Setup& setup) { return Counted(setup).checkpoint(); }

}  // namespace mesogen
