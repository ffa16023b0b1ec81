#pragma once

#include <png.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace mesogen::test {

/// Writes a picture of grey pixels, row by row from the top; returns its name. `deep`: sixteen bits a pixel.
inline std::string write_png(const std::string& name, int width, int height, const std::vector<std::uint16_t>& pixels,
                             bool deep = false) {
  const std::string file = (std::filesystem::temp_directory_path() / name).string();
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = deep ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_GRAY;
  const std::vector<std::uint8_t> bytes(pixels.begin(), pixels.end());
  const void* const data = deep ? static_cast<const void*>(pixels.data()) : bytes.data();
  if (png_image_write_to_file(&image, file.c_str(), 0, data, 0, nullptr) == 0)
    throw std::runtime_error("no picture could be written");
  return file;
}

}  // namespace mesogen::test
