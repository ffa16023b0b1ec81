#pragma once

#include "mesogen/export.hpp"

/// The order tensor Q of a 2D nematic, symmetric and traceless: Q = q (2 n n - I) = [[Q11, Q12], [Q12, -Q11]],
/// (Q11, Q12) = q (cos 2 theta, sin 2 theta).
namespace mesogen::nematics {

/// Tr(Q^2) = 2 q^2.
template <class Real>
MESOGEN_HOST_DEVICE Real trace_of_square(Real q11, Real q12) {
  return Real(2) * (q11 * q11 + q12 * q12);
}

/// The part of the bulk in the molecular field, -A Q - C Q Tr(Q^2), Pa. In 2D the term with B of the Landau-de Gennes
/// energy is a multiple of I and drops out. `component`: of Q; `trace` is Tr(Q^2).
template <class Real>
MESOGEN_HOST_DEVICE Real bulk_field(Real a, Real c, Real component, Real trace) {
  return -(a + c * trace) * component;
}

}  // namespace mesogen::nematics
