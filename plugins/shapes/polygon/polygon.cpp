// A polygon, by its corners in the case or in a file.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "mesogen/plugin/plugin.hpp"
#include "mesogen/plugin/shape.hpp"

namespace {

using namespace mesogen;

struct Corner {
  double x, y;
};

/// Twice the area of the triangle of three points; above 0 if they go around counterclockwise.
double turn(const Corner& a, const Corner& b, const Corner& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool cross(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
  return turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
}

class Polygon final : public Shape {
 public:
  static constexpr DimensionSet dimensions{2};

  void parameters(ParameterList& list) override {
    list.rows("points", points_).unit("m").sizes({2}).doc("coordinates of the corners, one after the other around it");
    list.text("file", file_)
        .doc("file with the corners in place of `points`: two numbers a line; lines that begin with # are left out");
  }

  void prepare(const Scene&) override {
    if (!file_.empty() && !points_.empty()) throw BadParameter("file", "must not be given beside points");
    for (const auto& point : points_) corners_.push_back({point[0], point[1]});
    if (!file_.empty()) read_file();
    const char* const key = file_.empty() ? "points" : "file";
    if (corners_.size() < 3)
      throw BadParameter(key, "a polygon has at least three corners, but here are " + std::to_string(corners_.size()));
    for (std::size_t a = 0; a < corners_.size(); ++a)
      for (std::size_t b = a + 1; b < corners_.size(); ++b)
        if (cross(corners_[a], after(a), corners_[b], after(b)))
          throw BadParameter(key, "the edges from corner " + std::to_string(a + 1) + " and from corner " +
                                      std::to_string(b + 1) + " cross each other: give the corners in order around it");
  }

  // A line from the point to the right crosses the edges an odd number of times if the point is inside.
  [[nodiscard]] double distance(const Point& at) const override {
    double least = std::numeric_limits<double>::infinity();
    bool inside = false;
    for (std::size_t n = 0; n < corners_.size(); ++n) {
      const Corner& a = corners_[n];
      const Corner& b = after(n);
      const double along_x = b.x - a.x;
      const double along_y = b.y - a.y;
      const double square = along_x * along_x + along_y * along_y;
      const double x = at[0] - a.x;
      const double y = at[1] - a.y;
      const double share = square > 0.0 ? std::clamp((x * along_x + y * along_y) / square, 0.0, 1.0) : 0.0;
      least = std::min(least, std::hypot(x - share * along_x, y - share * along_y));
      if ((a.y > at[1]) != (b.y > at[1]) && at[0] < a.x + (at[1] - a.y) / along_y * along_x) inside = !inside;
    }
    return inside ? -least : least;
  }

  [[nodiscard]] Point centre() const override {
    double area = 0.0;
    Point centre{};
    for (std::size_t n = 0; n < corners_.size(); ++n) {
      const Corner& a = corners_[n];
      const Corner& b = after(n);
      const double part = a.x * b.y - b.x * a.y;
      area += part;
      centre[0] += part * (a.x + b.x) / 3.0;
      centre[1] += part * (a.y + b.y) / 3.0;
    }
    return {centre[0] / area, centre[1] / area, 0.0};
  }

 private:
  [[nodiscard]] const Corner& after(std::size_t n) const { return corners_[(n + 1) % corners_.size()]; }

  void read_file() {
    std::ifstream file(file_);
    if (!file)
      throw BadParameter("file", "\"" + file_ + "\" cannot be read; it is looked for where mesogen was started");
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
      std::istringstream words(line);
      Corner corner{};
      if (line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') continue;
      if (!(words >> corner.x >> corner.y) || !std::isfinite(corner.x) || !std::isfinite(corner.y))
        throw BadParameter(
            "file", "line " + std::to_string(number) + " of \"" + file_ + "\" is no pair of numbers: \"" + line + "\"");
      corners_.push_back(corner);
    }
  }

  Parameter::Rows points_;
  std::string file_;
  std::vector<Corner> corners_;
};

}  // namespace

MESOGEN_SHAPE_PLUGIN(Polygon, "polygon", "1.0.0", "Polygon by its corners, from the case or a file")
