#include "prescribed/film.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "error_of.hpp"
#include "png_file.hpp"

namespace mesogen {
namespace {

TEST(Film, KeepsTheBrightnessThatIsStored) {
  const std::string shallow = test::write_png("film_shallow.png", 3, 2, {0, 51, 102, 153, 204, 255});
  const Film film = read_film({shallow}, {0.0});
  EXPECT_EQ(film.width, 3);
  EXPECT_EQ(film.height, 2);
  for (int n = 0; n < 6; ++n) EXPECT_FLOAT_EQ(film.pixels[static_cast<std::size_t>(n)], static_cast<float>(n) / 5.0F);
  const std::string deep = test::write_png("film_deep.png", 2, 1, {13107, 65535}, true);
  EXPECT_FLOAT_EQ(read_film({deep}, {0.0}).pixels[0], 0.2F);
  EXPECT_FLOAT_EQ(read_film({deep}, {0.0}).pixels[1], 1.0F);
}

TEST(Film, FadesFromOnePictureIntoTheNext) {
  Film film;
  film.times = {1.0, 3.0, 4.0};
  const auto moment = [&](double time) {
    const Film::Moment at = film.at(time);
    return std::vector<double>{static_cast<double>(at.before), static_cast<double>(at.after), at.share};
  };
  EXPECT_EQ(moment(0.0), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(moment(1.5), (std::vector<double>{0, 1, 0.25}));
  EXPECT_EQ(moment(3.0), (std::vector<double>{1, 2, 0}));
  EXPECT_EQ(moment(9.0), (std::vector<double>{2, 2, 0}));
}

TEST(Film, ThatCannotBeReadIsRefused) {
  const auto refusal = [](const std::vector<std::string>& files) {
    return error_of([&] { (void)read_film(files, {}); }, ExitCode::bad_case);
  };
  EXPECT_EQ(refusal({"missing.png"}),
            "\"missing.png\" cannot be read (No such file or directory); it is looked for where mesogen was started");
  const std::string text = test::write_png("film_text.png", 1, 1, {0});
  std::ofstream(text) << "no picture";
  EXPECT_EQ(refusal({text}), "\"" + text + "\" is no picture that can be read: Not a PNG file; give a PNG file");
  const std::string one = test::write_png("film_one.png", 1, 1, {0});
  const std::string two = test::write_png("film_two.png", 2, 1, {0, 0});
  EXPECT_EQ(refusal({one, two}),
            "\"" + two + "\" has 2 x 1 pixels, but \"" + one + "\" has 1 x 1: all pictures of a film have one size");
}

}  // namespace
}  // namespace mesogen
