#include "run/state_view.hpp"

#include <gtest/gtest.h>

#include "active_scene.hpp"

namespace {

using namespace mesogen;
using namespace mesogen::test;

TEST(StateView, RefusesComponentsThatAFieldHasNot) {
  CaseRun run(active_scene("double"));
  const StateView view(run.state());
  EXPECT_EQ(view.values("order_tensor_gradient", 3).size(), 400U);
  for (const int component : {-1, 4}) {
    try {
      (void)view.values("order_tensor_gradient", component);
      FAIL() << "gave component " << component;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::plugin_refused);
      EXPECT_EQ(error.what(), "'order_tensor_gradient' has the components 0 to 3, not " + std::to_string(component));
    }
  }
}

}  // namespace
