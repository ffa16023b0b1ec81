#include "case/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "initial/arrangement.hpp"

namespace mesogen {

namespace {

class Checker {
 public:
  Checker(const Case& source, Problems& problems) : case_(source), problems_(problems) {}

  void domain_and_particles() {
    const auto& size = case_.domain.size;
    const double spacing = case_.particles.spacing;
    if (size.size() != 2 || !(spacing > 0.0)) return;
    constexpr double most_particles = 2e9;
    constexpr double fewest_spacings = 4.0;
    const double shortest = std::min(size[0], size[1]);
    const double particles = size[0] / spacing * (size[1] / spacing);
    if (shortest < fewest_spacings * spacing) {
      refuse("particles.spacing", fmt::format("must be <= {} {}, a quarter of the shortest edge of the box, but is {}",
                                              shortest / fewest_spacings, case_.units.length, spacing));
    } else if (!(particles <= most_particles)) {
      refuse("particles.spacing",
             fmt::format("must leave at most 2e9 particles, >= {:.4g} {} in this box, but is {}, which gives {:.3g}",
                         std::sqrt(size[0]) * std::sqrt(size[1]) / std::sqrt(most_particles), case_.units.length,
                         spacing, particles));
    } else if (const auto problem = arrangement_problem(case_); !problem.empty()) {
      refuse("particles.spacing", problem);
    }
  }

  /// A wave that does not fit the periodic box would tear the field at its faces.
  void modes(const std::string& key, const Case::Rows& rows) {
    for (std::size_t row = 0; row < rows.size(); ++row)
      for (std::size_t axis = 0; axis < 2; ++axis)
        if (rows[row][axis] != std::round(rows[row][axis])) {
          refuse(key, fmt::format("row {}: wave numbers must be whole, so that the wave fits the box, but is {}",
                                  row + 1, rows[row][axis]));
          break;
        }
  }

  void defects() {
    const auto& rows = case_.director.defects;
    const auto& size = case_.domain.size;
    const std::string key = "director.defects";
    double charge = 0.0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const auto& defect = rows[row];
      charge += defect[2];
      if (std::abs(defect[2]) != 0.5)
        return refuse(key, fmt::format("row {}: the charge must be 0.5 or -0.5, but is {}", row + 1, defect[2]));
      for (std::size_t other = 0; other < row && size.size() == 2; ++other)
        if (same_place(rows[other], defect))
          return refuse(key, fmt::format("rows {} and {} are at the same place", other + 1, row + 1));
    }
    if (charge != 0.0)
      refuse(key, fmt::format("the charges must add up to 0 in a periodic box, but their sum is {}", charge));
  }

  void output_fields() {
    const auto& fields = case_.output.fields;
    for (std::size_t n = 0; n < fields.size(); ++n)
      if (std::find(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(n), fields[n]) !=
          fields.begin() + static_cast<std::ptrdiff_t>(n))
        return refuse("output.fields", "names \"" + fields[n] + "\" twice");
  }

 private:
  /// Also from one face of the box to the other: the field of defects is periodic.
  [[nodiscard]] bool same_place(const std::vector<double>& a, const std::vector<double>& b) const {
    const auto& size = case_.domain.size;
    for (std::size_t axis = 0; axis < 2; ++axis)
      if (!(std::abs(std::remainder(a[axis] - b[axis], size[axis])) <= 1e-9 * size[axis])) return false;
    return true;
  }

  void refuse(const std::string& key, const std::string& text) { problems_.add(case_.place(key), key, text); }

  const Case& case_;
  Problems& problems_;
};

}  // namespace

void check_case(const Case& source, Problems& problems) {
  Checker checker(source, problems);
  checker.domain_and_particles();
  checker.modes("director.modes", source.director.modes);
  checker.modes("velocity.modes", source.velocity.modes);
  checker.defects();
  checker.output_fields();
}

}  // namespace mesogen
