#include "particles/field.hpp"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "particles/field_loops.hpp"
#include "particles/storage_loops.hpp"

namespace mesogen {

namespace {

// Pair loops read whole packs, so a few readable, finite numbers follow the last particle.
constexpr std::ptrdiff_t pack_tail = 16;

template <class T>
void restride(exec::Array<T>& values, exec::DeviceMemory* memory, int components, std::ptrdiff_t from,
              std::ptrdiff_t to, Index keep) {
  exec::Array<T> larger(memory);
  larger.resize(static_cast<std::size_t>(components * to + pack_tail));
  for (int c = 0; c < components && !values.empty(); ++c)
    larger.copy(values, static_cast<std::size_t>(c * from), static_cast<std::size_t>(keep),
                static_cast<std::size_t>(c * to));
  values.swap(larger);
}

}  // namespace

Field::Field(std::string name, int components, Precision precision, bool integrated, const Backend& backend)
    : name_(std::move(name)),
      components_(components),
      precision_(precision),
      integrated_(integrated),
      backend_(backend),
      single_(backend.memory()),
      double_(backend.memory()) {}

void Field::resize(Index particles, Index of_boundary) {
  const std::ptrdiff_t needed = static_cast<std::ptrdiff_t>(particles) + of_boundary;
  if (needed > stride_ || stride_ == 0) {
    const std::ptrdiff_t roomy = (needed + needed / 16 + 2 * pack_tail) / pack_tail * pack_tail;
    const Index keep = std::min(particles_, particles);
    exec::DeviceMemory* const memory = backend_.memory();
    if (!is_double()) restride(single_, memory, components_, stride_, roomy, keep);
    if (is_double() || integrated_) restride(double_, memory, components_, stride_, roomy, keep);
    stride_ = roomy;
  }
  particles_ = particles;
}

FieldReader Field::reader() const {
  if (reads_doubles()) return {master(exec::Side::host), {}};
  return {{}, view<float>(exec::Side::host)};
}

void Field::set(int component, Index particle, double value) {
  constexpr auto host = exec::Side::host;
  constexpr auto access = exec::Access::read_write;
  if (is_double() || integrated_) master(host, access)(component, particle) = value;
  if (!is_double()) view<float>(host, access)(component, particle) = static_cast<float>(value);
}

void Field::fill_zero() {
  // What lies behind the particles stays.
  constexpr auto device = exec::Side::device;
  constexpr auto read_write = exec::Access::read_write;
  if (is_double()) {
    backend_.fields<double>().zero(view<double>(device, read_write), components_, particles_);
  } else {
    backend_.fields<float>().zero(view<float>(device, read_write), components_, particles_);
  }
}

void Field::exchange_master(Field& other) {
  if (components_ != other.components_ || stride_ != other.stride_)
    throw std::logic_error("'" + name_ + "' and '" + other.name_ + "' are stored in different ways");
  double_.swap(other.double_);
  ++version;
  ++other.version;
}

template <class T>
exec::Array<T>& Field::Scratch::room(int components, std::size_t size) {
  auto& rooms = [&]() -> auto& {
    if constexpr (std::is_same_v<T, double>) {
      return exact_;
    } else {
      return single_;
    }
  }
  ();
  exec::Array<T>& room = rooms.try_emplace(components, memory_).first->second;
  if (room.size() != size) room.resize(size);
  return room;
}

void Field::permute(const exec::Array<Index>& order, Scratch& scratch) {
  const auto count = static_cast<Index>(order.size());
  const auto permuted = [&]<class T>(exec::Array<T>& values) {
    if (values.empty()) return;
    exec::Array<T>& room = scratch.room<T>(components_, values.size());
    const T* const from = std::as_const(values).device();
    T* const to = room.device(exec::Access::read_write);  // what lies behind the particles stays
    for (int c = 0; c < components_; ++c)
      backend_.storage().gather(from + c * stride_, order.device(), count, to + c * stride_);
    values.swap(room);
  };
  permuted(single_);
  permuted(double_);
}

void Field::carry(const Journey& journey, bool back) {
  const auto old_count = static_cast<std::size_t>(particles_);
  const std::ptrdiff_t old_stride = stride_;
  const auto carried = [&]<class T>(const exec::Array<T>& values, const auto& put) {
    if (values.empty()) return;
    const T* const from = values.on(exec::Side::host);
    std::vector<std::vector<T>> all;
    for (int c = 0; c < components_; ++c) {
      const std::span<const T> own(from + c * old_stride, old_count);
      all.push_back(back ? journey.bring_back(own) : journey.carry(own));
    }
    put(all);
  };
  std::vector<std::vector<float>> single;
  std::vector<std::vector<double>> exact;
  carried(single_, [&](auto& all) { single = std::move(all); });
  carried(double_, [&](auto& all) { exact = std::move(all); });
  const std::size_t count = single.empty() ? exact.front().size() : single.front().size();
  resize(static_cast<Index>(count), 0);
  const auto put = [&]<class T>(const std::vector<std::vector<T>>& all, exec::Array<T>& values) {
    if (all.empty()) return;
    T* const to = values.on(exec::Side::host, exec::Access::read_write);
    for (int c = 0; c < components_; ++c) std::ranges::copy(all[static_cast<std::size_t>(c)], to + c * stride_);
  };
  put(single, single_);
  put(exact, double_);
}

Field& FieldStore::add(std::unique_ptr<Field> field) {
  const std::string name = field->name();
  const auto [at, inserted] = fields_.emplace(name, std::move(field));
  if (!inserted) throw std::logic_error("field '" + name + "' exists already");
  return *at->second;
}

Field* FieldStore::find(std::string_view name) const {
  const auto at = fields_.find(name);
  return at == fields_.end() ? nullptr : at->second.get();
}

Field& FieldStore::at(std::string_view name) const {
  if (Field* field = find(name)) return *field;
  throw std::logic_error("there is no field '" + std::string(name) + "'");
}

}  // namespace mesogen
