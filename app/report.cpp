#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "install.hpp"
#include "verbs.hpp"

namespace mesogen::app {

namespace {

constexpr const char* python = "/usr/bin/python3";

// Runs the package's own command; before it, names the Debian packages that are missing, where there is no traceback
// to read.
constexpr const char* program = R"(
import importlib.util, runpy, sys
missing = [name for name in ("numpy", "h5py", "matplotlib") if importlib.util.find_spec(name) is None]
if missing:
    sys.exit("error: mesogen report needs " + ", ".join(missing) + " for Python; install them with: apt-get install "
             + " ".join("python3-" + name for name in missing))
sys.argv[0] = "mesogen report"
runpy.run_module("mesogen.report", run_name="__main__")
)";

/// The Python package lies beside the libraries, in a build as in an installation.
std::filesystem::path package_folder() {
  const auto folder = installation() / "lib" / "mesogen" / "python";
  if (!std::filesystem::exists(folder / "mesogen" / "__init__.py"))
    throw Error(ExitCode::run_failed,
                fmt::format("the Python package is missing: {} is not there; install Mesogen again", folder.string()));
  return folder;
}

ExitCode report(std::vector<std::string> arguments) {
  const char* before = std::getenv("PYTHONPATH");
  std::string path = package_folder().string();
  if (before != nullptr && *before != '\0') path += std::string(":") + before;
  if (setenv("PYTHONPATH", path.c_str(), 1) != 0) throw std::bad_alloc();

  std::vector<std::string> words{python, "-c", program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(python, pointers.data());
  throw Error(ExitCode::run_failed, fmt::format("{} cannot be started ({}); install it with: apt-get install python3 "
                                                "python3-numpy python3-h5py python3-matplotlib",
                                                python, std::strerror(errno)));
}

}  // namespace

void add_report(CLI::App& command, Action& action) {
  struct Options {
    std::string folder;
    std::string output;
    int frame = -1;
  };
  const auto options = std::make_shared<Options>();
  auto* const verb = command.add_subcommand("report", "Draw pictures of a run's results");
  verb->add_option("folder", options->folder, "Folder of a run")->type_name("DIR")->required();
  verb->add_option("--output", options->output, "Folder for the pictures (default: DIR/report)")->type_name("DIR");
  verb->add_option("--frame", options->frame, "Frame to draw; negative numbers count from the end (default: the last)")
      ->type_name("N");
  verb->callback([&action, options] {
    action = [options] {
      std::vector<std::string> arguments{"--frame=" + std::to_string(options->frame)};
      if (!options->output.empty()) arguments.push_back("--output=" + options->output);
      arguments.insert(arguments.end(), {"--", options->folder});
      return report(std::move(arguments));
    };
  });
}

}  // namespace mesogen::app
