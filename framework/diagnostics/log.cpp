#include "diagnostics/log.hpp"

#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <string>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

/// "warning: " and "error: " for the user; what merely informs needs no word before it.
class LevelWord : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm& /*time*/, spdlog::memory_buf_t& out) override {
    const std::string_view word = message.level == spdlog::level::warn  ? "warning: "
                                  : message.level == spdlog::level::err ? "error: "
                                                                        : "";
    out.append(word.data(), word.data() + word.size());
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<LevelWord>(); }
};

spdlog::sink_ptr console(bool quiet) {
  auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  // on a terminal a progress line may stand there: wipe it
  const std::string wipe = isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "";
  formatter->add_flag<LevelWord>('*').set_pattern(wipe + "%*%v");
  sink->set_formatter(std::move(formatter));
  sink->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
  return sink;
}

}  // namespace

struct Log::Sinks {
  spdlog::logger logger;
};

Log::Log(bool quiet) : sinks_(std::make_unique<Sinks>(Sinks{spdlog::logger("mesogen", console(quiet))})) {
  sinks_->logger.flush_on(spdlog::level::info);
}

Log::Log(std::unique_ptr<Sinks> sinks) : sinks_(std::move(sinks)) {}

Log::Log(Log&&) noexcept = default;

Log Log::silent() { return Log(std::make_unique<Sinks>(Sinks{spdlog::logger("mesogen")})); }

Log::~Log() = default;

void Log::open_file(const std::filesystem::path& file) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string());
    sink->set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
    sinks_->logger.sinks().push_back(std::move(sink));
  } catch (const spdlog::spdlog_ex& failure) {
    throw Error(ExitCode::run_failed, "the log " + file.string() + " cannot be written: " + failure.what());
  }
}

void Log::info(std::string_view text) { sinks_->logger.info("{}", text); }
void Log::warn(std::string_view text) { sinks_->logger.warn("{}", text); }
void Log::error(std::string_view text) { sinks_->logger.error("{}", text); }

}  // namespace mesogen
