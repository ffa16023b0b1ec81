#include "case/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "case/arrangement.hpp"

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

  void output_fields() {
    const auto& fields = case_.output.fields;
    for (std::size_t n = 0; n < fields.size(); ++n)
      if (std::find(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(n), fields[n]) !=
          fields.begin() + static_cast<std::ptrdiff_t>(n))
        return refuse("output.fields", "names \"" + fields[n] + "\" twice");
  }

 private:
  void refuse(const std::string& key, const std::string& text) { problems_.add(case_.place(key), key, text); }

  const Case& case_;
  Problems& problems_;
};

}  // namespace

void check_case(const Case& source, Problems& problems) {
  Checker checker(source, problems);
  checker.domain_and_particles();
  checker.output_fields();
}

}  // namespace mesogen
