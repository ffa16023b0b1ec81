#include "run/frame_values.hpp"

#include <array>

#include "neighbours/outside.hpp"

namespace mesogen {

namespace {

/// Where reading copies nothing; an array or a field.
template <class Values>
exec::Side side_of(const Values& values) {
  return values.is_on(exec::Side::host) ? exec::Side::host : exec::Side::device;
}

template <class T>
const T* numbers(const std::byte* column) {
  return reinterpret_cast<const T*>(column);
}

/// One component of a field, from the order of storage to that of ids.
template <class T>
void put_in_order(const T* stored, const std::int64_t* id, std::size_t count, int component, FrameField& field) {
  for (std::size_t i = 0; i < count; ++i)
    field.values[static_cast<std::size_t>(id[i] * field.components + component)] = static_cast<double>(stored[i]);
}

}  // namespace

FrameValues::FrameValues(const State& state, const WholeState& whole, const Setup& setup)
    : state_(state), whole_(whole), setup_(setup), snapshot_(whole.backend().memory()) {}

void FrameValues::take() {
  const Particles& particles = whole_.particles();
  count_ = particles.id.size();
  doubles_.clear();
  std::vector<exec::Snapshot::Source> sources;
  const auto add = [&]<class T>(const T* place, exec::Side side) {
    sources.push_back({place, count_ * sizeof(T), side});
  };
  const auto add_array = [&](const auto& array) { add(array.on(side_of(array)), side_of(array)); };
  const auto dimension = static_cast<std::size_t>(state_.scene.dimension);
  add_array(particles.id);
  for (std::size_t d = 0; d < dimension; ++d) add_array(particles.position[d]);
  for (std::size_t d = 0; d < dimension; ++d) add_array(particles.images[d]);
  for (const std::string& name : setup_.output_fields) {
    const Field& field = whole_.fields().at(name);
    const exec::Side side = side_of(field);
    doubles_.push_back(field.reads_doubles());
    for (int c = 0; c < field.components(); ++c) {
      if (doubles_.back()) {
        add(field.master(side).component(c), side);
      } else {
        add(field.view<float>(side).component(c), side);
      }
    }
  }
  snapshot_.take(sources);
}

std::vector<FrameField> FrameValues::fields() const {
  const int dimension = state_.scene.dimension;
  std::vector<FrameField> fields{{"position", state_.units.length, dimension, {}, NumberType::float64, Rank::vector},
                                 // H5MD's name for the boxes that a particle has crossed.
                                 {"image", "1", dimension, {}, NumberType::int32, Rank::vector}};
  const NumberType number = state_.single() ? NumberType::float32 : NumberType::float64;
  for (const std::string& name : setup_.output_fields)
    fields.push_back({name,
                      state_.units.text(setup_.catalogue.unit(name)),
                      state_.fields.at(name).components(),
                      {},
                      number,
                      setup_.catalogue.rank(name)});
  return fields;
}

void FrameValues::fill(std::vector<FrameField>& fields) const {
  const Columns columns = snapshot_.wait();
  const auto* const id = numbers<std::int64_t>(columns[0]);
  for (FrameField& field : fields) field.values.resize(count_ * static_cast<std::size_t>(field.components));
  fill_positions(columns, fields[0], fields[1]);
  std::size_t next = 1 + 2 * static_cast<std::size_t>(state_.scene.dimension);
  // Behind the position and the image.
  for (std::size_t n = 2; n < fields.size(); ++n) {
    for (int c = 0; c < fields[n].components; ++c) {
      const std::byte* const column = columns[next++];
      if (doubles_[n - 2]) {
        put_in_order(numbers<double>(column), id, count_, c, fields[n]);
      } else {
        put_in_order(numbers<float>(column), id, count_, c, fields[n]);
      }
    }
  }
}

void FrameValues::fill_positions(const Columns& columns, FrameField& position, FrameField& image) const {
  const Scene& scene = state_.scene;
  const auto* const id = numbers<std::int64_t>(columns[0]);
  std::array<const double*, 3> stored_position{};
  std::array<const std::int32_t*, 3> stored_images{};
  const auto dimension = static_cast<std::size_t>(scene.dimension);
  for (std::size_t d = 0; d < dimension; ++d) {
    stored_position[d] = numbers<double>(columns[1 + d]);
    stored_images[d] = numbers<std::int32_t>(columns[1 + dimension + d]);
  }
  for (std::size_t i = 0; i < count_; ++i) {
    std::array<double, 3> at{};
    std::array<std::int32_t, 3> images{};
    for (std::size_t d = 0; d < dimension; ++d) {
      at[d] = stored_position[d][i];
      images[d] = stored_images[d][i];
    }
    if (!exec::is_inside(stored_position.data(), scene.box.data(), scene.dimension, static_cast<Index>(i)))
      state_.boundary.keep_inside(scene, at.data(), images.data());
    const std::size_t row = static_cast<std::size_t>(id[i]) * dimension;
    for (std::size_t d = 0; d < dimension; ++d) {
      position.values[row + d] = at[d];
      image.values[row + d] = images[d];
    }
  }
}

}  // namespace mesogen
