#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "ranks/ranks.hpp"

namespace mesogen {

/// Elements of arrays that go to other ranks, and what comes from there. After it an array holds those that stayed, in
/// their order, and then those that came, in the order of the ranks that they came from.
class MESOGEN_EXPORT Journey {
 public:
  /// `owner`: the rank to which each element goes. All ranks make theirs together.
  Journey(const Ranks& ranks, std::span<const int> owner);

  /// Does any element on any rank go anywhere?
  [[nodiscard]] bool anybody() const { return anybody_; }
  /// How many elements there are then.
  [[nodiscard]] std::size_t size() const { return staying_.size() + came_.back(); }

  /// The array after the journey.
  template <class T>
  [[nodiscard]] std::vector<T> carry(std::span<const T> values) const {
    std::vector<T> after(size());
    for (std::size_t n = 0; n < staying_.size(); ++n) after[n] = values[staying_[n]];
    std::vector<T> sent(leaving_.size());
    for (std::size_t n = 0; n < sent.size(); ++n) sent[n] = values[leaving_[n]];
    swap<T>(sent, left_, std::span(after).subspan(staying_.size()), came_);
    return after;
  }
  /// The array before the journey, from one after it.
  template <class T>
  [[nodiscard]] std::vector<T> bring_back(std::span<const T> values) const {
    std::vector<T> before(staying_.size() + leaving_.size());
    std::vector<T> returned(leaving_.size());
    swap<T>(values.subspan(staying_.size()), came_, returned, left_);
    for (std::size_t n = 0; n < staying_.size(); ++n) before[staying_[n]] = values[n];
    for (std::size_t n = 0; n < leaving_.size(); ++n) before[leaving_[n]] = returned[n];
    return before;
  }

 private:
  template <class T>
  void swap(std::span<const T> sent, const std::vector<std::size_t>& sent_begin, std::span<T> got,
            const std::vector<std::size_t>& got_begin) const {
    std::vector<Ranks::Outgoing> outgoing;
    std::vector<Ranks::Incoming> incoming;
    for (int rank = 0; rank < ranks_.count(); ++rank) {
      const auto at = static_cast<std::size_t>(rank);
      const auto part = [at](auto all, const std::vector<std::size_t>& begin) {
        return all.subspan(begin[at], begin[at + 1] - begin[at]);
      };
      if (sent_begin[at + 1] > sent_begin[at]) outgoing.push_back({rank, std::as_bytes(part(sent, sent_begin))});
      if (got_begin[at + 1] > got_begin[at]) incoming.push_back({rank, std::as_writable_bytes(part(got, got_begin))});
    }
    ranks_.exchange(outgoing, incoming);
  }

  const Ranks& ranks_;
  bool anybody_ = false;
  std::vector<std::size_t> staying_;
  std::vector<std::size_t> leaving_;  // by rank
  std::vector<std::size_t> left_;     // where those of each rank begin among them, one more at the end
  std::vector<std::size_t> came_;     // likewise of those that come
};

}  // namespace mesogen
