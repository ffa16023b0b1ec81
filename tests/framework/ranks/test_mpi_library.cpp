#include "ranks/mpi_library.hpp"

#include <gtest/gtest.h>

namespace {

using namespace mesogen;

TEST(MpiLibrary, OfAnotherBuildIsRefused) {
  const auto ranks = +[]() -> const Ranks* { return nullptr; };
  EXPECT_EQ(mpi_library_problem({1, "0.0.1", ranks}), "what it exports is not Mesogen's code for MPI");
  const std::string text = mpi_library_problem({mpi_library_magic, "0.0.1", ranks});
  EXPECT_EQ(text.find("it belongs to another Mesogen (0.0.1) than this one ("), 0) << text;
  EXPECT_TRUE(text.ends_with("): build and install both together")) << text;
  EXPECT_NE(mpi_library_problem({mpi_library_magic, nullptr, ranks}).find("another Mesogen (unknown)"),
            std::string::npos);
}

}  // namespace
