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
    if (size.empty() || !(spacing > 0.0)) return;
    constexpr double most_particles = 2e9;
    constexpr double fewest_spacings = 4.0;
    const double shortest = *std::ranges::min_element(size);
    const double power = 1.0 / static_cast<double>(size.size());
    double particles = 1.0;
    double widest = std::pow(most_particles, -power);  // spacing with as many particles
    for (const double edge : size) {
      particles *= edge / spacing;
      widest *= std::pow(edge, power);
    }
    if (shortest < fewest_spacings * spacing) {
      refuse("particles.spacing", fmt::format("must be <= {} {}, a quarter of the shortest edge of the box, but is {}",
                                              shortest / fewest_spacings, case_.units.length, spacing));
    } else if (!(particles <= most_particles)) {
      refuse("particles.spacing",
             fmt::format("must leave at most 2e9 particles, >= {:.4g} {} in this box, but is {}, which gives {:.3g}",
                         widest, case_.units.length, spacing, particles));
    } else if (const auto wrong = dimension_problem(case_); !wrong.empty()) {
      refuse("particles.arrangement", wrong);
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
