#include "output/frame.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "mesogen/diagnostics/error.hpp"
#include "output/frame_file.hpp"
#include "output/hdf5.hpp"
#include "output/write_file.hpp"

namespace mesogen::output {

std::string frame_name(std::size_t number) { return fmt::format("frames/{:06}.h5", number); }

hid_t stored_type_of(const FieldShape& field) {
  switch (field.type) {
    case NumberType::float64: return hdf5::stored_type<double>();
    case NumberType::float32: return hdf5::stored_type<float>();
    case NumberType::int32: return hdf5::stored_type<std::int32_t>();
  }
  throw std::logic_error("a type that no frame has");
}

std::vector<std::uint64_t> frame_dimensions(const FieldShape& field, std::size_t particles) {
  if (field.components == 1) return {particles};
  return {particles, static_cast<std::uint64_t>(field.components)};
}

std::vector<std::byte> encode_frame(const std::vector<FrameField>& fields, const FrameStamp& stamp) {
  const hdf5::Id memory = hdf5::create_in_memory();
  hdf5::write_attribute(memory, "step", stamp.step);
  hdf5::write_attribute(memory, "time", stamp.time);
  for (const FrameField& field : fields) {
    const FieldShape shape{field.name, field.unit, field.components, field.type};
    const std::size_t particles = field.values.size() / static_cast<std::size_t>(field.components);
    const std::vector<std::uint64_t> sizes = frame_dimensions(shape, particles);
    const hdf5::Id dataset =
        hdf5::write(memory, field.name, {sizes.begin(), sizes.end()}, field.values, stored_type_of(shape));
    hdf5::write_attribute(dataset, "unit", field.unit);
  }
  return hdf5::image(memory);
}

void write_frame(const std::filesystem::path& file, const std::vector<FrameField>& fields, const FrameStamp& stamp) {
  std::vector<std::byte> bytes;
  try {
    bytes = encode_frame(fields, stamp);
  } catch (const hdf5::Failure& failure) {
    throw Error(ExitCode::run_failed, "cannot make the frame " + file.string() + ": " + failure.what());
  }
  write_file(file, bytes);
}

FrameStamp read_stamp(const hdf5::Id& frame) {
  return {hdf5::read_attribute<std::int64_t>(frame, "step"), hdf5::read_attribute<double>(frame, "time")};
}

}  // namespace mesogen::output
