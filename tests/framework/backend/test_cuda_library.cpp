#include "backend/cuda_library.hpp"

#include <gtest/gtest.h>

namespace {

using namespace mesogen;

TEST(CudaLibrary, OfAnotherBuildIsRefused) {
  CudaLibrary library{0, nullptr, nullptr};
  EXPECT_EQ(cuda_library_problem(library), "what it exports is not Mesogen's code for CUDA");
  library.magic = cuda_library_magic;
  EXPECT_NE(cuda_library_problem(library).find("it belongs to another Mesogen (unknown) than this one ("),
            std::string::npos);
  library.build = "0.0.1, interface 1, other";
  const std::string text = cuda_library_problem(library);
  EXPECT_NE(text.find("another Mesogen (0.0.1, interface 1, other) than"), std::string::npos) << text;
  EXPECT_NE(text.find("build and install both together"), std::string::npos) << text;
}

}  // namespace
