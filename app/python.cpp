#include "python.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>

#include "install.hpp"
#include "mesogen/diagnostics/error.hpp"

namespace mesogen::app {

namespace {

constexpr const char* python = "/usr/bin/python3";

// Runs a module of the package as a command; before it, names the Debian packages that are missing, where there is no
// traceback to read. The current folder is no place for modules: it may hold a random.py of the user's.
constexpr const char* program = R"(
import sys
sys.path[:] = [folder for folder in sys.path if folder]
import importlib.util, runpy
verb, module = sys.argv[1:3]
missing = [name for name in ("numpy", "h5py", "matplotlib") if importlib.util.find_spec(name) is None]
if missing:
    sys.exit("error: mesogen " + verb + " needs " + ", ".join(missing) + " for Python; install them with: "
             + "apt-get install " + " ".join("python3-" + name for name in missing))
sys.argv[:3] = ["mesogen " + verb]
runpy.run_module(module, run_name="__main__")
)";

/// The Python package lies beside the libraries, in a build as in an installation.
std::filesystem::path package_folder() {
  auto folder = installation() / "lib" / "mesogen" / "python";
  if (!std::filesystem::exists(folder / "mesogen" / "__init__.py"))
    throw Error(ExitCode::run_failed,
                fmt::format("the Python package is missing: {} is not there; install Mesogen again", folder.string()));
  return folder;
}

}  // namespace

Forwarded with_this_mesogen() {
  return {{"--mesogen=" + std::filesystem::read_symlink("/proc/self/exe").string()}, {}};
}

ExitCode hand_over(const std::string& verb, const std::string& module, const Forwarded& given) {
  const char* before = std::getenv("PYTHONPATH");
  std::string path = package_folder().string();
  if (before != nullptr && *before != '\0') path += std::string(":") + before;
  if (setenv("PYTHONPATH", path.c_str(), 1) != 0) throw std::bad_alloc();

  std::vector<std::string> words{python, "-c", program, verb, module};
  words.insert(words.end(), given.options.begin(), given.options.end());
  words.emplace_back("--");
  words.insert(words.end(), given.arguments.begin(), given.arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(python, pointers.data());
  throw Error(ExitCode::run_failed, fmt::format("{} cannot be started ({}); install it with: apt-get install python3 "
                                                "python3-numpy python3-h5py python3-matplotlib",
                                                python, std::strerror(errno)));
}

}  // namespace mesogen::app
