#include "ghosts/parts.hpp"

#include <algorithm>
#include <numeric>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

// A rank that has this many times as many particles as the mean keeps the others waiting for as much longer.
constexpr double worth_moving = 1.03;

}  // namespace

Parts::Parts(const CellGrid& grid, int ranks)
    : axis_(grid.dimension() - 1),
      rows_(grid.cells(axis_)),
      cells_in_row_(grid.inside_count() / rows_),
      height_(grid.width(axis_)),
      wrapped_(grid.wrapped(axis_)),
      ranks_(ranks) {
  if (ranks_ > rows_)
    throw Error(ExitCode::bad_case, std::to_string(ranks_) + " ranks cannot share a box of " + std::to_string(rows_) +
                                        " rows of cells: take at most " + std::to_string(rows_) + " ranks");
  for (int rank = 0; rank <= ranks_; ++rank)
    begin_.push_back(static_cast<int>(static_cast<std::int64_t>(rows_) * rank / ranks_));
}

int Parts::owner_of(int row) const {
  return static_cast<int>(std::ranges::upper_bound(begin_, row) - begin_.begin()) - 1;
}

// A little more: who is seen in vain does no harm.
Slab Parts::slab(int rank, int reach) const {
  if (ranks_ == 1 || wrapped_) return {.axis = axis_};
  const double rounding = 1e-9 * height_;
  return {axis_, (begin(rank) - reach) * height_ - rounding, (end(rank) + reach) * height_ + rounding};
}

bool Parts::sees_wrapped(int rank, int reach, int row) const {
  for (const int turn : {-rows_, 0, rows_})
    if (row + turn >= begin(rank) - reach && row + turn < end(rank) + reach) return true;
  return false;
}

std::int64_t Parts::most_in(const std::vector<int>& begins, std::span<const std::int64_t> in_row) const {
  std::int64_t most = 0;
  for (std::size_t rank = 0; rank + 1 < begins.size(); ++rank)
    most = std::max(most,
                    std::accumulate(in_row.begin() + begins[rank], in_row.begin() + begins[rank + 1], std::int64_t{0}));
  return most;
}

bool Parts::balance(std::span<const std::int64_t> particles_in_row) {
  std::vector<std::int64_t> before(particles_in_row.size() + 1, 0);
  std::partial_sum(particles_in_row.begin(), particles_in_row.end(), before.begin() + 1);
  const double share = static_cast<double>(before.back()) / ranks_;
  const std::int64_t most = most_in(begin_, particles_in_row);
  if (static_cast<double>(most) <= worth_moving * share) return false;
  std::vector<int> begins(begin_.size(), rows_);
  begins.front() = 0;
  for (int rank = 1; rank < ranks_; ++rank) {
    const auto wanted = static_cast<std::int64_t>(share * rank);
    int row = static_cast<int>(std::ranges::lower_bound(before, wanted) - before.begin());
    if (row > 0 && wanted - before[static_cast<std::size_t>(row) - 1] < before[static_cast<std::size_t>(row)] - wanted)
      --row;
    const auto at = static_cast<std::size_t>(rank);
    begins[at] = std::clamp(row, begins[at - 1] + 1, rows_ - (ranks_ - rank));
  }
  if (most_in(begins, particles_in_row) >= most) return false;
  begin_ = begins;
  return true;
}

bool Parts::can_take(std::span<const std::int64_t> begins) const {
  return begins.size() == begin_.size() && begins.front() == 0 && begins.back() == rows_ &&
         std::ranges::is_sorted(begins, std::less_equal<>());
}

void Parts::take(std::span<const std::int64_t> begins) {
  std::ranges::transform(begins, begin_.begin(), [](std::int64_t row) { return static_cast<int>(row); });
}

}  // namespace mesogen
