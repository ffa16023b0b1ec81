// A box whose images above and below are moved along x and flow at another velocity (Lees and Edwards 1972): the
// boundary says by how much, the framework makes the ghosts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "particle_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

constexpr double jump = 3.0;
constexpr double moved = 7.3;

class Sheared final : public Boundary {
 public:
  explicit Sheared(Continuation along_x) : along_x_(along_x) {}
  mutable int asked = 0;

  [[nodiscard]] Continuation continuation(int axis) const override {
    return axis == 0 ? along_x_ : Continuation::ghosts;
  }
  [[nodiscard]] std::array<double, 3> shear(const Scene&, const std::array<int, 3>& boxes) const override {
    return {boxes[1] * moved, 0.0, 0.0};
  }
  [[nodiscard]] AffineRule ghost_rule(const Scene&, const FieldKind& field,
                                      const std::array<int, 3>& boxes) const override {
    ++asked;
    AffineRule rule(field);
    if (field.role == FieldRole::velocity) rule.summand(0) = boxes[1] * jump;
    return rule;
  }

 private:
  Continuation along_x_;
};

ParticleScene::Options box() {
  ParticleScene::Options options;
  options.box = {12.0, 9.0, 0.0};
  options.spacing = 1.0;
  return options;
}

class ShearedBox : public testing::TestWithParam<Continuation> {};

TEST_P(ShearedBox, FindsEveryPairOnce) {
  ParticleScene scene(box(), jittered(12, 9, 1.0, 0.4), std::make_unique<Sheared>(GetParam()));
  State& state = scene.state();
  using Pair = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>;
  std::vector<Pair> found;
  std::vector<Pair> expected;
  const std::int64_t* const id = state.particles.id.host().data();
  const auto at = exec::pointers(state.particles.position, exec::Side::host);
  const auto note = [&](std::vector<Pair>& pairs, Index i, Index j, double x, double y) {
    // To the middle of a part of 1e-6: rounding leaves it where it is.
    if (std::hypot(x, y) < state.scene.support)
      pairs.emplace_back(id[i], id[j], std::llround(x * 1e6), std::llround(y * 1e6));
  };
  Neighbours<double, 2> grid{};
  state.neighbourhood.fill(grid, exec::Side::host);
  const GhostView ghosts = state.neighbourhood.ghost_view(exec::Side::host);
  for (Index i = 0; i < state.particles.count(); ++i) {
    for (auto n = grid.block_begin[i]; n < grid.block_begin[i + 1]; ++n) {
      const NeighbourBlock& block = grid.block[n];
      for (int lane = 0; lane < block.lanes; ++lane) {
        const Index j = block.particle(lane);
        double way[2];
        for (int d = 0; d < 2; ++d) {
          const double offset = grid.offset[d][NeighbourBlock::most_shift + block.shift_at(lane, d)];
          way[d] = grid.local[d][i] - offset - grid.local[d][j];
        }
        note(found, i, j < ghosts.first ? j : ghosts.source[j - ghosts.first], way[0], way[1]);
      }
    }
    for (Index j = 0; j < state.particles.count(); ++j)
      for (int up = -1; up <= 1; ++up)
        for (int across = -2; across <= 2; ++across)
          note(expected, i, j, at[0][i] - at[0][j] - 12.0 * across - moved * up, at[1][i] - at[1][j] - 9.0 * up);
  }
  std::ranges::sort(found);
  std::ranges::sort(expected);
  EXPECT_EQ(found, expected);
}

TEST_P(ShearedBox, ChangesTheVelocityAlone) {
  auto boundary = std::make_unique<Sheared>(GetParam());
  const Sheared& sheared = *boundary;
  ParticleScene scene(box(), lattice(12, 9, 1.0), std::move(boundary));
  State& state = scene.state();
  Field& velocity = state.add_field("velocity", 2, false);
  velocity.kind = FieldKind{Rank::vector, FieldRole::velocity, 2};
  Field& shift = state.add_field("shift", 2, false);
  shift.kind = FieldKind{Rank::vector, FieldRole::derived, 2};
  state.order.sort_anew();
  const auto refresh = [&] {
    for (Field* const field : {&velocity, &shift}) {
      for (Index i = 0; i < state.particles.count(); ++i) {
        field->set(0, i, i);
        field->set(1, i, -i);
      }
      ++field->version;
      state.boundary_values.refresh(*field);
    }
  };
  refresh();
  const GhostView ghosts = state.neighbourhood.ghost_view(exec::Side::host);
  ASSERT_GE(ghosts.count, 2 * 12 * 4) << "four rows beyond either face";
  for (Index n = 0; n < ghosts.count; ++n) {
    const double source = ghosts.source[n];
    const double up = std::round(ghosts.offset[1][n] / 9.0);
    EXPECT_EQ(velocity.value(0, ghosts.first + n), source + up * jump);
    EXPECT_EQ(velocity.value(1, ghosts.first + n), -source);
    EXPECT_EQ(shift.value(0, ghosts.first + n), source);
  }
  const int asked = sheared.asked;
  refresh();
  EXPECT_EQ(sheared.asked, asked) << "once for each field and image";
}

INSTANTIATE_TEST_SUITE_P(AlongX, ShearedBox, testing::Values(Continuation::wrapped, Continuation::ghosts),
                         [](const auto& set) { return set.param == Continuation::wrapped ? "wrapped" : "ghosts"; });

}  // namespace
