#pragma once

#include <cstdint>
#include <vector>

#include "output/frame.hpp"
#include "output/hdf5.hpp"

/// What else the writers of results need to know of a frame's file.
namespace mesogen::output {

/// The group of a frame's file that ParaView reads.
inline constexpr const char* shown_group = "xdmf";

/// Of a field as results have it.
FieldShape shape_of(const FrameField& field);
hid_t stored_type_of(const FieldShape& field);
/// Particles, or particles x components.
std::vector<std::uint64_t> frame_dimensions(const FieldShape& field, std::size_t particles);
FrameStamp read_stamp(const hdf5::Id& frame);

}  // namespace mesogen::output
