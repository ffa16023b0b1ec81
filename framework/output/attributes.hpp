#pragma once

#include <optional>
#include <string>

#include "mesogen/fields/rank.hpp"
#include "output/hdf5.hpp"

/// What a dataset of results says of its values.
namespace mesogen::output {

/// Attribute `unit`, spelled as H5MD does; `unit_text` as it is where it is no SI unit.
void write_unit(const hdf5::Id& dataset, const std::string& unit);
/// The unit, as H5MD spells it where it can be; "1" if nothing is said.
std::string read_unit(const hdf5::Id& dataset);
/// As read_unit would give it back.
std::string stored_unit(const std::string& unit);

/// Attribute `rank`, where it is known: what the components mean.
void write_rank(const hdf5::Id& dataset, std::optional<Rank> rank);
std::optional<Rank> read_rank(const hdf5::Id& dataset);

}  // namespace mesogen::output
