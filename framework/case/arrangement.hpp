#pragma once

#include <array>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "mesogen/particles/field_view.hpp"

namespace mesogen {

/// Where particles start, by id.
struct Arrangement {
  std::array<std::vector<double>, 3> position;  ///< m, in [0, box); the third is empty in 2D
  Index count = 0;
};

/// Rows and columns of particles in the box.
struct LatticeCounts {
  int columns = 0;
  int rows = 0;
};

/// How many particles of the case's spacing fit the box, rounded to whole columns and rows (an even number of rows
/// for a hexagonal arrangement, which must be periodic).
MESOGEN_EXPORT LatticeCounts lattice_counts(const Case& source);

/// What is wrong with the spacing in this box: rounded to whole columns and rows it would change by more than 1 %
/// (a hexagonal arrangement: 2 % in density, 10 % in shape). Empty if nothing is. read_case reports it.
MESOGEN_EXPORT std::string arrangement_problem(const Case& source);

/// How far apart particles are where whole columns and rows do not come out at the case's spacing: "spacing 0.1005 m
/// along x, 0.1 m along y, so that whole rows fit the box". Empty where they do.
MESOGEN_EXPORT std::string fitted_spacing_text(const Case& source);

/// Particles of a checked case: a lattice of cell centres ((i + 1/2) dx, (j + 1/2) dy), row by row from the origin; a
/// hexagonal one, every second row shifted by half a column; or the lattice with seeded uniform shifts.
MESOGEN_EXPORT Arrangement arrange(const Case& source);

}  // namespace mesogen
