#include "run/state_checkpoint.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "plugin/plugin_call.hpp"
#include "run/planned_fields.hpp"

namespace mesogen {

namespace {

/// Where a plugin keeps numbers of its own.
std::span<double> numbers_of(const Setup::PhysicsMember& member, const PassList::Kept& kept) {
  std::span<double> numbers;
  call_plugin(member.type, "keep(\"" + kept.name + "\")", [&] { numbers = kept.where(); });
  if (numbers.size() != kept.count)
    throw Error(ExitCode::plugin_refused, member.instance + " keeps '" + kept.name + "' as " +
                                              std::to_string(numbers.size()) + " numbers, where it told of " +
                                              std::to_string(kept.count) + ": name the number that there are");
  return numbers;
}

std::string name_of(const Setup::PhysicsMember& member, const PassList::Kept& kept) {
  return member.instance + " keeps " + kept.name;
}

// Where ranks shared the run.
constexpr const char* particles_of_ranks = "particles of ranks";
constexpr const char* rows_of_ranks = "first rows of ranks";

/// Which of the particles in a checkpoint this rank takes.
struct Share {
  std::size_t first;
  std::size_t count;
  bool as_before;  ///< the ranks are those that wrote it
};

Share share_of(const State& state, const Checkpoint& checkpoint) {
  const auto ranks = static_cast<std::size_t>(state.ranks.count());
  const auto rank = static_cast<std::size_t>(state.ranks.rank());
  const auto total = static_cast<std::size_t>(state.scene.particle_count);
  const auto at = checkpoint.integers.find(particles_of_ranks);
  const std::size_t writers = at == checkpoint.integers.end() ? 1 : at->second.size();
  const auto rows = checkpoint.integers.find(rows_of_ranks);
  const bool fits =
      writers == 1 ||
      (rows != checkpoint.integers.end() && state.neighbourhood.parts().can_take(rows->second) &&
       std::accumulate(at->second.begin(), at->second.end(), std::int64_t{0}) == state.scene.particle_count);
  if (writers != ranks || !fits)
    return {total * rank / ranks, total * (rank + 1) / ranks - total * rank / ranks, false};
  if (writers == 1) return {0, total, true};
  const auto before = std::accumulate(at->second.begin(), at->second.begin() + std::ptrdiff_t(rank), std::int64_t{0});
  return {static_cast<std::size_t>(before), static_cast<std::size_t>(at->second[rank]), true};
}

void refuse_other_particles(const std::vector<std::int64_t>& ids) {
  std::vector<bool> seen(ids.size(), false);
  for (const std::int64_t id : ids) {
    if (id < 0 || id >= std::ssize(ids) || seen[static_cast<std::size_t>(id)])
      throw Error(ExitCode::bad_case, "the checkpoint names particle " + std::to_string(id) +
                                          " twice, or it is none of this case: it belongs to another one");
    seen[static_cast<std::size_t>(id)] = true;
  }
}

}  // namespace

void save_state(const Setup& setup, State& state, Checkpoint& checkpoint) {
  state.order.return_to_integration();
  const auto all = [&](const auto& own) { return gather(state.ranks, std::span(own)); };
  const auto list = [&](const auto& array) { return all(array.host()); };
  if (state.ranks.several()) {
    checkpoint.integers[particles_of_ranks] = all(std::vector<std::int64_t>{state.particles.count()});
    const std::vector<int>& rows = state.neighbourhood.parts().begins();
    checkpoint.integers[rows_of_ranks].assign(rows.begin(), rows.end());
  }
  checkpoint.step = state.step;
  checkpoint.time = state.time;
  checkpoint.step_size = state.step_size;
  checkpoint.precision = state.scene.precision;
  checkpoint.dimension = state.scene.dimension;
  checkpoint.integers["id"] = list(state.particles.id);
  for (int d = 0; d < state.scene.dimension; ++d) {
    const std::string axis = std::to_string(d);
    checkpoint.numbers["position " + axis] = list(state.particles.position[d]);
    checkpoint.numbers["sorted position " + axis] = list(state.neighbourhood.sorted_position()[d]);
    const auto images = list(state.particles.images[d]);
    checkpoint.integers["images " + axis].assign(images.begin(), images.end());
  }
  for (const std::string& name : checkpointed_fields(setup)) {
    const Field& field = state.fields.at(name);
    const FieldReader value = field.reader();
    for (int c = 0; c < field.components(); ++c) {
      std::vector<double> values(state.particles.id.size());
      for (Index i = 0; i < state.particles.count(); ++i) values[static_cast<std::size_t>(i)] = value(c, i);
      checkpoint.numbers["field " + name + " " + std::to_string(c)] = all(values);
    }
  }
  for (const auto& member : setup.physics) {
    for (const auto& kept : member.passes.kept()) {
      const auto numbers = numbers_of(member, kept);
      checkpoint.numbers[name_of(member, kept)].assign(numbers.begin(), numbers.end());
    }
  }
}

void restore_state(const Setup& setup, const Checkpoint& checkpoint, State& state) {
  Particles& particles = state.particles;
  const auto take = [&](const auto& lists, const std::string& name) -> const auto& {
    return stored(lists, name, static_cast<std::size_t>(state.scene.particle_count), "particles");
  };
  const Share share = share_of(state, checkpoint);
  const auto own = [&](const auto& list) { return std::span(list).subspan(share.first, share.count); };
  state.order.return_to_integration();
  state.step = checkpoint.step;
  state.time = checkpoint.time;
  state.step_size = checkpoint.step_size;
  refuse_other_particles(take(checkpoint.integers, "id"));
  particles.id.assign(own(take(checkpoint.integers, "id")));
  // A branch may have other cells.
  const bool sorted_alike = checkpoint.numbers.contains("sorted position 0") && share.as_before;
  if (sorted_alike && state.ranks.several()) state.neighbourhood.take_parts(checkpoint.integers.at(rows_of_ranks));
  std::array<std::vector<double>, 3> sorted;
  for (int d = 0; d < state.scene.dimension; ++d) {
    const std::string axis = std::to_string(d);
    particles.position[d].assign(own(take(checkpoint.numbers, "position " + axis)));
    if (sorted_alike) {
      const auto stored_there = own(take(checkpoint.numbers, "sorted position " + axis));
      sorted[d].assign(stored_there.begin(), stored_there.end());
    }
    const auto images = own(take(checkpoint.integers, "images " + axis));
    particles.images[d].resize_for_overwrite(images.size());
    const auto to = particles.images[d].host(exec::Access::write);
    for (std::size_t i = 0; i < images.size(); ++i) to[i] = static_cast<std::int32_t>(images[i]);
  }
  for (const auto& [name, field] : state.fields.all()) field->resize(particles.count(), 0);
  for (const std::string& name : checkpointed_fields(setup)) {
    Field& field = state.fields.at(name);
    for (int c = 0; c < field.components(); ++c) {
      const auto values = own(take(checkpoint.numbers, "field " + name + " " + std::to_string(c)));
      for (Index i = 0; i < particles.count(); ++i) field.set(c, i, values[static_cast<std::size_t>(i)]);
    }
    ++field.version;
  }
  for (const auto& member : setup.physics) {
    for (const auto& kept : member.passes.kept()) {
      const auto& numbers = stored(checkpoint.numbers, name_of(member, kept), kept.count, "numbers");
      std::copy(numbers.begin(), numbers.end(), numbers_of(member, kept).begin());
    }
  }
  sorted_alike ? state.order.restore(sorted) : state.order.sort_anew();
}

}  // namespace mesogen
