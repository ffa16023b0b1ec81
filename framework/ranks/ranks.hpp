#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesogen/exec/sharing.hpp"
#include "mesogen/export.hpp"

namespace mesogen {

/// The processes that share a run, each with a part of the particles. All of them call the same functions in the same
/// order, and each call waits for the others. A run on one process has the one rank alone().
class MESOGEN_EXPORT Ranks : public exec::Sharing {
 public:
  ~Ranks() override;

  [[nodiscard]] virtual int rank() const = 0;
  [[nodiscard]] virtual int count() const = 0;
  /// Are there others?
  [[nodiscard]] bool several() const { return count() > 1; }
  /// The first rank alone writes files, and speaks.
  [[nodiscard]] bool is_first() const { return rank() == 0; }

  /// Element by element the largest of all ranks. None may be below zero; what is not a number is the largest of all.
  virtual void largest(std::span<double> numbers) const = 0;
  /// All ranks get what the first has.
  virtual void broadcast(std::span<std::byte> bytes) const = 0;
  /// Rank r gets numbers[r] of every rank, in their order.
  [[nodiscard]] virtual std::vector<std::int64_t> swap(std::span<const std::int64_t> numbers) const = 0;

  struct Outgoing {
    int to;
    std::span<const std::byte> bytes;
  };
  struct Incoming {
    int from;
    std::span<std::byte> bytes;
  };
  /// Sends messages and receives others. Both sides know their lengths; of several between the same two ranks, the
  /// order counts.
  virtual void exchange(std::span<const Outgoing> outgoing, std::span<const Incoming> incoming) const = 0;

  /// What this rank sent, and how long it was in the functions above: mostly waiting for others.
  struct Traffic {
    std::int64_t messages = 0;
    std::int64_t bytes = 0;
    double seconds = 0.0;
  };
  [[nodiscard]] virtual Traffic traffic() const { return {}; }

  /// Ends the processes of all ranks.
  [[noreturn]] virtual void abort(int exit_status) const = 0;

  static const Ranks& alone();
};

/// The values of all ranks in their order, at the first rank; nothing at others.
template <class T>
std::vector<T> gather(const Ranks& ranks, std::span<const T> own) {
  std::vector<std::int64_t> to(static_cast<std::size_t>(ranks.count()), 0);
  to.front() = static_cast<std::int64_t>(own.size());
  const std::vector<std::int64_t> lengths = ranks.swap(to);
  std::size_t total = 0;
  for (const std::int64_t length : lengths) total += static_cast<std::size_t>(length);
  std::vector<T> all(total);
  std::vector<Ranks::Incoming> incoming;
  std::size_t begin = 0;
  for (int from = 0; from < ranks.count(); ++from) {
    const auto length = static_cast<std::size_t>(lengths[static_cast<std::size_t>(from)]);
    if (length > 0) incoming.push_back({from, std::as_writable_bytes(std::span(all).subspan(begin, length))});
    begin += length;
  }
  std::vector<Ranks::Outgoing> outgoing;
  if (!own.empty()) outgoing.push_back({0, std::as_bytes(own)});
  ranks.exchange(outgoing, incoming);
  return all;
}

/// What the rank says whose number is the largest (at or above 0), the first of those that have the same: on all ranks.
MESOGEN_EXPORT std::string text_of_worst(const Ranks& ranks, double number, const std::string& text);

/// Is it the same text on all ranks?
MESOGEN_EXPORT bool same_on_all(const Ranks& ranks, const std::string& text);

/// Is it so on any rank?
inline bool any(const Ranks& ranks, bool here) {
  if (!ranks.several()) return here;
  double number = here ? 1.0 : 0.0;
  ranks.largest(std::span(&number, 1));
  return number > 0.0;
}

}  // namespace mesogen
