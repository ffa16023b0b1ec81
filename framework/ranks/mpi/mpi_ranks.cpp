// libmesogen_mpi: the ranks of a run by MPI. Only the main thread calls it.

#include <mpi.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "mesogen/diagnostics/error.hpp"
#include "ranks/mpi_library.hpp"

namespace mesogen {

namespace {

// MPI counts in int.
constexpr std::size_t most_bytes = std::size_t{1} << 30;

void check(int result, const char* what) {
  if (result == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING];
  int length = 0;
  MPI_Error_string(result, text, &length);
  throw Error(ExitCode::run_failed, std::string("MPI failed at ") + what + ": " + std::string(text, text + length));
}

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int provided = 0;
    check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "the start");
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    check(MPI_Comm_rank(MPI_COMM_WORLD, &rank_), "the start");
    check(MPI_Comm_size(MPI_COMM_WORLD, &count_), "the start");
    if (provided < MPI_THREAD_FUNNELED)
      throw Error(ExitCode::run_failed, "this MPI takes no programs with threads: install one that does");
  }
  ~MpiRanks() override { MPI_Finalize(); }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  [[nodiscard]] int rank() const override { return rank_; }
  [[nodiscard]] int count() const override { return count_; }

  // As the integers of their bits, which are in the same order: what is not a number comes last.
  void largest(std::span<double> numbers) const override {
    static_assert(sizeof(double) == sizeof(std::uint64_t));
    const Timed timed(traffic_, 1, numbers.size_bytes());
    std::vector<std::uint64_t> bits(numbers.size());
    std::memcpy(bits.data(), numbers.data(), numbers.size_bytes());
    for (std::uint64_t& number : bits) number &= ~(std::uint64_t{1} << 63U);  // of -0
    check(MPI_Allreduce(MPI_IN_PLACE, bits.data(), as_int(bits.size()), MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD),
          "finding the largest of all ranks");
    std::memcpy(numbers.data(), bits.data(), numbers.size_bytes());
  }
  void add(std::span<double> numbers) const override { add_in_order(numbers); }
  void add(std::span<float> numbers) const override { add_in_order(numbers); }
  void add(std::span<std::int64_t> numbers) const override {
    const Timed timed(traffic_, 1, numbers.size_bytes());
    check(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), as_int(numbers.size()), MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD),
          "a sum over all ranks");
  }
  void broadcast(std::span<std::byte> bytes) const override {
    const Timed timed(traffic_, 1, rank_ == 0 ? bytes.size() : 0);
    for (std::size_t begin = 0; begin < bytes.size(); begin += most_bytes)
      check(MPI_Bcast(bytes.data() + begin, as_int(std::min(most_bytes, bytes.size() - begin)), MPI_BYTE, 0,
                      MPI_COMM_WORLD),
            "a message to all ranks");
  }
  [[nodiscard]] std::vector<std::int64_t> swap(std::span<const std::int64_t> numbers) const override {
    std::vector<std::int64_t> got(static_cast<std::size_t>(count_));
    const Timed timed(traffic_, 1, numbers.size_bytes());
    check(MPI_Alltoall(numbers.data(), 1, MPI_INT64_T, got.data(), 1, MPI_INT64_T, MPI_COMM_WORLD),
          "telling the lengths of messages");
    return got;
  }
  void exchange(std::span<const Outgoing> outgoing, std::span<const Incoming> incoming) const override {
    std::vector<MPI_Request> requests;
    std::size_t sent = 0;
    for (const Outgoing& one : outgoing) sent += one.bytes.size();
    const Timed timed(traffic_, outgoing.size(), sent);
    const auto in_parts = [](auto bytes, const auto& action) {
      for (std::size_t begin = 0; begin < bytes.size(); begin += most_bytes)
        action(bytes.data() + begin, as_int(std::min(most_bytes, bytes.size() - begin)));
    };
    for (const Incoming& one : incoming)
      in_parts(one.bytes, [&](std::byte* at, int length) {
        requests.emplace_back();
        check(MPI_Irecv(at, length, MPI_BYTE, one.from, 0, MPI_COMM_WORLD, &requests.back()), "receiving a message");
      });
    for (const Outgoing& one : outgoing)
      in_parts(one.bytes, [&](const std::byte* at, int length) {
        requests.emplace_back();
        check(MPI_Isend(at, length, MPI_BYTE, one.to, 0, MPI_COMM_WORLD, &requests.back()), "sending a message");
      });
    check(MPI_Waitall(as_int(requests.size()), requests.data(), MPI_STATUSES_IGNORE), "waiting for messages");
  }
  [[nodiscard]] Traffic traffic() const override { return traffic_; }
  [[noreturn]] void abort(int exit_status) const override {
    MPI_Abort(MPI_COMM_WORLD, exit_status);
    std::abort();
  }

 private:
  /// Counts a call from its beginning to its end.
  class Timed {
   public:
    Timed(Traffic& traffic, std::size_t messages, std::size_t bytes) : traffic_(traffic) {
      traffic.messages += static_cast<std::int64_t>(messages);
      traffic.bytes += static_cast<std::int64_t>(bytes);
    }
    ~Timed() { traffic_.seconds += MPI_Wtime() - begin_; }
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

   private:
    Traffic& traffic_;
    double begin_ = MPI_Wtime();
  };

  // MPI_Allreduce may add in another order each time. Each rank adds up a section of the numbers, in the order of
  // ranks, and tells the others the sums.
  template <class Real>
  void add_in_order(std::span<Real> numbers) const {
    const auto ranks = static_cast<std::size_t>(count_);
    const auto section = [&](std::size_t rank) {
      const std::size_t begin = numbers.size() * rank / ranks;
      return numbers.subspan(begin, numbers.size() * (rank + 1) / ranks - begin);
    };
    const std::span<Real> own = section(static_cast<std::size_t>(rank_));
    std::vector<Real> from_all(own.size() * ranks);
    std::vector<Outgoing> outgoing;
    std::vector<Incoming> incoming;
    for (std::size_t rank = 0; rank < ranks; ++rank) {
      outgoing.push_back({static_cast<int>(rank), std::as_bytes(section(rank))});
      incoming.push_back(
          {static_cast<int>(rank), std::as_writable_bytes(std::span(from_all).subspan(own.size() * rank, own.size()))});
    }
    exchange(outgoing, incoming);
    for (std::size_t n = 0; n < own.size(); ++n) {
      Real sum = from_all[n];
      for (std::size_t rank = 1; rank < ranks; ++rank) sum += from_all[rank * own.size() + n];
      own[n] = sum;
    }
    outgoing.clear();
    incoming.clear();
    for (std::size_t rank = 0; rank < ranks; ++rank) {
      if (rank == static_cast<std::size_t>(rank_)) continue;
      outgoing.push_back({static_cast<int>(rank), std::as_bytes(own)});
      incoming.push_back({static_cast<int>(rank), std::as_writable_bytes(section(rank))});
    }
    exchange(outgoing, incoming);
  }
  static int as_int(std::size_t number) {
    if (number > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw Error(ExitCode::run_failed, "more numbers than MPI can count: take fewer ranks or particles");
    return static_cast<int>(number);
  }

  mutable Traffic traffic_;
  int rank_ = 0;
  int count_ = 1;
};

const Ranks* ranks() {
  static const MpiRanks all;
  return &all;
}

}  // namespace

}  // namespace mesogen

extern "C" MESOGEN_EXPORT const mesogen::MpiLibrary mesogen_mpi;
const mesogen::MpiLibrary mesogen_mpi{mesogen::mpi_library_magic, MESOGEN_MPI_BUILD, &mesogen::ranks};
