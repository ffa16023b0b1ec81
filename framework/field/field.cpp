#include "field/field.hpp"

#include <algorithm>
#include <stdexcept>

namespace mesogen {

namespace {

// Pair loops read whole packs, so a few readable, finite numbers follow the last particle.
constexpr std::ptrdiff_t pack_tail = 16;

template <class T>
void restride(std::vector<T>& values, int components, std::ptrdiff_t from, std::ptrdiff_t to, Index keep) {
  std::vector<T> larger(static_cast<std::size_t>(components * to + pack_tail), T(0));
  for (int c = 0; c < components && !values.empty(); ++c)
    std::copy_n(values.begin() + c * from, keep, larger.begin() + c * to);
  values.swap(larger);
}

template <class T>
void permute_component(T* values, const std::vector<Index>& order, std::vector<T>& scratch) {
  const auto count = static_cast<Index>(order.size());
  scratch.resize(order.size());
  T* const moved = scratch.data();
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (Index n = 0; n < count; ++n) moved[n] = values[order[static_cast<std::size_t>(n)]];
#pragma omp for schedule(static)
    for (Index n = 0; n < count; ++n) values[n] = moved[n];
  }
}

}  // namespace

Field::Field(std::string name, int components, Precision precision, bool integrated)
    : name_(std::move(name)), components_(components), precision_(precision), integrated_(integrated) {}

void Field::resize(Index particles, Index copies) {
  const std::ptrdiff_t needed = static_cast<std::ptrdiff_t>(particles) + copies;
  if (needed > stride_ || stride_ == 0) {
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
  const auto clear = [this](auto* values) {
    for (int c = 0; c < components_; ++c) {
      auto* const component = values + c * stride_;
#pragma omp parallel for schedule(static)
      for (Index i = 0; i < particles_; ++i) component[i] = 0;
    }
  };
  if (is_double()) {
    clear(double_.data());
  } else {
    clear(single_.data());
  }
}

void Field::copy_master(Field& of) {
  const FieldView<double> from = of.master();
  const FieldView<double> to = master();
  for (int c = 0; c < components_; ++c) {
    const double* const source = from.component(c);
    double* const target = to.component(c);
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < particles_; ++i) target[i] = source[i];
  }
}

void Field::permute(const std::vector<Index>& order, Scratch& scratch) {
  for (int c = 0; c < components_; ++c) {
    if (!single_.empty()) permute_component(single_.data() + c * stride_, order, scratch.single);
    if (!double_.empty()) permute_component(double_.data() + c * stride_, order, scratch.exact);
  }
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
