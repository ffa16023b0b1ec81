#pragma once

#include <array>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "mesogen/fields/field_view.hpp"

namespace mesogen {

/// Where particles start, by id.
struct Arrangement {
  std::array<std::vector<double>, 3> position;  ///< m, in [0, box); empty along an axis that the scene has not
  Index count = 0;
};

/// How many particles there are along each axis of the box: columns, rows, layers.
struct LatticeCounts {
  std::array<int, 3> along{1, 1, 1};
  [[nodiscard]] double total() const { return static_cast<double>(along[0]) * along[1] * along[2]; }
};

/// Why the arrangement of a case is none in its dimension; empty if it is one. read_case reports it.
MESOGEN_EXPORT std::string dimension_problem(const Case& source);

/// How many particles of the case's spacing fit the box, rounded to whole columns and rows (an even number of rows
/// for a hexagonal arrangement, which must be periodic).
MESOGEN_EXPORT LatticeCounts lattice_counts(const Case& source);

/// What is wrong with the spacing in this box: rounded to whole columns and rows it would change by more than 1 %
/// (a hexagonal arrangement: 2 % in density, 10 % in shape). Empty if nothing is. read_case reports it.
MESOGEN_EXPORT std::string arrangement_problem(const Case& source);

/// How far apart particles are where whole columns and rows do not come out at the case's spacing: "spacing 0.1005 m
/// along x, 0.1 m along y, so that whole rows fit the box". Empty where they do.
MESOGEN_EXPORT std::string fitted_spacing_text(const Case& source);

/// Particles of a checked case: a lattice of cell centres ((i + 1/2) dx, (j + 1/2) dy, ...), row by row from the
/// origin; a hexagonal one, every second row shifted by half a column; or the lattice with seeded uniform shifts.
MESOGEN_EXPORT Arrangement arrange(const Case& source);

}  // namespace mesogen
