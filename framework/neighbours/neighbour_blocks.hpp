#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "exec/large_pages.hpp"
#include "mesogen/export.hpp"
#include "mesogen/sph/neighbours.hpp"

namespace mesogen {

/// The blocks of neighbours of all particles, in the order of storage.
struct MESOGEN_EXPORT NeighbourBlocks {
  std::vector<std::int64_t> begin;  // of each particle; one more at the end
  std::vector<NeighbourBlock, exec::LargePages<NeighbourBlock>> block;
  std::array<std::vector<double>, 3> offset;  // of each shift, m; the same in single precision
  std::array<std::vector<float>, 3> offset_single;

  /// Takes, of each segment, what lies between the first particle within `range` (m) and the last one.
  template <class Real, int Dim>
  void find(const Neighbours<Real, Dim>& grid, double range);

  /// The same for points anywhere in the box: the n-th lies in cell[n], at local[d][n] relative to its tile, m.
  template <class Real, int Dim>
  void find_around(const Neighbours<Real, Dim>& grid, const std::array<const double*, 3>& local,
                   std::span<const std::array<int, 3>> cell, double range);

  /// How many a particle has on average, where particles are evenly spread, for memory to be foretold.
  /// `range` and `row`, the height of cells, in particle spacings; `width` of a block.
  static double expected(double range, double row, int width);
  /// The same for blocks of one run each, as `find_around` makes them.
  static double expected_around(double range, double row, int width);

 private:
  void find_offsets(const double* width, int dimension);
};

}  // namespace mesogen
