#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "error_of.hpp"
#include "plugin/registry.hpp"

namespace {

using namespace mesogen;
namespace fs = std::filesystem;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A folder with a plugin, and another file in the place of its library for CUDA; gone at the end.
class Twins {
 public:
  // A name of its own: what was once loaded by a name stays.
  Twins(const std::string& name, const fs::path& twin) : folder_(fs::path(::testing::TempDir()) / ("twins-" + name)) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "cuda");
    fs::copy(built("friction"), folder_ / "friction.so");
    fs::copy(twin, folder_ / "cuda" / "friction.so");
  }
  ~Twins() { fs::remove_all(folder_); }
  Twins(const Twins&) = delete;
  Twins& operator=(const Twins&) = delete;

  static fs::path built(const std::string& name) { return fs::path(MESOGEN_TEST_PLUGIN_FOLDER) / (name + ".so"); }
  [[nodiscard]] PluginRegistry registry() const { return PluginRegistry::only({folder_}); }

 private:
  fs::path folder_;
};

// What is loaded for CUDA is told apart by its descriptor, so libraries for the host will do here.
TEST(PluginRegistry, ALibraryForCudaMustBeThatOfThePlugin) {
  {
    const Twins twins("alike", Twins::built("friction"));
    const auto registry = twins.registry();
    EXPECT_TRUE(registry.has_cuda("friction"));
    EXPECT_EQ(registry.cuda_problem("friction"), "");
    EXPECT_NE(registry.make_physics_for_cuda("friction", Precision::double_precision, 2), nullptr);
  }
  const Twins twins("strangers", Twins::built("body_force"));
  const auto registry = twins.registry();
  const std::string text =
      error_of([&] { (void)registry.make_physics_for_cuda("friction", Precision::double_precision, 2); },
               ExitCode::plugin_refused);
  EXPECT_TRUE(contains(text, "the physics plugin \"friction\" for CUDA was refused: ")) << text;
  EXPECT_TRUE(contains(text, "/cuda/friction.so: it is physics body_force 1.0.0, where ")) << text;
  EXPECT_TRUE(contains(text, "/friction.so is physics friction 1.0.0: build both again")) << text;
}

TEST(PluginRegistry, ALibraryForCudaThatIsNoneIsRefused) {
  const fs::path file = fs::path(::testing::TempDir()) / "no_library";
  std::ofstream(file) << "text";
  const Twins twins("none", file);
  const std::string text = twins.registry().cuda_problem("friction");
  EXPECT_TRUE(contains(text, "/cuda/friction.so: it is not a shared library")) << text;
}

}  // namespace
