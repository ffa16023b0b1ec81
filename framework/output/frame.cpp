#include "output/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "mesogen/diagnostics/error.hpp"
#include "output/attributes.hpp"
#include "output/frame_file.hpp"
#include "output/hdf5.hpp"
#include "output/shown_fields.hpp"
#include "output/write_file.hpp"

namespace mesogen::output {

std::string frame_name(std::size_t number) { return fmt::format("frames/{:06}.h5", number); }

FieldShape shape_of(const FrameField& field) {
  return {field.name, stored_unit(field.unit), field.components, field.type, field.rank};
}

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

std::vector<std::byte> encode_frame(const std::vector<FrameField>& fields, const FrameStamp& stamp, int dimension) {
  const hdf5::Id memory = hdf5::create_in_memory();
  hdf5::write_attribute(memory, "step", stamp.step);
  hdf5::write_attribute(memory, "time", stamp.time);
  std::vector<FieldShape> shapes;
  std::size_t particles = 0;
  for (const FrameField& field : fields) {
    const FieldShape& shape = shapes.emplace_back(shape_of(field));
    particles = field.values.size() / static_cast<std::size_t>(field.components);
    const std::vector<std::uint64_t> sizes = frame_dimensions(shape, particles);
    const hdf5::Id dataset =
        hdf5::write(memory, field.name, {sizes.begin(), sizes.end()}, field.values, stored_type_of(shape));
    write_unit(dataset, field.unit);
  }
  write_shown(memory, shown_group, shown_fields(shapes, dimension), particles, dimension,
              {.dataset = [](const FieldShape& field) { return field.name; }}, [&](const FieldShape& wanted) {
                const auto field = std::ranges::find(fields, wanted.name, &FrameField::name);
                std::vector<double> values = field->values;
                if (wanted.type == NumberType::float32)
                  for (double& value : values) value = double(static_cast<float>(value));
                return values;
              });
  return hdf5::image(memory);
}

void write_frame(const std::filesystem::path& file, const std::vector<FrameField>& fields, const FrameStamp& stamp,
                 int dimension) {
  std::vector<std::byte> bytes;
  try {
    bytes = encode_frame(fields, stamp, dimension);
  } catch (const hdf5::Failure& failure) {
    throw Error(ExitCode::run_failed, "cannot make the frame " + file.string() + ": " + failure.what());
  }
  write_file(file, bytes);
}

FrameStamp read_stamp(const hdf5::Id& frame) {
  return {hdf5::read_attribute<std::int64_t>(frame, "step"), hdf5::read_attribute<double>(frame, "time")};
}

}  // namespace mesogen::output
