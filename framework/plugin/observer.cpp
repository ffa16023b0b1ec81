#include "mesogen/plugin/observer.hpp"

#include <utility>

namespace mesogen {

Quantity& Quantity::unit(std::string_view text) {
  unit_text = text;
  return *this;
}

Quantity& Quantity::doc(std::string_view text) {
  doc_text = text;
  return *this;
}

void ObserverPlan::reads(std::string_view field) { reads_.emplace_back(field); }

void ObserverPlan::reads_if_present(std::string_view field) { optional_.emplace_back(field); }

void ObserverPlan::reads_if_present(std::string_view field, std::string_view otherwise) {
  reads_if_present(field);
  otherwise_.emplace(field, otherwise);
}

std::vector<std::string> ObserverPlan::fields(const std::function<bool(const std::string&)>& has) const {
  std::vector<std::string> all = reads_;
  for (const std::string& field : optional_) {
    const auto other = otherwise_.find(field);
    if (has(field)) {
      all.push_back(field);
    } else if (other != otherwise_.end()) {
      all.push_back(other->second);
    }
  }
  return all;
}

Quantity& ObserverPlan::scalar(std::string_view name) {
  Quantity& quantity = quantities_.emplace_back();
  quantity.name = name;
  return quantity;
}

Quantity& ObserverPlan::table(std::string_view name, std::size_t columns) {
  Quantity& quantity = scalar(name);
  quantity.columns = columns;
  return quantity;
}

void ObserverPlan::follow_every_step() { follows_ = true; }

void Sample::set(std::string_view quantity, double value) { set(quantity, std::vector<double>{value}); }

void Sample::set(std::string_view quantity, std::vector<double> values) {
  values_.insert_or_assign(std::string(quantity), std::move(values));
}

ObserverContext::~ObserverContext() = default;

Observer::~Observer() = default;

void Observer::parameters(ParameterList&) {}

void Observer::start(const ObserverContext&) {}

void Observer::follow(const ObserverContext&) {}

std::map<std::string, std::vector<double>> Observer::save() const { return {}; }

void Observer::restore(const std::map<std::string, std::vector<double>>&) {}

}  // namespace mesogen
