#pragma once

#include <numeric>
#include <vector>

#include "mesogen/exec/for_each.hpp"
#include "sph/passes/neighbour_runs.hpp"

namespace mesogen::test {

/// The neighbours of a grid as a device has them, found on the host.
class Runs {
 public:
  /// `range`: how far around a particle, m.
  template <class Real, int Dim>
  Runs(Neighbours<Real, Dim> grid, double range) : begin_(static_cast<std::size_t>(grid.particle_count) + 1) {
    const Real square(range * range);
    exec::for_each({}, grid.particle_count, sph::FindRuns<Real, Dim, false>{grid, square, begin_.data(), nullptr});
    std::exclusive_scan(begin_.begin(), begin_.end(), begin_.begin(), 0);
    run_.resize(static_cast<std::size_t>(begin_.back()));
    give_to(grid);
    exec::for_each({}, grid.particle_count, sph::FindRuns<Real, Dim, true>{grid, square, nullptr, run_.data()});
  }

  template <class Grid>
  void give_to(Grid& grid) const {
    grid.run_begin = begin_.data();
    grid.run = run_.data();
  }

  [[nodiscard]] const std::vector<Index>& begin() const { return begin_; }
  [[nodiscard]] const std::vector<NeighbourRun>& run() const { return run_; }

 private:
  std::vector<Index> begin_;  // by particle, one more at the end
  std::vector<NeighbourRun> run_;
};

}  // namespace mesogen::test
