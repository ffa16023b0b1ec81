#include "run/run_trace.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <utility>

#include "mesogen/diagnostics/error.hpp"
#include "output/run_folder.hpp"
#include "output/write_file.hpp"

namespace mesogen {

namespace {

namespace fs = std::filesystem;

bool begins_as_trace(const fs::path& file) {
  const std::string wanted = Trace(0).text().substr(0, 20);
  std::string found(wanted.size(), ' ');
  std::ifstream(file).read(found.data(), static_cast<std::streamsize>(found.size()));
  return found == wanted;
}

fs::path whole(const fs::path& path) {
  const fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

}  // namespace

void RunTrace::check(const fs::path& file, const fs::path& run_folder) {
  if (file.empty()) return;
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::bad_case, "--trace " + file.string() + why);
  };
  std::error_code error;
  if (fs::is_directory(file, error)) refuse(" is a folder: name a file in it");
  if (belongs_to_run(file)) refuse(" belongs to a run: choose another file");
  if (fs::exists(file, error) && !(fs::is_regular_file(file, error) && begins_as_trace(file)))
    refuse(" is there already and is no trace: choose another file");
  const fs::path folder = whole(file).parent_path();
  if (!fs::is_directory(folder, error) && folder != whole(run_folder))
    refuse(": there is no folder " + folder.string() + ": make it first, or choose another file");
}

RunTrace::RunTrace(fs::path file) : file_(std::move(file)) {
  if (file_.empty()) return;
  output::write_file(file_, Trace(0).text(), output::Owner::user);
  trace_ = std::make_unique<Trace>();
}

void RunTrace::write(Log& log) const {
  if (trace_ == nullptr) return;
  try {
    output::write_file(file_, trace_->text(), output::Owner::user);
  } catch (const std::exception& failure) {
    log.warn(std::string("the trace is lost: ") + failure.what());
    return;
  }
  log.info(fmt::format("trace: {}, {} events; open it in ui.perfetto.dev or chrome://tracing", file_.string(),
                       trace_->recorded()));
  if (trace_->left_out() > 0)
    log.warn(fmt::format("the trace holds the first {} events, {} came after: a shorter run has all of them",
                         trace_->recorded(), trace_->left_out()));
}

}  // namespace mesogen
