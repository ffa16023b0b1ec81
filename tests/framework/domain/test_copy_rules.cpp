// A boundary may change fields on their way to the copies: a box that is sheared (Lees and Edwards 1972) gives those
// above and below another velocity.

#include "domain/copy_rules.hpp"

#include <gtest/gtest.h>

#include "mesogen/domain/periodic.hpp"
#include "schedule/world.hpp"

namespace {

using namespace mesogen;

constexpr double jump = 3.0;

class Sheared final : public Boundary {
 public:
  mutable int asked = 0;

  [[nodiscard]] bool wraps(int axis) const override { return axis == 0; }
  void keep_inside(const Scene& scene, double* position, std::int32_t* images) const override {
    for (unsigned d = 0; d < 2; ++d) wrap_into_box(scene.box[d], position[d], images[d]);
  }
  void copies(const Scene& scene, const double* const* position, Index count, double reach,
              Copies& out) const override {
    for (Index i = 0; i < count; ++i) {
      if (position[1][i] < reach) add(out, i, scene.box[1]);
      if (position[1][i] >= scene.box[1] - reach) add(out, i, -scene.box[1]);
    }
  }
  void carry_over(const Scene&, std::string_view field, int components, const Copies& copies,
                  std::vector<Extension>& extension) const override {
    ++asked;
    if (field != "velocity") return;
    for (std::size_t n = 0; n < copies.source.size(); ++n)
      extension[n * static_cast<std::size_t>(components)].summand = copies.offset[n][1] > 0.0 ? jump : -jump;
  }

 private:
  static void add(Copies& out, Index source, double above) {
    out.source.push_back(source);
    out.offset.push_back({0.0, above, 0.0});
  }
};

TEST(CopyRules, AreAppliedToEachCopyAndAskedForOnceASorting) {
  const Sheared boundary;
  Scene scene;
  scene.precision = Precision::double_precision;
  scene.box = {1.0, 1.0, 0.0};
  scene.spacing = 0.1;
  scene.support = 0.3;
  scene.particle_count = 100;
  Particles particles;
  for (int i = 0; i < 100; ++i) {
    particles.id.push_back(i);
    particles.position[0].push_back(0.05 + 0.1 * (i % 10));
    particles.position[1].push_back(0.05 + 0.1 * (i / 10));
    for (std::size_t d = 0; d < 2; ++d) particles.images[d].push_back(0);
  }
  World world(scene, {}, boundary, particles);
  Field& velocity = world.add_field("velocity", 2, false);
  Field& colour = world.add_field("colour", 1, false);
  world.settle();
  const auto fill = [&] {
    for (Index i = 0; i < 100; ++i) {
      velocity.set(0, i, i);
      velocity.set(1, i, -i);
      colour.set(0, i, 0.5 * i);
    }
    ++velocity.version;
    ++colour.version;
    world.refresh_outside(velocity);
    world.refresh_outside(colour);
  };
  fill();
  const Copies& copies = world.neighbourhood.copies();
  ASSERT_EQ(copies.source.size(), 60U) << "three rows at either face";
  for (std::size_t n = 0; n < copies.source.size(); ++n) {
    const auto at = static_cast<Index>(100 + n);
    const double source = copies.source[n];
    EXPECT_EQ(velocity.value(0, at), source + (copies.offset[n][1] > 0.0 ? jump : -jump));
    EXPECT_EQ(velocity.value(1, at), -source);
    EXPECT_EQ(colour.value(0, at), 0.5 * source);
  }
  fill();
  EXPECT_EQ(boundary.asked, 2) << "once for each field";
  world.sort_anew();
  fill();
  EXPECT_EQ(boundary.asked, 4);
}

}  // namespace
