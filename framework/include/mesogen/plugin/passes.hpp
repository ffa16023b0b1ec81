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
#include "mesogen/fields/rank.hpp"
#include "mesogen/plugin/advice.hpp"
#include "mesogen/plugin/linear_term.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/plugin/step_limits.hpp"

namespace mesogen {

class PassContext;

/// How a flow moves particles, and the fields that are advanced on them.
struct Transport {
  std::string velocity;  ///< name of the field of the fluid's velocity, m/s; empty: nothing flows
  /// Name of the field of an additional velocity of particles, m/s, if any pass adds to it; may be empty. The shift
  /// moves a particle into other fluid: every predicted field f except the velocity (for example the order tensor) also
  /// changes by + shift . grad f (arbitrary Lagrangian-Eulerian). If particles kept what they carry, the director would
  /// be stirred and its free energy would rise. The velocity is kept, because otherwise momentum would drift.
  std::string shift;
  /// If true, particles do not move, and every advanced field f changes by - velocity . grad f (Eulerian).
  bool fixed = false;
  /// Name of the field of the acceleration that drives the fluid, m/s2. Only needed if passes advance the velocity
  /// (Advance::by_passes). It determines the first step from rest; later steps use the change of the velocity.
  std::string drive = {};

  /// Name of the field of the particles' velocity relative to the fluid: `shift`, or `velocity` with sign - if `fixed`.
  [[nodiscard]] const std::string& relative() const { return fixed ? velocity : shift; }
  [[nodiscard]] bool advects() const { return fixed || !shift.empty(); }
};

/// In which part of a step a pass runs.
enum class Phase {
  begin,  ///< after the half step that predicts the midpoint
  rates,  ///< at the midpoint; computes rates of change
  end,    ///< after the update
  /// after a step, if an observer or a frame reads what the pass writes, and for replayed frames. The pass computes it
  /// from fields that keep their values between steps. The integration uses what passes of other phases wrote
  observe,
};

/// How a field is advanced in time.
enum class Advance {
  never,     ///< not advanced: only passes write it
  midpoint,  ///< f += dt * rate, with the rate at the midpoint
  /// like midpoint; in addition, passes at the midpoint see the field half a step ahead, by the previous rate. For
  /// fields whose rate depends on themselves (velocity, order tensor). See TimeScheme
  predicted,
  /// passes of its plugin advance it. It may have an initial value, and is stored in checkpoints
  by_passes,
};

/// Bounds of a field in a run that has not broken down, and what the user can do if a value is outside.
struct FieldBounds {
  double lowest;       ///< in the unit of the field; bound of the length if it has several components
  double highest;      ///< the same
  std::string remedy;  ///< a sentence without its full stop: "Raise sound_speed"
};

/// A function of a plugin that is called after each step. `largest`: largest length of the field at that time;
/// `step_size`: s. Returns what it changed, for the log: "sound_speed rises from 2 to 4"; empty if nothing.
using Watch = std::function<std::string(double largest, double step_size)>;

/// True if the framework advances the field with a rate.
constexpr bool has_rate(Advance advance) { return advance == Advance::midpoint || advance == Advance::predicted; }

/// A field that a plugin introduces.
struct MESOGEN_EXPORT FieldDeclaration {
  std::string name;
  Rank rank = Rank::scalar;
  std::string unit_text = "1";
  std::string doc_text;
  Advance advance = Advance::never;
  std::string rate;                   ///< name of the field of its rate of change
  std::optional<FieldBounds> bounds;  ///< see stays_within
  Watch watch;                        ///< see watched_by
  bool is_shown = false;              ///< see shown
  bool needs_start = false;           ///< see set_at_start

  FieldDeclaration& unit(std::string_view text);
  FieldDeclaration& doc(std::string_view text);
  /// Frames store this field unless the case names the fields to store.
  FieldDeclaration& shown() {
    is_shown = true;
    return *this;
  }
  /// An initial condition must set this field; a case without one is refused. Other fields start from 0.
  FieldDeclaration& set_at_start() {
    needs_start = true;
    return *this;
  }
  /// Advanced by the framework with the field `rate_field`; kept in double precision, stored in checkpoints.
  FieldDeclaration& advanced_by(std::string_view rate_field);
  FieldDeclaration& predicted_by(std::string_view rate_field);
  /// Passes of the plugin write the field from its previous value: see Advance::by_passes.
  FieldDeclaration& advanced_by_passes();
  /// The run stops after the first step at which a value is outside the bounds; the message names the particle and
  /// gives the remedy. For a field with several components, the length is checked. Choose bounds that only a broken run
  /// exceeds.
  FieldDeclaration& stays_within(double lowest, double highest, std::string_view remedy) {
    bounds = FieldBounds{lowest, highest, std::string(remedy)};
    return *this;
  }
  /// Calls `function` after each step, so that the plugin can adapt its numerics to this field. Only for fields that
  /// are advanced in time. What the function changes must be kept (PassList::keep); the limits on the step are then
  /// computed again. Not called if the case gives the step, because the step could not follow.
  FieldDeclaration& watched_by(Watch function) {
    watch = std::move(function);
    return *this;
  }
};

/// One piece of work, and the fields that it uses. From these fields the scheduler finds the order of passes. It runs a
/// pass only if somebody needs what the pass writes, and updates ghosts and walls before a pass reads neighbours.
struct MESOGEN_EXPORT Pass {
  std::string name;
  Phase phase = Phase::rates;
  std::vector<std::string> own_reads;        ///< fields read at the particle itself
  std::vector<std::string> neighbour_reads;  ///< fields also read at neighbours
  std::vector<std::string> optional_reads;   ///< fields read if the scene has them; see PassContext::has
  std::vector<std::string> write_list;       ///< fields overwritten; only one writer per field and phase
  std::vector<std::string> accumulate_list;  ///< fields added to, in case order; the framework sets them to 0 before
  bool adds_nothing = false;                 ///< see idle_if
  bool at_every_step = false;                ///< see advances_what_is_kept
  bool beside_sums = false;                  ///< see beside_pair_sums
  bool no_net_force = false;                 ///< see conserves_momentum
  std::function<void(const PassContext&)> body;

