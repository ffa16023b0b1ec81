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

int current_device() {
  int device = 0;
  check(cudaGetDevice(&device), "asking which device is current");
  return device;
}

int attribute(cudaDeviceAttr which, const char* what) {
  int value = 0;
  check(cudaDeviceGetAttribute(&value, which, current_device()), what);
  return value;
}

/// Additions and multiplications in single precision that a multiprocessor does per clock: one fused pair per lane.
double flops_per_clock(int major, int minor) { return 2.0 * (major == 8 && minor == 0 ? 64 : 128); }

void describe(Members& members) {
  cudaDeviceProp properties{};
  check(cudaGetDeviceProperties(&properties, current_device()), "asking for the properties of the device");
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

/// A kernel as short as one over few particles; `turns` makes two launches differ, as those of two steps do.
__global__ void work_shortly(float* value, int turns) {
  float all = *value;
  for (int n = 0; n < turns; ++n) all = all * 0.5F + 1.0F;
  *value = all;
}

/// The kernels of one step, three ways: started one by one; gathered to a graph that is brought up to date each time,
/// as the passes of a step would need, because their arguments (step size, time) change; and that graph once more as
/// it is. A step waits once, at its end. A graph pays where the second is shorter than the first.
void measure_steps(Members& members) {
  constexpr int kernels = 30;
  constexpr int steps = 200;
  cudaStream_t stream = nullptr;
  check(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "making a stream");
  float* value = nullptr;
  check(cudaMalloc(&value, sizeof(float)), "taking memory of the device");
  check(cudaMemsetAsync(value, 0, sizeof(float), stream), "zeroing memory of the device");
  const auto start = [&](int step) {
    for (int n = 0; n < kernels; ++n) work_shortly<<<1, 32, 0, stream>>>(value, 100 + step % 2);
    check(cudaPeekAtLastError(), "starting the kernels of a step");
  };
  const auto gather = [&](int step) {
    cudaGraph_t graph = nullptr;
    check(cudaStreamBeginCapture(stream, cudaStreamCaptureModeRelaxed), "gathering kernels");
    start(step);
    check(cudaStreamEndCapture(stream, &graph), "gathering kernels");
    return graph;
  };
  cudaGraphExec_t ready = nullptr;
  cudaGraph_t first = gather(0);
  check(cudaGraphInstantiate(&ready, first, 0), "making a graph");
  check(cudaGraphDestroy(first), "giving a graph back");
  const auto measure = [&](const char* name, const auto& begin_step) {
    const double seconds = seconds_of([&] {
      for (int step = 0; step < steps; ++step) {
        begin_step(step);
        check(cudaStreamSynchronize(stream), "waiting for a step");
      }
    });
    members.number(name, 1e6 * seconds / steps);
  };
  measure("step_of_30_kernels_us", start);
  measure("step_of_30_kernels_in_a_graph_us", [&](int step) {
    cudaGraph_t graph = gather(step);
    cudaGraphExecUpdateResultInfo result{};
    check(cudaGraphExecUpdate(ready, graph, &result), "bringing a graph up to date");
    check(cudaGraphDestroy(graph), "giving a graph back");
    check(cudaGraphLaunch(ready, stream), "starting a graph");
  });
  measure("step_of_30_kernels_in_an_unchanged_graph_us",
          [&](int /*step*/) { check(cudaGraphLaunch(ready, stream), "starting a graph"); });
  check(cudaGraphExecDestroy(ready), "giving a graph back");
  check(cudaFree(value), "giving memory back");
  check(cudaStreamDestroy(stream), "giving a stream back");
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
  measure_steps(members);
  members.print();
  return 0;
}
