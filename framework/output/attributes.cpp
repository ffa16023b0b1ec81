#include "output/attributes.hpp"

#include "output/h5md_unit.hpp"

namespace mesogen::output {

void write_unit(const hdf5::Id& dataset, const std::string& unit) {
  const auto spelled = h5md_unit(unit);
  hdf5::write_attribute(dataset, spelled ? "unit" : "unit_text", spelled.value_or(unit));
}

std::string read_unit(const hdf5::Id& dataset) {
  for (const char* const name : {"unit", "unit_text"})
    if (hdf5::has_attribute(dataset, name)) return stored_unit(hdf5::read_text_attribute(dataset, name));
  return "1";
}

std::string stored_unit(const std::string& unit) { return h5md_unit(unit).value_or(unit); }

void write_rank(const hdf5::Id& dataset, std::optional<Rank> rank) {
  if (rank) hdf5::write_attribute(dataset, "rank", std::string(to_string(*rank)));
}

std::optional<Rank> read_rank(const hdf5::Id& dataset) {
  if (!hdf5::has_attribute(dataset, "rank")) return {};
  const std::string text = hdf5::read_text_attribute(dataset, "rank");
  for (const Rank rank : {Rank::scalar, Rank::vector, Rank::order_tensor, Rank::matrix})
    if (text == to_string(rank)) return rank;
  throw hdf5::Failure("'" + text + "' is no rank of a field");
}

}  // namespace mesogen::output
