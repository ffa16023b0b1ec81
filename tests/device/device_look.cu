// What the CUDA device here is and how fast it copies and starts kernels, as one JSON object on stdout: scripts/device
// keeps it, and compares passes with it. With MESOGEN_CUDA_ON_HOST = 1 the host plays the device: its copies alone are
// measured. Exits with 77 where there is no device; "problem" then says why.

#include <cuda_runtime.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

constexpr int skipped = 77;
constexpr int repetitions = 5;

void check(cudaError_t status, const char* what) {
  if (status == cudaSuccess) return;
  std::fprintf(stderr, "device_look: %s: %s\n", what, cudaGetErrorString(status));
  std::exit(1);
}

/// The members of a JSON object, in order.
class Members {
 public:
  void number(const char* name, double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", value);
    add(name, text);
  }
  void text(const char* name, const std::string& value) {
    std::string quoted = "\"";
    for (const char one : value) {
      if (one == '"' || one == '\\') quoted += '\\';
      if (static_cast<unsigned char>(one) >= ' ') quoted += one;
    }
    add(name, quoted + '"');
  }
  void truth(const char* name, bool value) { add(name, value ? "true" : "false"); }
  void print() const { std::printf("{%s}\n", all_.c_str()); }

 private:
  void add(const char* name, const std::string& value) {
    all_ += (all_.empty() ? "\"" : ", \"") + std::string(name) + "\": " + value;
  }
  std::string all_;
};

/// The least time of some repetitions of `action`, s.
template <class Action>
double seconds_of(const Action& action) {
  double least = 1e30;
  for (int n = 0; n < repetitions; ++n) {
    const auto begin = std::chrono::steady_clock::now();
    action();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return least;
}

__global__ void do_nothing() {}

int attribute(cudaDeviceAttr which, const char* what) {
  int value = 0;
  check(cudaDeviceGetAttribute(&value, which, 0), what);
  return value;
}

/// Additions and multiplications in single precision that a multiprocessor does per clock: one fused pair per lane.
double flops_per_clock(int major, int minor) { return 2.0 * (major == 8 && minor == 0 ? 64 : 128); }

void describe(Members& members) {
  cudaDeviceProp properties{};
  check(cudaGetDeviceProperties(&properties, 0), "asking for the properties of the device");
  members.text("device", properties.name);
  members.text("compute_capability", std::to_string(properties.major) + "." + std::to_string(properties.minor));
  int driver = 0;
  int runtime = 0;
  check(cudaDriverGetVersion(&driver), "asking for the version of the driver");
  check(cudaRuntimeGetVersion(&runtime), "asking for the version of the runtime");
  members.number("driver_cuda", driver);
  members.number("runtime_cuda", runtime);
  std::size_t free = 0;
  std::size_t total = 0;
  check(cudaMemGetInfo(&free, &total), "asking for free memory");
  members.number("memory_free_bytes", static_cast<double>(free));
  members.number("memory_total_bytes", static_cast<double>(total));
  const double clock = 1e3 * attribute(cudaDevAttrClockRate, "asking for the clock");
  members.number("multiprocessors", properties.multiProcessorCount);
  members.number("clock_hz", clock);
  members.number("cache_bytes", properties.l2CacheSize);
  members.number("peak_single_flops_per_second",
                 properties.multiProcessorCount * clock * flops_per_clock(properties.major, properties.minor));
}

void measure_copies(Members& members) {
  constexpr std::size_t bytes = 256UL << 20;
  void* pinned = nullptr;
  void* from = nullptr;
  void* to = nullptr;
  check(cudaMallocHost(&pinned, bytes), "taking memory of the host");
  check(cudaMalloc(&from, bytes), "taking memory of the device");
  check(cudaMalloc(&to, bytes), "taking memory of the device");
  std::memset(pinned, 1, bytes);
  const auto rate = [&](const char* name, void* target, const void* source, cudaMemcpyKind kind, double moved) {
    const double seconds = seconds_of([&] {
      check(cudaMemcpyAsync(target, source, bytes, kind), name);
      check(cudaDeviceSynchronize(), name);
    });
    members.number(name, moved / seconds);
  };
  constexpr auto once = static_cast<double>(bytes);
  rate("to_device_bytes_per_second", from, pinned, cudaMemcpyHostToDevice, once);
  rate("from_device_bytes_per_second", pinned, from, cudaMemcpyDeviceToHost, once);
  // Each byte is read and written.
  rate("on_device_bytes_per_second", to, from, cudaMemcpyDeviceToDevice, 2.0 * once);
  check(cudaFree(to), "giving memory back");
  check(cudaFree(from), "giving memory back");
  check(cudaFreeHost(pinned), "giving memory back");
}

void measure_launches(Members& members) {
  constexpr int launches = 1000;
  const auto start = [] {
    do_nothing<<<1, 32>>>();
    check(cudaPeekAtLastError(), "starting a kernel");
  };
  const double apart = seconds_of([&] {
    for (int n = 0; n < launches; ++n) {
      start();
      check(cudaDeviceSynchronize(), "waiting for a kernel");
    }
  });
  const double together = seconds_of([&] {
    for (int n = 0; n < launches; ++n) start();
    check(cudaDeviceSynchronize(), "waiting for kernels");
  });
  members.number("launch_us", 1e6 * together / launches);
  members.number("launch_and_wait_us", 1e6 * apart / launches);
}

void emulate(Members& members) {
  members.text("device", "the host, for a test");
  constexpr std::size_t bytes = 32UL << 20;
  std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes, 0);
  const double seconds = seconds_of([&] { std::memcpy(to.data(), from.data(), bytes); });
  members.number("on_device_bytes_per_second", 2.0 * static_cast<double>(bytes) / seconds + 0.0 * to[bytes / 2]);
}

}  // namespace

int main() {
  Members members;
  const char* const wanted = std::getenv("MESOGEN_CUDA_ON_HOST");
  const bool emulated = wanted != nullptr && std::strcmp(wanted, "1") == 0;
  members.truth("emulated", emulated);
  if (emulated) {
    emulate(members);
    members.print();
    return 0;
  }
  int devices = 0;
  const cudaError_t status = cudaGetDeviceCount(&devices);
  if (status != cudaSuccess || devices == 0) {
    members.text("problem", status == cudaSuccess ? "none was found" : cudaGetErrorString(status));
    members.print();
    return skipped;
  }
  describe(members);
  measure_copies(members);
  measure_launches(members);
  members.print();
  return 0;
}
