#include "output/stored_frames.hpp"

#include <algorithm>
#include <optional>

#include "mesogen/diagnostics/error.hpp"
#include "output/frame_file.hpp"
#include "output/results_file.hpp"

namespace mesogen {

/// results.h5 if it holds the values itself.
struct StoredFrames::Source {
  std::optional<hdf5::Id> packed;
};

StoredFrames::StoredFrames(const ResultsOptions& options)
    : folder_(options.folder),
      particles_(static_cast<std::size_t>(options.count)),
      source_(std::make_unique<Source>()) {
  output::StoredResults stored = output::read_results(options, "read");
  fields_ = std::move(stored.content.fields);
  stamps_ = std::move(stored.content.frames);
  if (stored.layout == output::Layout::packed && !fields_.empty())
    source_->packed = hdf5::open_file(folder_ / "results.h5");
}

StoredFrames::~StoredFrames() = default;

const output::FieldShape* StoredFrames::find(const std::string& field) const {
  const auto at = std::ranges::find(fields_, field, &output::FieldShape::name);
  return at == fields_.end() ? nullptr : &*at;
}

std::vector<double> StoredFrames::read(std::size_t frame, const output::FieldShape& field) const {
  const std::size_t size = particles_ * static_cast<std::size_t>(field.components);
  const std::filesystem::path path = folder_ / (source_->packed ? "results.h5" : output::frame_name(frame));
  try {
    if (!source_->packed) {
      // Not through the views of results.h5: a frame that is gone would read as NaN.
      const hdf5::Id file = hdf5::open_file(path);
      if (output::read_stamp(file) != stamp(frame)) throw hdf5::Failure("it is of another step");
      return hdf5::read<double>(file, field.name, size);
    }
    const hdf5::Id values = hdf5::open_dataset(*source_->packed, output::value_name(field));
    std::vector<double> buffer(size);
    hdf5::check(H5Dread(values.get(), H5T_NATIVE_DOUBLE, hdf5::dataspace({size}).get(),
                        hdf5::slice(hdf5::dimensions_of(values), frame).get(), H5P_DEFAULT, buffer.data()),
                "read " + field.name);
    return buffer;
  } catch (const hdf5::Failure& failure) {
    throw Error(ExitCode::bad_case, "cannot read the frame of step " + std::to_string(stamp(frame).step) + " from " +
                                        path.string() + ": " + failure.what());
  }
}

}  // namespace mesogen
