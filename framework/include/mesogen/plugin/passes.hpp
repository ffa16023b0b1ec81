#pragma once

#include <deque>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesogen/export.hpp"
#include "mesogen/particles/rank.hpp"
#include "mesogen/plugin/advice.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/plugin/step_limits.hpp"

namespace mesogen {

class PassContext;

/// How particles, and the fields that are advanced on them, go with a flow.
struct Transport {
  std::string velocity;  ///< of the fluid, m/s; empty: nothing flows
  /// What moves particles beside it, m/s, if any pass adds to it; may be empty. It takes a particle into other fluid:
  /// every predicted field f but the velocity (the order tensor) changes by + shift . grad f too (arbitrary
  /// Lagrangian-Eulerian). Particles that kept what they carry would stir the director, and its free energy would
  /// rise. The velocity stays, because momentum would drift.
  std::string shift;
  /// Particles stay where they are, and every advanced field f changes by - velocity . grad f (Eulerian).
  bool fixed = false;
  /// Of what drives the fluid, m/s2, where passes advance the velocity (Advance::by_passes): what the first step from
  /// rest goes by; then the change of the velocity is known.
  std::string drive = {};

  /// The velocity of particles relative to the fluid: + shift, - velocity, or none.
  [[nodiscard]] const std::string& relative() const { return fixed ? velocity : shift; }
  [[nodiscard]] bool advects() const { return fixed || !shift.empty(); }
};

/// When in a step a pass runs.
enum class Phase {
  begin,  ///< after the half step that predicts the midpoint
  rates,  ///< at the midpoint: rates of change
  end,    ///< after the update
  /// after a step, when an observer or a frame reads what the pass writes, and for frames that are replayed: makes it
  /// from fields that keep their value from step to step. The integration takes what a pass of another phase wrote
  observe,
};

/// How a field that the framework advances in time is advanced.
enum class Advance {
  never,     ///< only passes write it
  midpoint,  ///< f += dt * rate, the rate taken at the midpoint
  /// the same, but at the midpoint passes see it half a step ahead by the previous rate: for fields whose rate depends
  /// on themselves (velocity, order tensor). See TimeScheme
  predicted,
  /// its plugin's passes bring it from step to step; it may have an initial value, and is kept in checkpoints
  by_passes,
};

/// Between which values a field of a sound run stays, and what to do where it does not.
struct FieldBounds {
  double lowest;       ///< in the unit of the field; of its length where it has several components
  double highest;      ///< likewise
  std::string remedy;  ///< a sentence without its stop: "Raise sound_speed"
};

/// What a plugin does after each step, given the largest length that a field has then and the step, s. Returns what it
/// changed, for the log: "sound_speed rises from 2 to 4"; empty: nothing.
using Watch = std::function<std::string(double largest, double step_size)>;

/// Does the framework advance it, with a rate?
constexpr bool has_rate(Advance advance) { return advance == Advance::midpoint || advance == Advance::predicted; }

/// A field that a plugin introduces.
struct MESOGEN_EXPORT FieldDeclaration {
  std::string name;
  Rank rank = Rank::scalar;
  std::string unit_text = "1";
  std::string doc_text;
  Advance advance = Advance::never;
  std::string rate;                   ///< field that holds its rate of change
  std::optional<FieldBounds> bounds;  ///< see stays_within
  Watch watch;                        ///< see watched_by
  bool is_shown = false;              ///< see shown
  bool needs_start = false;           ///< see set_at_start

  FieldDeclaration& unit(std::string_view text);
  FieldDeclaration& doc(std::string_view text);
  /// Frames store it unless the case names other fields.
  FieldDeclaration& shown() {
    is_shown = true;
    return *this;
  }
  /// An initial condition has to set it: a case without one is refused. Other fields start from 0.
  FieldDeclaration& set_at_start() {
    needs_start = true;
    return *this;
  }
  /// The framework advances this field with `rate_field`, keeps it in double and in checkpoints.
  FieldDeclaration& advanced_by(std::string_view rate_field);
  FieldDeclaration& predicted_by(std::string_view rate_field);
  /// Passes of the plugin write it, from what it was: see Advance::by_passes.
  FieldDeclaration& advanced_by_passes();
  /// The run ends, with the particle and the remedy, at the step after which a value is outside; of a field with
  /// several components it is the length. For bounds beyond which a run is broken without doubt: a sound one never
  /// meets them.
  FieldDeclaration& stays_within(double lowest, double highest, std::string_view remedy) {
    bounds = FieldBounds{lowest, highest, std::string(remedy)};
    return *this;
  }
  /// For an advanced field, and a plugin that adapts its numerics to it while the run goes on. What the function
  /// changes must be kept (PassList::keep); limits on the step are asked again where it changed something. It is not
  /// called where the case gives the step, which could not follow.
  FieldDeclaration& watched_by(Watch function) {
    watch = std::move(function);
    return *this;
  }
};

/// One piece of work with the fields that it touches. The scheduler orders passes by these, runs them only if somebody
/// needs what they write, and refreshes ghosts and walls before a neighbour's value is read.
struct MESOGEN_EXPORT Pass {
  std::string name;
  Phase phase = Phase::rates;
  std::vector<std::string> own_reads;        ///< read at the particle itself
  std::vector<std::string> neighbour_reads;  ///< read at neighbours too
  std::vector<std::string> optional_reads;   ///< read if the scene has them; see PassContext::has
  std::vector<std::string> write_list;       ///< overwritten; one writer a field and phase
  std::vector<std::string> accumulate_list;  ///< added to; the framework zeroes it first, additions in case order
  bool adds_nothing = false;                 ///< see idle_if
  bool at_every_step = false;                ///< see advances_what_is_kept
  bool beside_sums = false;                  ///< see beside_pair_sums
  std::function<void(const PassContext&)> body;

