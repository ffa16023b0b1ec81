#pragma once

#include "output/hdf5.hpp"
#include "output/results_content.hpp"

/// results.h5 as a file.
namespace mesogen::output {

/// How the particle values are stored.
enum class Layout {
  views,   ///< virtual datasets over the files of the frames
  packed,  ///< in results.h5 itself
};

/// Everything but packed values: those datasets are made, but left unwritten.
void write_structure(const hdf5::Id& file, const ResultsOptions& options, const ResultsContent& content, Layout layout);

/// particles/fluid/velocity/value
std::string value_name(const FieldShape& field);
/// Frames x particles, or frames x particles x components.
hdf5::Dimensions value_dimensions(const FieldShape& field, std::size_t frames, std::size_t particles);

/// The group of a packed results.h5 that ParaView reads of a frame: xdmf/000012
std::string packed_shown_group(std::size_t frame);

struct StoredResults {
  ResultsContent content;
  Layout layout = Layout::views;
};

/// Throws Error(bad_case), "cannot <purpose> ...", if the folder's results.h5 cannot be read or is of another run.
StoredResults read_results(const ResultsOptions& options, const std::string& purpose);

/// Throws Error(bad_case) unless the file of every frame is there and is the one that results.h5 means.
void check_frames(const ResultsOptions& options, const std::vector<FrameStamp>& frames);

/// Replaces results.h5 and its frames by one packed file. Throws Error(run_failed).
void pack(const ResultsOptions& options, const ResultsContent& content);

/// Writes the frames in `content` of a packed results.h5 to files again. Throws Error(run_failed).
void unpack(const ResultsOptions& options, const ResultsContent& content);

}  // namespace mesogen::output
