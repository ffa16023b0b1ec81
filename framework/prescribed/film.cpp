#include "prescribed/film.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {

namespace {

constexpr double most_pixels = 2e7;  // more than any box has particles

struct Picture {
  int width = 0, height = 0;
  std::vector<float> pixels;
};

[[noreturn]] void fail(png_structp png, png_const_charp what) {
  throw Error(ExitCode::bad_case, fmt::format("\"{}\" is no picture that can be read: {}; give a PNG file",
                                              *static_cast<const std::string*>(png_get_error_ptr(png)), what));
}

/// Of libpng, while a file is read.
struct Reader {
  explicit Reader(std::string& file)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &file, fail, [](png_structp, png_const_charp) {})),
        info(png_create_info_struct(png)) {}
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }

  png_structp png;
  png_infop info;
};

Picture read_picture(std::string file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
  if (!stream)
    throw Error(ExitCode::bad_case,
                fmt::format("\"{}\" cannot be read ({}); it is looked for where mesogen was started", file,
                            std::strerror(errno)));
  const Reader reader(file);
  png_init_io(reader.png, stream.get());
  png_read_info(reader.png, reader.info);
  // Brightness as it is stored, of one channel with eight or sixteen bits.
  png_set_expand(reader.png);
  png_set_strip_alpha(reader.png);
  if ((png_get_color_type(reader.png, reader.info) & PNG_COLOR_MASK_COLOR) != 0)
    png_set_rgb_to_gray_fixed(reader.png, PNG_ERROR_ACTION_NONE, PNG_RGB_TO_GRAY_DEFAULT, PNG_RGB_TO_GRAY_DEFAULT);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  Picture picture;
  picture.width = static_cast<int>(png_get_image_width(reader.png, reader.info));
  picture.height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  if (static_cast<double>(picture.width) * picture.height > most_pixels)
    throw Error(ExitCode::bad_case, fmt::format("\"{}\" has {} x {} pixels, and {:.0e} are the most: make it smaller",
                                                file, picture.width, picture.height, most_pixels));
  const bool deep = png_get_bit_depth(reader.png, reader.info) == 16;
  const std::size_t row_bytes = png_get_rowbytes(reader.png, reader.info);
  std::vector<png_byte> bytes(row_bytes * static_cast<std::size_t>(picture.height));
  std::vector<png_bytep> rows;
  for (int r = 0; r < picture.height; ++r) rows.push_back(bytes.data() + static_cast<std::size_t>(r) * row_bytes);
  png_read_image(reader.png, rows.data());
  for (const png_bytep row : rows)
    for (int c = 0; c < picture.width; ++c)
      picture.pixels.push_back(deep ? static_cast<float>(row[2 * c] * 256 + row[2 * c + 1]) / 65535.0F
                                    : static_cast<float>(row[c]) / 255.0F);
  return picture;
}

}  // namespace

Film::Moment Film::at(double time) const {
  const auto next = std::ranges::upper_bound(times, time);
  if (next == times.begin()) return {0, 0, 0.0};
  const auto before = static_cast<std::size_t>(next - times.begin()) - 1;
  if (next == times.end()) return {before, before, 0.0};
  return {before, before + 1, (time - times[before]) / (*next - times[before])};
}

Film read_film(const std::vector<std::string>& files, std::vector<double> times) {
  Film film;
  film.times = std::move(times);
  for (const std::string& file : files) {
    const Picture picture = read_picture(file);
    if (film.pixels.empty()) {
      film.width = picture.width;
      film.height = picture.height;
    } else if (film.width != picture.width || film.height != picture.height) {
      throw Error(ExitCode::bad_case,
                  fmt::format("\"{}\" has {} x {} pixels, but \"{}\" has {} x {}: all pictures of a "
                              "film have one size",
                              file, picture.width, picture.height, files.front(), film.width, film.height));
    }
    film.pixels.insert(film.pixels.end(), picture.pixels.begin(), picture.pixels.end());
  }
  return film;
}

}  // namespace mesogen