  Pass& reads(std::initializer_list<std::string_view> fields);
  Pass& reads_neighbours(std::initializer_list<std::string_view> fields);
  Pass& reads_if_present(std::initializer_list<std::string_view> fields);
  Pass& writes(std::initializer_list<std::string_view> fields);
  Pass& accumulates(std::initializer_list<std::string_view> fields);
  /// With these parameters (an activity of zero) it would add zero to everything: it is left out, with whatever only it
  /// needs. For passes that accumulate and write nothing.
  Pass& idle_if(bool idle);
  /// It changes what the plugin keeps (PassList::keep): it runs at every step, whoever reads what it writes.
  Pass& advances_what_is_kept();
  /// It keeps particles fit for sums over neighbours: it runs only where another pass of the integration needs such
  /// sums (observers do not count), and may use the neighbours that are found for that pass. For passes that
  /// accumulate and write nothing.
  Pass& beside_pair_sums();
  Pass& run(std::function<void(const PassContext&)> function);
};

/// What a physics plugin does: its fields and passes.
///
/// Fields that the framework offers by itself, made once and only if somebody reads them:
///   volume          scalar   V = 1 / sum_j W_ij (m^Dim)
///   correction      matrix   B, inverse of sum_j V_j r_ji (x) grad_i W_ij
///   X_gradient      d X_c / d x_d as component c * Dim + d, exact for linear X: B . sum_j V_j (X_j - X_i) grad_i W_ij
///   X_laplacian     2 (2 + Dim) / (2 + tr alpha) sum_j V_j (X_i - X_j) (r_ij . grad_i W_ij) / r_ij^2, each component
/// for any field X: `velocity_gradient`, `order_tensor_laplacian`, ...
/// A plugin may introduce a field of such a name and write it in a pass: then everybody reads that.
class MESOGEN_EXPORT PassList {
 public:
  FieldDeclaration& field(std::string_view name, Rank rank);
  Pass& pass(std::string_view name, Phase phase = Phase::rates);
  /// There is a flow, and this is how particles go with it. One plugin of a case says so.
  void flows(Transport transport) { transport_ = std::move(transport); }
  /// Numbers of the plugin's own that its passes bring from step to step, such as a field on a mesh: kept in
  /// checkpoints. While a run is under way `where` must return exactly `count` numbers, which may be changed there.
  void keep(std::string_view name, std::size_t count, std::function<std::span<double>()> where) {
    kept_.push_back({std::string(name), count, std::move(where)});
  }

  /// A limit on the step, s: infinite where it does not limit. It stays the same over the run, or until a watch changes
  /// something (FieldDeclaration::watched_by). `rule` says how it is made: "0.25 h / c0".
  void step_limit(StepCause cause, std::string_view rule, std::function<double(const Scene&)> seconds) {
    limits_.push_back({cause, std::string(rule), std::move(seconds)});
  }
  /// A number for observers, limits and advice that is known only now, beside those of Physics::publish.
  void constant(std::string_view name, double value) { constants_.insert_or_assign(std::string(name), value); }
  /// Approximate memory beyond the declared fields, bytes, for the forecast of a run. It must not be taken before
  /// passes run.
  void memory(double bytes) { memory_ += bytes; }
  /// Numbers that tell what kind of scene this is.
  void numbers(std::function<void(const Scene&, std::vector<SceneNumber>&)> function) {
    numbers_ = std::move(function);
  }
  /// What would be better otherwise in this scene.
  void advice(std::function<void(const AdviceContext&, std::vector<Suggestion>&)> function) {
    advice_ = std::move(function);
  }

  [[nodiscard]] const std::deque<FieldDeclaration>& fields() const { return fields_; }
  [[nodiscard]] const std::deque<Pass>& passes() const { return passes_; }
  struct Limit {
    StepCause cause;
    std::string rule;
    std::function<double(const Scene&)> seconds;
  };
  [[nodiscard]] const std::vector<Limit>& step_limits() const { return limits_; }
  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] double memory() const { return memory_; }
  [[nodiscard]] const auto& numbers() const { return numbers_; }
  [[nodiscard]] const auto& advice() const { return advice_; }
  [[nodiscard]] const Transport& transport() const { return transport_; }
  struct Kept {
    std::string name;
    std::size_t count;
    std::function<std::span<double>()> where;
  };
  [[nodiscard]] const std::vector<Kept>& kept() const { return kept_; }

 private:
  std::vector<Kept> kept_;
  std::vector<Limit> limits_;
  Constants constants_;
  double memory_ = 0.0;
  std::function<void(const Scene&, std::vector<SceneNumber>&)> numbers_;
  std::function<void(const AdviceContext&, std::vector<Suggestion>&)> advice_;
  std::deque<FieldDeclaration> fields_;
  std::deque<Pass> passes_;
  Transport transport_;
};

}  // namespace mesogen
