#include "mesogen/plugin/shape.hpp"

namespace mesogen {

Shape::~Shape() = default;

void Shape::parameters(ParameterList&) {}

void Shape::prepare(const Scene&) {}

}  // namespace mesogen
