#pragma once

#include "output/hdf5.hpp"
#include "output/run_record.hpp"

/// Records of a run in its files: results.h5 (under /parameters) and checkpoints have them alike, as groups of
/// attributes.
namespace mesogen::output {

void write_cost(const hdf5::Id& parent, const RunCost& cost);
RunCost read_cost(const hdf5::Id& parent);

void write_origin(const hdf5::Id& parent, const BranchOrigin& origin);
BranchOrigin read_origin(const hdf5::Id& parent);
bool has_origin(const hdf5::Id& parent);

void write_end_records(const hdf5::Id& parent, const EndRecords& records);
EndRecords read_end_records(const hdf5::Id& parent);

}  // namespace mesogen::output