  Pass& reads(std::initializer_list<std::string_view> fields);
  Pass& reads_neighbours(std::initializer_list<std::string_view> fields);
  Pass& reads_if_present(std::initializer_list<std::string_view> fields);
  Pass& writes(std::initializer_list<std::string_view> fields);
  Pass& accumulates(std::initializer_list<std::string_view> fields);
  /// idle = true: with these parameters (an activity of zero, for example) the pass adds only zeros. It is then left
  /// out, and with it everything that only it needs. For passes that accumulate and write nothing.
  Pass& idle_if(bool idle);
  /// It changes what the plugin keeps (PassList::keep): it runs at every step, even if nobody reads its fields.
  Pass& advances_what_is_kept();
  /// The pass keeps particles even enough for sums over neighbours. It runs only if another pass of the integration
  /// needs such sums (observers do not count), and may use the neighbours that are found for that pass. For passes that
  /// accumulate and write nothing.
  Pass& beside_pair_sums();
  /// What it adds to the acceleration comes from forces between parts of the fluid, such as the divergence of a stress:
  /// over a periodic box they add up to nothing, but for errors of sums over neighbours. If all passes that add to the
  /// acceleration say so, and the box is periodic along every axis, the framework brings the mean velocity of the
  /// particles back to that of the start every few steps. One pass that does not say so, because it pushes or brakes
  /// the fluid from outside, is enough to leave the mean velocity alone. PassList::diffusion of the velocity counts as
  /// conserving, PassList::damping does not.
  Pass& conserves_momentum();
  Pass& run(std::function<void(const PassContext&)> function);
};

/// The fields and passes of a physics plugin.
///
/// The framework offers the following fields by itself. It computes each once, and only if somebody reads it:
///   volume          scalar   V = 1 / sum_j W_ij (m^Dim)
///   correction      matrix   B, inverse of sum_j V_j r_ji (x) grad_i W_ij
///   X_gradient      d X_c / d x_d as component c * Dim + d, exact for linear X: B . sum_j V_j (X_j - X_i) grad_i W_ij
///   X_laplacian     2 (2 + Dim) / (2 + tr alpha) sum_j V_j (X_i - X_j) (r_ij . grad_i W_ij) / r_ij^2, each component
/// for any field X: `velocity_gradient`, `order_tensor_laplacian`, ... A plugin may declare a field of such a name and
/// write it in a pass: all readers then get the plugin's field.
class MESOGEN_EXPORT PassList {
 public:
  FieldDeclaration& field(std::string_view name, Rank rank);
  Pass& pass(std::string_view name, Phase phase = Phase::rates);
  /// Declares that there is a flow, and how it moves particles. Only one plugin of a case may call this.
  void flows(Transport transport) { transport_ = std::move(transport); }
  /// Declares that a field diffuses, or is damped; see LinearTerm. `rate`: field of its rate of change. `rule`: formula
  /// of the limit on explicit steps, for messages: "stable diffusion by mu / rho".
  LinearTerm& diffusion(std::string_view field, std::string_view rate, double coefficient, StepCause cause,
                        std::string_view rule);
  LinearTerm& damping(std::string_view field, std::string_view rate, double coefficient, StepCause cause,
                      std::string_view rule);
  /// Declares numbers that the plugin's passes advance from step to step, such as a field on a mesh. Checkpoints store
  /// them. During a run `where` must return exactly `count` numbers; the framework may change them.
  void keep(std::string_view name, std::size_t count, std::function<std::span<double>()> where) {
    kept_.push_back({std::string(name), count, std::move(where)});
  }

  /// Declares a limit on the step. `seconds` returns it, s; infinity means no limit. It must stay the same during the
  /// run, or until a watch changes something (FieldDeclaration::watched_by). `rule` is its formula: "0.25 h / c0".
  void step_limit(StepCause cause, std::string_view rule, std::function<double(const Scene&)> seconds) {
    limits_.push_back({cause, std::string(rule), std::move(seconds)});
  }
  /// A number for observers, limits and advice that is known only in declare(); see also Physics::publish.
  void constant(std::string_view name, double value) { constants_.insert_or_assign(std::string(name), value); }
  /// Adds the approximate memory beyond the declared fields, in bytes, for the forecast of a run. A plugin must not
  /// allocate this memory before its passes run.
  void memory(double bytes) { memory_ += bytes; }
  /// Sets the function that adds numbers which characterise the scene, for `mesogen check`.
  void numbers(std::function<void(const Scene&, std::vector<SceneNumber>&)> function) {
    numbers_ = std::move(function);
  }
  /// Sets the function that adds advice, for `mesogen check`.
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
  [[nodiscard]] const std::deque<LinearTerm>& linear_terms() const { return linear_terms_; }
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
  std::deque<LinearTerm> linear_terms_;
  Transport transport_;
};

}  // namespace mesogen
