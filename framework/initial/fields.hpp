#pragma once

#include <array>
#include <vector>

#include "case/case.hpp"
#include "initial/arrangement.hpp"

namespace mesogen {

/// Order tensor of each particle by id: (Q11, Q12) = q (cos 2 theta, sin 2 theta) from the case's [director].
MESOGEN_EXPORT std::array<std::vector<double>, 2> initial_order_tensor(const Case& source,
                                                                       const Arrangement& particles);
/// Velocity (m/s) of each particle by id, from [velocity]; zero if the case has none.
MESOGEN_EXPORT std::array<std::vector<double>, 2> initial_velocity(const Case& source, const Arrangement& particles);
/// Colour of each particle by id, from [colour]: 1 in the quarter x < Lx/2, y < Ly/2, else 0.
MESOGEN_EXPORT std::vector<double> initial_colour(const Case& source, const Arrangement& particles);

}  // namespace mesogen
