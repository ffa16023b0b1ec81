#include "plugin/crash.hpp"

#include <pthread.h>
#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "mesogen/diagnostics/error.hpp"
#include "plugin/call_text.hpp"

// A sanitizer that reports signals itself keeps them; any sanitizer may end the process.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MESOGEN_SANITIZER_REPORTS
#define MESOGEN_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define MESOGEN_SANITIZER_REPORTS
#endif
#if defined(MESOGEN_SANITIZER_REPORTS) || __has_feature(undefined_behavior_sanitizer)
#define MESOGEN_SANITIZER
#endif
#endif
#ifdef MESOGEN_SANITIZER
#include <sanitizer/common_interface_defs.h>
#endif

namespace mesogen {

namespace {

// A signal handler reaches nothing but what is global. All of it is set before a handler can run.
std::atomic<int> report_to{-1};
std::atomic<const CrashAdvice*> advice{nullptr};
const CallUnderWay* const* innermost_of_main_thread = nullptr;
// Of a thread that works beside the main thread, not for it.
constinit thread_local bool is_by_itself __attribute__((tls_model("initial-exec"))) = false;
std::atomic_flag told = ATOMIC_FLAG_INIT;
bool on_terminal = false;

#ifdef MESOGEN_SANITIZER_REPORTS
constexpr std::array crashes = {SIGILL, SIGABRT, SIGALRM};  // sanitizers leave these alone
#else
constexpr std::array crashes = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM};
#endif
constexpr std::size_t signal_stack_size = 64UL * 1024UL;

void put(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(report_to.load(), text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// The list of calls that a crash in this thread belongs to, or null.
const CallUnderWay* calls_under_way() {
  if (CallUnderWay::innermost != nullptr || innermost_of_main_thread == nullptr || is_by_itself)
    return CallUnderWay::innermost;
  return *innermost_of_main_thread;
}

/// The calls from the outermost on, as errors have them. Lists are short: an observer asks the boundary.
bool put_calls(const CallUnderWay* innermost) {
  std::array<const CallUnderWay*, 8> calls{};
  std::size_t count = 0;
  for (const auto* call = innermost; call != nullptr && count < calls.size(); call = call->outer) calls[count++] = call;
  bool moment = false;
  for (std::size_t n = count; n > 0; --n) {
    const PluginCall& call = calls[n - 1]->call;
    write_call(call, put);
    moment = moment || call.step != nullptr;
    if (n > 1) put(": ");
  }
  return moment;
}

void tell(std::string_view what) {
  put(on_terminal ? "\r\033[Kerror: " : "error: ");  // a line of progress may stand there
  const CallUnderWay* const calls = calls_under_way();
  const CrashAdvice* const known = advice.load();
  if (calls == nullptr) put("outside of any plugin, Mesogen");
  const bool moment = put_calls(calls);
  if (!moment && known != nullptr) write_moment(known->step, known->time, known->time_unit, put);
  put(what);
  put("\n");
  if (known == nullptr || *known->text() == '\0') return;
  put("  ");
  put(known->text());
  put("\n");
}

/// Did this access go just beyond the end of the thread's stack?
bool is_stack_overflow(const siginfo_t& info, const void* context) {
  const auto& machine = static_cast<const ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
  const auto top = static_cast<std::uintptr_t>(machine.gregs[REG_RSP]);
#elif defined(__aarch64__)
  const auto top = static_cast<std::uintptr_t>(machine.sp);
#else
  return false;
#endif
  const auto at = reinterpret_cast<std::uintptr_t>(info.si_addr);
  constexpr std::uintptr_t near = 64UL * 1024UL;
  return at + near > top && at < top + near;
}

std::string_view description(int signal, const siginfo_t& info, const void* context) {
  switch (signal) {
    case SIGSEGV:
      if (info.si_code > 0 && is_stack_overflow(info, context))
        return " crashed: its stack overflowed, as in a recursion without end (SIGSEGV)";
      return " crashed: it used memory that is not there, such as through a null pointer (SIGSEGV)";
    case SIGBUS: return " crashed: it used memory that cannot be had (SIGBUS)";
    case SIGFPE: return " crashed: it divided an integer by zero (SIGFPE)";
    case SIGILL: return " crashed: it ran an instruction that this processor does not have (SIGILL)";
    case SIGABRT: return " crashed: it aborted, as after a failed assertion or an exception nobody caught (SIGABRT)";
    default: return " did not come back in time, as in a loop without end (SIGALRM)";
  }
}

extern "C" void on_crash(int signal, siginfo_t* info, void* context) {
  // Several threads may crash at once: one tells, the others wait for the end.
  if (told.test_and_set()) {
    for (;;) ::pause();
  }
  tell(description(signal, *info, context));
  // Blocked until the handler returns: then it does what it does by default, where the crash was.
  std::signal(signal, SIG_DFL);
  ::pthread_kill(::pthread_self(), signal);
}

/// A stack for the handler, since that of the thread may be full. A thread that has one keeps it: a sanitizer may have
/// set it up.
class SignalStack {
 public:
  SignalStack() {
    stack_t stack{};
    if (::sigaltstack(nullptr, &stack) != 0 || (stack.ss_flags & SS_DISABLE) == 0) return;
    memory_ = ::mmap(nullptr, signal_stack_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    stack = {};
    stack.ss_sp = memory_;
    stack.ss_size = signal_stack_size;
    if (memory_ != MAP_FAILED) ::sigaltstack(&stack, nullptr);
  }
  ~SignalStack() {
    if (memory_ == MAP_FAILED) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    ::sigaltstack(&none, nullptr);
    ::munmap(memory_, signal_stack_size);
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  void* memory_ = MAP_FAILED;
};

void use_signal_stack() { thread_local const SignalStack stack; }

void install() {
  use_signal_stack();
  struct sigaction action {};
  action.sa_sigaction = on_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  ::sigemptyset(&action.sa_mask);
  for (const int signal : crashes) ::sigaction(signal, &action, nullptr);
#ifdef MESOGEN_SANITIZER
  __sanitizer_set_death_callback([] {
    if (!told.test_and_set()) tell(" crashed: see the report above");
    std::signal(SIGABRT, SIG_DFL);  // it may end so
  });
#endif
}

void on_exit_within_plugin() {
  if (calls_under_way() == nullptr) return;
  tell(" ended the process: it called exit(); throw an error instead");
  std::_Exit(static_cast<int>(ExitCode::run_failed));
}

}  // namespace

void tell_of_crashes(int file) {
  const bool first = report_to.exchange(file) < 0;
  on_terminal = ::isatty(file) != 0;
  if (!first) return;
  innermost_of_main_thread = &CallUnderWay::innermost;
  std::atexit(on_exit_within_plugin);
  install();
}

void tell_of_crashes_in_this_thread() {
  is_by_itself = true;
  if (report_to.load() >= 0) use_signal_stack();
}

void tell_of_crashes_in_threads() {
  if (report_to.load() < 0) return;
#pragma omp parallel
  use_signal_stack();
}

CrashAdvice::CrashAdvice(const std::int64_t& step_of_run, const double& time_of_run, std::string unit)
    : step(step_of_run), time(time_of_run), time_unit(std::move(unit)) {
  advice.store(this);
}
CrashAdvice::~CrashAdvice() { advice.store(nullptr); }

void CrashAdvice::advise(std::string text) {
  const std::size_t other = 1 - current_.load();
  texts_[other] = std::move(text);
  current_.store(other);
}

}  // namespace mesogen
