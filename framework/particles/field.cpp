#include "particles/field.hpp"

#include <algorithm>
#include <stdexcept>

namespace mesogen {

namespace {

// Pair loops read whole packs, so a few readable, finite numbers follow the last particle.
constexpr std::ptrdiff_t pack_tail = 16;

template <class T>
void restride(exec::Array<T>& values, int components, std::ptrdiff_t from, std::ptrdiff_t to, Index keep) {
  exec::Array<T> larger(static_cast<std::size_t>(components * to + pack_tail), T(0), values.get_allocator());
  for (int c = 0; c < components && !values.empty(); ++c)
    std::copy_n(values.begin() + c * from, keep, larger.begin() + c * to);
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
    backend_.finish();
    const std::ptrdiff_t roomy = (needed + needed / 16 + 2 * pack_tail) / pack_tail * pack_tail;
    const Index keep = std::min(particles_, particles);
    if (!is_double()) restride(single_, components_, stride_, roomy, keep);
    if (is_double() || integrated_) restride(double_, components_, stride_, roomy, keep);
    stride_ = roomy;
  }
  particles_ = particles;
}

template <class Real>
FieldView<Real> Field::view() {
  if constexpr (sizeof(Real) == sizeof(float)) {
    return {single_.data(), stride_};
  } else {
    return {double_.data(), stride_};
  }
}
template FieldView<float> Field::view<float>();
template FieldView<double> Field::view<double>();

double Field::value(int component, Index particle) const {
  const auto at = static_cast<std::size_t>(component * stride_ + particle);
  return is_double() || integrated_ ? double_[at] : static_cast<double>(single_[at]);
}

void Field::set(int component, Index particle, double value) {
  const auto at = static_cast<std::size_t>(component * stride_ + particle);
  if (is_double() || integrated_) double_[at] = value;
  if (!is_double()) single_[at] = static_cast<float>(value);
}

void Field::fill_zero() {
  if (is_double()) {
    backend_.loops<double>().zero(view<double>(), components_, particles_);
  } else {
    backend_.loops<float>().zero(view<float>(), components_, particles_);
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
  const auto permuted = [&](auto& values, auto& room) {
    if (values.empty()) return;
    room.resize(order.size());
    for (int c = 0; c < components_; ++c)
      backend_.cells().permute(values.data() + c * stride_, order.data(), static_cast<Index>(order.size()),
                               room.data());
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
