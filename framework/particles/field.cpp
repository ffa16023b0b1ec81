#include "particles/field.hpp"

#include <algorithm>
#include <stdexcept>

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

void Field::permute(const exec::Array<Index>& order, Scratch& scratch) {
  const auto count = static_cast<Index>(order.size());
  const auto permuted = [&](auto& values, auto& room) {
    if (values.empty()) return;
    room.resize_for_overwrite(order.size());
    auto* const all = values.device(exec::Access::read_write);
    for (int c = 0; c < components_; ++c)
      backend_.storage().permute(all + c * stride_, order.device(), count, room.device(exec::Access::write));
  };
  permuted(single_, scratch.single);
  permuted(double_, scratch.exact);
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
