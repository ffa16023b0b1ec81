#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "exec/backend.hpp"
#include "mesogen/export.hpp"
#include "schedule/catalogue.hpp"
#include "schedule/linear_terms.hpp"
#include "schedule/scheduled_pass.hpp"

namespace mesogen {

/// Somebody who reads fields from outside the step: an observer, or the output.
struct Reader {
  std::string name;                 ///< "observers.flow", "output"
  std::vector<std::string> fields;  ///< must exist
};

/// The work of a step, ordered from what each pass reads and writes; what nobody needs is pruned.
///
/// In a phase: one writer per field; then those who add to it, in the order of the case; then those who read it. The
/// order is the first topological one, so it is the same every time. Fields that the framework derives (gradients, ...)
/// are made when a pass that reads them comes up.
class MESOGEN_EXPORT StepGraph {
 public:
  struct Member {
    std::string instance;  ///< "physics.flow"
    const PassList* passes;
    std::string plugin = {};  ///< "wcsph"
    bool on_device = false;   ///< its passes run on the backend's device
  };

  /// Throws an Error that names the chain: two writers, a field that nobody provides, a cycle. `stabilised`: linear
  /// terms are taken in stages where they can be, and are no passes.
  StepGraph(const Catalogue& catalogue, const std::vector<Member>& members, const std::vector<Reader>& readers,
            const Backend& backend = Backend::host(), bool stabilised = false);

  [[nodiscard]] std::vector<ScheduledPass>& passes() { return passes_; }
  [[nodiscard]] const std::vector<ScheduledPass>& passes() const { return passes_; }
  /// Indices into passes(), in the order in which they run.
  [[nodiscard]] const std::vector<std::size_t>& order(Phase phase) const {
    return order_[static_cast<std::size_t>(phase)];
  }
  /// Does it run before the velocity is advanced, in a step that takes the velocity in stages? Only of Phase::rates.
  [[nodiscard]] bool before_velocity(std::size_t pass) const { return before_velocity_.contains(pass); }
  /// Linear terms that are taken in stages.
  [[nodiscard]] const std::vector<LinearTerms>& staged() const { return staged_; }
  /// Is the velocity of the fluid advanced in stages?
  [[nodiscard]] bool stages_velocity() const;
  /// Derived fields that the integration needs; those of reader n.
  [[nodiscard]] const std::set<std::string>& derived_for_integration() const { return derived_for_integration_; }
  [[nodiscard]] const std::set<std::string>& derived_for_reader(std::size_t n) const { return derived_for_reader_[n]; }
  [[nodiscard]] const std::vector<std::set<std::string>>& derived_for_readers() const { return derived_for_reader_; }
  /// How particles go with the flow; its shift is empty if nobody adds to it.
  [[nodiscard]] const Transport& transport() const { return transport_; }
  /// Does the integration need sums over neighbours?
  [[nodiscard]] bool sums_pairs() const;

  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string graphviz() const;

 private:
  struct Need;
  void add_advection(const Backend& backend);
  void add_linear_terms(const std::vector<Member>& members, const Backend& backend, bool stabilised);
  void add_own(const std::string& owner, Pass pass);
  void check_fields() const;
  void check_writers() const;
  void follow(const std::string& field, const std::string& wanted_by, Need& need);
  void mark(ScheduledPass& scheduled, Need& need);
  [[nodiscard]] std::vector<ScheduledPass*> makers(const std::string& field, bool for_integration);
  void order_phase(Phase phase);
  using Before = std::map<std::size_t, std::map<std::size_t, std::string>>;
  void find_before_velocity(const std::vector<std::size_t>& members, const Before& before);
  [[nodiscard]] bool makes_any(const ScheduledPass& scheduled, const std::set<std::string>& fields) const;
  [[nodiscard]] bool makes(const ScheduledPass& scheduled, const std::string& field) const;
  [[nodiscard]] std::vector<std::string> sources(const ScheduledPass& scheduled) const;

  const Catalogue& catalogue_;
  std::vector<Reader> readers_;
  std::vector<ScheduledPass> passes_;
  std::array<std::vector<std::size_t>, 4> order_;
  std::set<std::string> derived_for_integration_;
  std::vector<std::set<std::string>> derived_for_reader_;
  Transport transport_;
  std::vector<LinearTerms> staged_;
  std::set<std::size_t> before_velocity_;
};

}  // namespace mesogen
