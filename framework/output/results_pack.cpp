#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <functional>

#include "mesogen/diagnostics/error.hpp"
#include "output/frame_file.hpp"
#include "output/results_file.hpp"
#include "output/run_folder.hpp"
#include "output/shown_fields.hpp"
#include "output/write_file.hpp"

namespace mesogen::output {

namespace {

using hdf5::Id;

/// One frame of one field, from its own file into its place in the packed one, as it is stored.
template <class Real>
void copy_frame(const Id& frame, const Id& packed, const FieldShape& field, const hdf5::Dimensions& sizes,
                std::size_t number) {
  std::size_t values = 1;
  for (std::size_t axis = 1; axis < sizes.size(); ++axis) values *= sizes[axis];
  const std::vector<Real> buffer = hdf5::read<Real>(frame, field.name, values);
  const Id memory = hdf5::dataspace({values});
  hdf5::check(H5Dwrite(packed.get(), hdf5::memory_type<Real>(), memory.get(), hdf5::slice(sizes, number).get(),
                       H5P_DEFAULT, buffer.data()),
              "write " + field.name);
}

/// What ParaView reads of one frame, over the packed values; `stored` gives the frame's.
void write_shown_of(const Id& file, const ResultsOptions& options, const ResultsContent& content, std::size_t number,
                    const std::function<std::vector<double>(const FieldShape&)>& stored) {
  write_shown(file, packed_shown_group(number), shown_fields(content.fields, options.dimension),
              static_cast<std::size_t>(options.count), options.dimension,
              {.dataset = value_name, .frames = content.frames.size(), .frame = number}, stored);
}

void fill(const Id& file, const ResultsOptions& options, const ResultsContent& content) {
  const auto particles = static_cast<std::size_t>(options.count);
  for (std::size_t number = 0; number < content.frames.size(); ++number) {
    const Id frame = hdf5::open_file(options.folder / frame_name(number));
    for (const FieldShape& field : content.fields) {
      const Id packed = hdf5::open_dataset(file, value_name(field));
      const hdf5::Dimensions sizes = value_dimensions(field, content.frames.size(), particles);
      switch (field.type) {
        case NumberType::float64: copy_frame<double>(frame, packed, field, sizes, number); break;
        case NumberType::float32: copy_frame<float>(frame, packed, field, sizes, number); break;
        case NumberType::int32: copy_frame<std::int32_t>(frame, packed, field, sizes, number); break;
      }
    }
    write_shown_of(file, options, content, number, [&](const FieldShape& field) {
      return hdf5::read<double>(hdf5::open_dataset(frame, field.name), field.name);
    });
  }
}

/// What the packed file can have at most, bytes.
std::uint64_t largest_size(const ResultsOptions& options, const ResultsContent& content) {
  const Id structure = hdf5::create_in_memory();
  write_structure(structure, options, content, Layout::views);
  constexpr std::uint64_t spare = std::uint64_t{1} << 16;  // for how HDF5 groups what it stores
  std::uint64_t size = hdf5::image(structure).size() + spare;
  for (const FieldShape& field : content.fields) {
    std::uint64_t bytes = H5Tget_size(stored_type_of(field));
    for (const hsize_t n : value_dimensions(field, content.frames.size(), static_cast<std::size_t>(options.count)))
      bytes *= n;
    size += bytes;
  }
  if (content.frames.empty()) return size;
  // Each takes as much room alone as among others, or more.
  const Id shown = hdf5::create_in_memory();
  write_shown_of(shown, options, content, 0, [&](const FieldShape& field) {
    return std::vector<double>(static_cast<std::size_t>(options.count) * static_cast<std::size_t>(field.components));
  });
  return size + content.frames.size() * hdf5::image(shown).size();
}

}  // namespace

std::string packed_shown_group(std::size_t frame) { return fmt::format("{}/{:06}", shown_group, frame); }

void pack(const ResultsOptions& options, const ResultsContent& content) {
  const std::filesystem::path path = options.folder / "results.h5";
  try {
    // HDF5 cannot even close a file that it has no room to complete, so the room is taken before it begins.
    const std::uint64_t room = largest_size(options, content);
    write_unfinished(path, hdf5::image(hdf5::create_in_memory()), room);
    hdf5::Id file = hdf5::open_to_write(temporary_name(path));
    write_structure(file, options, content, Layout::packed);
    fill(file, options, content);
    file.close();
  } catch (const hdf5::Failure& failure) {
    ::unlink(temporary_name(path).c_str());
    throw Error(ExitCode::run_failed, "cannot pack the results into " + path.string() + ": " + failure.what() +
                                          "; all frames are safe and readable as they are: mend this, then "
                                          "`mesogen resume` packs them");
  }
  put_in_place(path);
}

void unpack(const ResultsOptions& options, const ResultsContent& content) {
  const std::filesystem::path path = options.folder / "results.h5";
  try {
    const Id file = hdf5::open_file(path);
    for (std::size_t number = 0; number < content.frames.size(); ++number) {
      std::vector<FrameField> fields;
      for (const FieldShape& field : content.fields) {
        const Id packed = hdf5::open_dataset(file, value_name(field));
        const hdf5::Dimensions sizes = hdf5::dimensions_of(packed);
        FrameField& values =
            fields.emplace_back(FrameField{field.name, field.unit, field.components, {}, field.type, field.rank});
        values.values.resize(static_cast<std::size_t>(options.count) * static_cast<std::size_t>(field.components));
        const Id memory = hdf5::dataspace({values.values.size()});
        hdf5::check(H5Dread(packed.get(), H5T_NATIVE_DOUBLE, memory.get(), hdf5::slice(sizes, number).get(),
                            H5P_DEFAULT, values.values.data()),
                    "read " + field.name);
      }
      write_frame(options.folder / frame_name(number), fields, content.frames[number], options.dimension);
    }
  } catch (const hdf5::Failure& failure) {
    throw Error(ExitCode::run_failed, "cannot unpack " + path.string() + ": " + failure.what());
  }
}

}  // namespace mesogen::output
