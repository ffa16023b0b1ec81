#include "prescribed/sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "case/toml_text.hpp"
#include "exec/program_evaluation.hpp"
#include "prescribed/surroundings.hpp"
#include "text/rounded_text.hpp"

namespace mesogen {

namespace {

constexpr int times_in_octave = 32;
constexpr Index most_places = 512;  // of particles, at times after the start

/// The same times for every end, as far as they come before it: a run that is extended goes on as it began. Evenly in
/// the logarithm, as nobody knows how fast something changes.
std::set<double> sampled_times(const Program& program, double end) {
  std::set<double> times = {0.0};
  if (!program.changes_in_time()) return times;
  for (const Film& film : program.films)
    for (const double time : film.times)
      if (time > 0.0 && time <= end) times.insert(time);
  for (int octave = -30; octave < 60; ++octave)
    for (int n = 0; n < times_in_octave; ++n) {
      const double time = std::ldexp(1.0 + n / static_cast<double>(times_in_octave), octave);
      if (time <= end) times.insert(time);
    }
  return times;
}

/// Of one component.
class Sampler {
 public:
  Sampler(const Prescribed& prescribed, const Program& program, const Scene& scene, const Arrangement& particles)
      : prescribed_(prescribed), program_(program), scene_(scene), particles_(particles) {}

  double largest() const { return largest_; }
  /// What is wrong with the first value that is; empty if nothing is.
  [[nodiscard]] const std::string& problem() const { return problem_; }

  void look(double time, Index stride, const std::vector<std::vector<double>>& fields) {
    const Index count = (particles_.count + stride - 1) / stride;
    std::array<std::vector<double>, 3> position;
    const auto thinned = [&](const std::vector<double>& all) {
      std::vector<double> some;
      for (Index i = 0; i < particles_.count; i += stride) some.push_back(all[static_cast<std::size_t>(i)]);
      return some;
    };
    exec::EvaluateArguments<double> arguments{};
    arguments.program = program_.view();
    arguments.around = surroundings<double>(scene_, time);
    for (std::size_t d = 0; d < static_cast<std::size_t>(scene_.dimension); ++d) {
      position[d] = thinned(particles_.position[d]);
      arguments.around.position[d] = position[d].data();
    }
    std::vector<std::vector<double>> some;
    for (const auto& field : fields) some.push_back(thinned(field));
    for (std::size_t n = 0; n < some.size(); ++n) arguments.around.field[n] = {some[n].data(), 0};
    for (std::size_t n = 0; n < program_.films.size(); ++n)
      arguments.around.film[n] = film_view(program_.films[n], program_.films[n].pixels.data(), time);
    std::vector<double> value(static_cast<std::size_t>(count));
    arguments.result = value.data();
    exec::evaluate_program({}, arguments, count);
    for (std::size_t i = 0; i < value.size() && problem_.empty(); ++i) {
      if (std::abs(value[i]) > std::abs(largest_)) largest_ = value[i];
      if (const std::string wrong = what_is_wrong(prescribed_, value[i]); !wrong.empty()) {
        std::string place;
        for (std::size_t d = 0; d < static_cast<std::size_t>(scene_.dimension); ++d)
          place += (d > 0 ? ", " : "") + rounded_text(position[d][i]);
        const Units& units = prescribed_.section.units();
        problem_ = fmt::format("{}, but is {} at ({}) {}, t = {} {}", wrong,
                               std::isnan(value[i]) ? "no number" : rounded_text(value[i]), place, units.length,
                               rounded_text(time), units.time);
      }
    }
  }

 private:
  const Prescribed& prescribed_;
  const Program& program_;
  const Scene& scene_;
  const Arrangement& particles_;
  double largest_ = 0.0;
  std::string problem_;
};

/// The first field of which a plugin says that it cannot tell how large it gets; empty if there is none.
std::string unknown_field(const Program& program, const Scene& scene) {
  for (const std::string& field : program.fields)
    if (std::isinf(scene.constant(field + "_largest"))) return field;
  return {};
}

/// Each field as it is at the start; then at shares of the largest value that a plugin tells.
std::vector<std::vector<std::vector<double>>> field_values(const Program& program, const Scene& scene, Index count,
                                                           const FieldAtStart& field_at_start) {
  std::vector<std::vector<double>> start;
  for (const std::string& field : program.fields) {
    start.push_back(field_at_start(field));
    if (start.back().empty()) start.back().assign(static_cast<std::size_t>(count), 0.0);
  }
  std::vector<std::vector<std::vector<double>>> all = {start};
  for (std::size_t n = 0; n < program.fields.size(); ++n)
    if (const auto at = scene.constants.find(program.fields[n] + "_largest");
        at != scene.constants.end() && std::isfinite(at->second)) {
      // What is largest need not be so where the field is.
      for (const double share : {0.25, 0.5, 0.75, 1.0}) {
        all.push_back(start);
        all.back()[n].assign(static_cast<std::size_t>(count), share * at->second);
      }
    }
  return all;
}

}  // namespace

std::vector<double> largest_values(const Prescribed& prescribed, const Scene& scene, const Arrangement& particles,
                                   double end, const FieldAtStart& field_at_start, Problems& problems) {
  std::vector<double> largest;
  for (const Program& program : prescribed.components) {
    Sampler sampler(prescribed, program, scene, particles);
    for (const auto& fields : field_values(program, scene, particles.count, field_at_start))
      for (const double time : sampled_times(program, end))
        sampler.look(time, time == 0.0 ? 1 : std::max<Index>(1, particles.count / most_places), fields);
    if (!sampler.problem().empty()) {
      const Value& one = value_of(prescribed, largest.size());
      problems.add(one.place, full_key(prescribed), fmt::format("{} {}", shown(one), sampler.problem()));
    }
    largest.push_back(sampler.largest());
    const std::string unknown = unknown_field(program, scene);
    if (sampler.problem().empty() && !unknown.empty())
      problems.add(value_of(prescribed, largest.size() - 1).place, full_key(prescribed),
                   fmt::format("{} reads '{}', and nothing tells how large that gets: give the key `largest` in the "
                               "section that brings it",
                               shown(value_of(prescribed, largest.size() - 1)), unknown));
  }
  return largest;
}

}  // namespace mesogen
