#pragma once

#include "mesogen/fields/field_view.hpp"

namespace mesogen {

/// Values of a field on the host as doubles, in the best precision there is, without a copy. Holds until the field or
/// the order of storage changes.
class FieldReader {
 public:
  FieldReader(FieldView<const double> exact, FieldView<const float> single) : exact_(exact), single_(single) {}
  [[nodiscard]] double operator()(int component, Index particle) const {
    return exact_ ? exact_(component, particle) : static_cast<double>(single_(component, particle));
  }
  /// Of a field with one component.
  [[nodiscard]] double operator()(Index particle) const { return (*this)(0, particle); }

 private:
  FieldView<const double> exact_;
  FieldView<const float> single_;
};

}  // namespace mesogen
