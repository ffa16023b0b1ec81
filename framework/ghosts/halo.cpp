#include "ghosts/halo.hpp"

#include <algorithm>
#include <numeric>

#include "particles/storage_loops.hpp"

namespace mesogen {

namespace {

constexpr auto device = exec::Side::device;

/// Does an image of the box lie off along that axis, so that a row of particles is seen in several rows?
bool shears_along(const Images& images, int axis) {
  for (int image = 0; image < images.count; ++image)
    if (images.shear[image][axis] != 0.0) return true;
  return false;
}

}  // namespace

Halo::Halo(const Ranks& ranks, const Backend& backend)
    : ranks_(ranks),
      backend_(backend),
      place_(backend.memory()),
      given_(static_cast<std::size_t>(ranks.count()) + 1, 0),
      got_(given_),
      position_(exec::axis_arrays<double>(backend.memory())),
      single_(backend.memory()),
      double_(backend.memory()) {}

void Halo::find(const Parts& parts, const ImageSearch& own, const exec::Array<Index>& cell_of, int reach,
                std::span<const std::int64_t> own_ids) {
  const auto cell = cell_of.host();
  const bool any_row = shears_along(own.images, parts.axis());
  std::vector<Index> places;
  std::vector<std::int64_t> number(static_cast<std::size_t>(ranks_.count()), 0);
  for (int rank = 0; rank < ranks_.count(); ++rank) {
    if (rank != ranks_.rank()) {
      ImageSearch search = own;
      search.own = 0;  // to them these are others
      std::ranges::copy(own.of_own, search.of_others);
      search.slab = parts.slab(rank, reach);
      for (std::size_t i = 0; i < cell.size(); ++i) {
        const bool near = any_row || parts.sees_wrapped(rank, reach, parts.row_of(cell[i]));
        if (near && search.count(static_cast<Index>(i)) > 0) places.push_back(static_cast<Index>(i));
      }
    }
    const auto at = static_cast<std::size_t>(rank);
    given_[at + 1] = places.size();
    number[at] = static_cast<std::int64_t>(given_[at + 1] - given_[at]);
  }
  place_.assign(places);
  const std::vector<std::int64_t> from = ranks_.swap(number);
  std::partial_sum(from.begin(), from.end(), got_.begin() + 1);
  for (exec::Array<double>& axis : position_) axis.resize_for_overwrite(got_.back());
  std::vector<std::int64_t> sent;
  for (const Index place : places) sent.push_back(own_ids[static_cast<std::size_t>(place)]);
  ids_.resize(got_.back());
  exchange<std::int64_t>(sent, ids_, 1);
}

namespace {

/// Calls action(rank, place of its first, how many) for each rank that has some.
template <class Action>
void for_parts(const std::vector<std::size_t>& begin, const Action& action) {
  for (std::size_t rank = 0; rank + 1 < begin.size(); ++rank)
    if (const std::size_t length = begin[rank + 1] - begin[rank]; length > 0) action(rank, begin[rank], length);
}

}  // namespace

template <class T>
void Halo::exchange(std::span<const T> out, std::span<T> in, std::size_t components) {
  std::vector<Ranks::Outgoing> outgoing;
  std::vector<Ranks::Incoming> incoming;
  for_parts(given_, [&](std::size_t rank, std::size_t begin, std::size_t length) {
    outgoing.push_back({static_cast<int>(rank), std::as_bytes(out.subspan(components * begin, components * length))});
  });
  for_parts(got_, [&](std::size_t rank, std::size_t begin, std::size_t length) {
    incoming.push_back(
        {static_cast<int>(rank), std::as_writable_bytes(in.subspan(components * begin, components * length))});
  });
  ranks_.exchange(outgoing, incoming);
  bytes_sent_ += static_cast<std::int64_t>(out.size_bytes());
}

// A message holds the values of a rank's particles component by component.
template <class Real>
void Halo::swap(std::span<const Real* const> from, std::span<Real* const> to) {
  const exec::StorageLoops& loops = backend_.storage();
  const std::size_t components = from.size();
  Buffers<Real>& buffers = this->buffers<Real>();
  buffers.out.resize_for_overwrite(components * given_.back());
  buffers.in.resize_for_overwrite(components * got_.back());
  Real* const packed = buffers.out.device(exec::Access::write);
  const Index* const place = place_.device();
  for_parts(given_, [&](std::size_t, std::size_t begin, std::size_t length) {
    for (std::size_t c = 0; c < components; ++c)
      loops.gather(from[c], place + begin, static_cast<Index>(length), packed + components * begin + c * length);
  });
  exchange<Real>(buffers.out.host(), buffers.in.host(exec::Access::write), components);
  const Real* const came = std::as_const(buffers.in).device();
  for_parts(got_, [&](std::size_t, std::size_t begin, std::size_t length) {
    for (std::size_t c = 0; c < components; ++c)
      loops.copy(came + components * begin + c * length, to[c] + begin, static_cast<Index>(length));
  });
}

void Halo::bring_positions(const exec::AxisArrays<double>& own, int dimension) {
  const auto from = exec::pointers(own, device);
  std::array<double*, 3> to{};
  for (std::size_t d = 0; d < 3; ++d) to[d] = position_[d].device(exec::Access::write);
  const auto axes = static_cast<std::size_t>(dimension);
  swap<double>(std::span(from).first(axes), std::span(to).first(axes));
}

template <class Real>
void Halo::bring(FieldView<Real> field, int components, Index first) {
  std::vector<const Real*> from;
  std::vector<Real*> to;
  for (int c = 0; c < components; ++c) {
    from.push_back(field.component(c));
    to.push_back(field.component(c) + first);
  }
  swap<Real>(from, to);
}
template void Halo::bring(FieldView<float>, int, Index);
template void Halo::bring(FieldView<double>, int, Index);

}  // namespace mesogen
