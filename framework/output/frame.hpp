#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/fields/rank.hpp"

namespace mesogen {

/// How numbers are stored.
enum class NumberType { float64, float32, int32 };

/// One field of a frame, all particles in the order of their id.
struct FrameField {
  std::string name;
  std::string unit;
  int components = 1;
  std::vector<double> values;  ///< particles x components, row by row
  NumberType type = NumberType::float64;
  std::optional<Rank> rank = {};  ///< what the components mean, where that is known
};

/// A frame of a run that may go on before its values are there.
struct TakenFrame {
  std::vector<FrameField> fields;  ///< all but the values
  /// Gives the fields their values. Called once, mostly by another thread than that of the run.
  std::function<void(std::vector<FrameField>& fields)> fill;
};

namespace output {

/// A field without its values.
struct FieldShape {
  std::string name;
  std::string unit;
  int components = 1;
  NumberType type = NumberType::float64;
  std::optional<Rank> rank = {};

  bool operator==(const FieldShape&) const = default;
};

/// Is it the order tensor of a nematic, and not a rate, a stress or a gradient of one, which have units?
inline bool has_director(const FieldShape& field) {
  return field.rank == Rank::order_tensor && field.components == 2 && field.unit == "1";
}

/// When a frame was taken.
struct FrameStamp {
  std::int64_t step = 0;
  double time = 0.0;  ///< s

  bool operator==(const FrameStamp&) const = default;
};

/// frames/000012.h5, relative to the folder of the run.
MESOGEN_EXPORT std::string frame_name(std::size_t number);

/// The bytes of a frame's file.
std::vector<std::byte> encode_frame(const std::vector<FrameField>& fields, const FrameStamp& stamp, int dimension);

/// Writes a frame to a file of its own; on disk when it returns.
MESOGEN_EXPORT void write_frame(const std::filesystem::path& file, const std::vector<FrameField>& fields,
                                const FrameStamp& stamp, int dimension);

}  // namespace output
}  // namespace mesogen
