#include "schedule/step_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "mesogen/diagnostics/error.hpp"
#include "schedule/advection.hpp"
#include "schedule/derived_name.hpp"
#include "text/nearest.hpp"

namespace mesogen {

namespace {

bool contains(const std::vector<std::string>& list, const std::string& what) {
  return std::find(list.begin(), list.end(), what) != list.end();
}

}  // namespace

struct StepGraph::Need {
  std::set<std::string> seen;
  std::set<std::string>* derived;
  std::vector<std::string> chain;
  std::size_t reader;  // whose need it is, if not the integration's
  bool integration;
};

StepGraph::StepGraph(const Catalogue& catalogue, const std::vector<Member>& members, const std::vector<Reader>& readers,
                     const Backend& backend, bool stabilised)
    : catalogue_(catalogue), readers_(readers) {
  for (const Member& member : members) {
    for (const Pass& pass : member.passes->passes()) {
      ScheduledPass scheduled;
      scheduled.owner = member.instance;
      scheduled.plugin = member.plugin;
      scheduled.pass = pass;
      scheduled.on_device = member.on_device;
      scheduled.for_observer.assign(readers.size(), false);
      scheduled.counter = {scheduled.title(), "plugin"};
      passes_.push_back(std::move(scheduled));
    }
    if (member.passes->transport().velocity.empty()) continue;
    if (!transport_.velocity.empty())
      throw Error(ExitCode::bad_case,
                  "two physics plugins move the particles, the second is " + member.instance + ": a case has one flow");
    transport_ = member.passes->transport();
  }
  add_advection(backend);
  add_linear_terms(members, backend, stabilised);
  check_fields();
  check_writers();

  Need integration{{}, &derived_for_integration_, {}, 0, true};
  for (const auto& [name, entry] : catalogue_.all())
    if (has_rate(entry.declaration.advance)) {
      follow(entry.declaration.rate, "the time integration", integration);
    } else if (entry.declaration.advance == Advance::by_passes) {
      follow(name, "the time integration", integration);
    }
  for (const std::string& field : {transport_.velocity, transport_.shift})
    if (!field.empty()) follow(field, "the time integration", integration);
  for (const LinearTerms& terms : staged_) {
    if (terms.diffusion.any()) follow("volume", "the time integration", integration);
    for (const std::string& field : terms.fields()) follow(field, "the time integration", integration);
  }
  for (ScheduledPass& scheduled : passes_)
    if (scheduled.pass.at_every_step) mark(scheduled, integration);
  if (sums_pairs())
    for (ScheduledPass& scheduled : passes_)
      if (scheduled.pass.beside_sums && !scheduled.pass.adds_nothing && makes_any(scheduled, integration.seen))
        mark(scheduled, integration);

  derived_for_reader_.resize(readers_.size());
  for (std::size_t n = 0; n < readers_.size(); ++n) {
    Need need{{}, &derived_for_reader_[n], {}, n, false};
    for (const std::string& field : readers_[n].fields) follow(field, readers_[n].name, need);
  }
  for (const Phase phase : {Phase::begin, Phase::rates, Phase::end, Phase::observe}) order_phase(phase);
}

// What changes because particles do not go exactly with the fluid.
void StepGraph::add_advection(const Backend& backend) {
  if (transport_.fixed || std::none_of(passes_.begin(), passes_.end(), [&](const ScheduledPass& scheduled) {
        return makes(scheduled, transport_.shift) && !scheduled.pass.adds_nothing;
      }))
    transport_.shift.clear();
  if (!transport_.advects()) return;
  for (const auto& [name, entry] : catalogue_.all()) {
    // A shift carries no density: continuity keeps that even, and its gradient would cost a pass. Nor the velocity:
    // momentum would drift three times as much.
    const Advance advance = entry.declaration.advance;
    const bool carried = advance == Advance::predicted && name != transport_.velocity;
    if (!has_rate(advance) || !(carried || transport_.fixed)) continue;
    add_own("framework", advection_pass(entry.declaration, transport_, backend));
  }
}

void StepGraph::add_linear_terms(const std::vector<Member>& members, const Backend& backend, bool stabilised) {
  std::vector<LinearTerms> all;
  for (const Member& member : members) mesogen::add_linear_terms(member.instance, *member.passes, all);
  for (const LinearTerms& terms : all) {
    const auto components = [&](const std::string& field) { return catalogue_.components(field); };
    if (catalogue_.exists(terms.rate) && catalogue_.exists(terms.field) &&
        components(terms.rate) != components(terms.field))
      throw Error(ExitCode::plugin_refused, terms.owner + " declares '" + terms.rate + "' as the rate of '" +
                                                terms.field + "', which has another number of components");
    if (!stabilised || !can_be_staged(terms, catalogue_)) {
      add_own(terms.owner, linear_pass(terms, catalogue_, backend));
      continue;
    }
    staged_.push_back(terms);
    // So that there is a rate, and a new one at each step, where nobody else adds to it.
    Pass pass;
    pass.name = "stages of " + terms.field;
    pass.accumulates({terms.rate}).run([](const PassContext&) {});
    for (const std::string& field : terms.fields()) pass.reads({field});
    if (!terms.damps()) pass.conserves_momentum();
    add_own(terms.owner, std::move(pass));
  }
}

// A pass of the framework, by itself or for a plugin.
void StepGraph::add_own(const std::string& owner, Pass pass) {
  ScheduledPass scheduled;
  scheduled.owner = owner;
  scheduled.pass = std::move(pass);
  scheduled.on_device = true;
  scheduled.for_observer.assign(readers_.size(), false);
  scheduled.counter = {scheduled.title()};
  passes_.push_back(std::move(scheduled));
}

bool StepGraph::stages_velocity() const {
  return std::ranges::any_of(staged_, [&](const LinearTerms& terms) { return terms.field == transport_.velocity; });
}

bool StepGraph::makes_any(const ScheduledPass& scheduled, const std::set<std::string>& fields) const {
  return std::any_of(fields.begin(), fields.end(), [&](const std::string& field) { return makes(scheduled, field); });
}

bool StepGraph::makes(const ScheduledPass& scheduled, const std::string& field) const {
  return contains(scheduled.pass.write_list, field) || contains(scheduled.pass.accumulate_list, field);
}

// Every field that a pass names must be there, also of a pass that nobody needs: a plugin that can do nothing here is
// a mistake in the case.
void StepGraph::check_fields() const {
  for (const ScheduledPass& scheduled : passes_) {
    const auto check = [&](const std::vector<std::string>& fields, const std::string& does) {
      for (const std::string& field : fields)
        if (!catalogue_.exists(field)) {
          if (field == "position")
            throw Error(ExitCode::plugin_refused,
                        fmt::format("'{}' {} 'position', which is no field: a pass takes coordinates from "
                                    "context.position(axis), without naming them",
                                    scheduled.title(), does));
          const std::string meant = did_you_mean(field, catalogue_.names());
          throw Error(ExitCode::bad_case,
                      fmt::format("'{}' {} '{}', which no plugin of this case introduces{} Add one that does (`mesogen "
                                  "plugin info` tells), or remove '{}'",
                                  scheduled.title(), does, field, meant.empty() ? "." : meant, scheduled.owner));
        }
    };
    check(scheduled.pass.own_reads, "reads");
    check(scheduled.pass.neighbour_reads, "reads");
    check(scheduled.pass.write_list, "writes");
    check(scheduled.pass.accumulate_list, "adds to");
    if (scheduled.pass.adds_nothing && !scheduled.pass.write_list.empty())
      throw Error(ExitCode::plugin_refused, "'" + scheduled.title() + "' is idle and writes '" +
                                                scheduled.pass.write_list.front() +
                                                "': idle_if is for passes that only add to fields");
    if (scheduled.pass.beside_sums && !scheduled.pass.write_list.empty())
      throw Error(ExitCode::plugin_refused, "'" + scheduled.title() + "' runs beside pair sums and writes '" +
                                                scheduled.pass.write_list.front() +
                                                "': beside_pair_sums is for passes that only add to fields");
    if (scheduled.pass.phase == Phase::observe) {
      if (!scheduled.pass.accumulate_list.empty())
        throw Error(ExitCode::plugin_refused, "'" + scheduled.title() + "' adds to '" +
                                                  scheduled.pass.accumulate_list.front() +
                                                  "' for readers: a pass of Phase::observe writes what it makes");
      for (const std::string& field : scheduled.pass.write_list)
        if (catalogue_.outlasts_step(field))
          throw Error(
              ExitCode::plugin_refused,
              "'" + scheduled.title() + "' writes '" + field +
                  "' for readers, which keeps its value from step to step: an observation must not change the run");
    }
    for (const auto* const list : {&scheduled.pass.write_list, &scheduled.pass.accumulate_list})
      for (const std::string& field : *list)
        if (const auto* const entry = catalogue_.find(field); entry != nullptr && entry->initial &&
                                                              !has_rate(entry->declaration.advance) &&
                                                              entry->declaration.advance != Advance::by_passes)
          throw Error(ExitCode::bad_case, "[" + entry->set_by + "] sets '" + field + "', which '" + scheduled.title() +
                                              "' makes at each step: remove that section");
        else if (catalogue_.is_prescribed(field))
          throw Error(ExitCode::bad_case, "'" + scheduled.title() + "' makes '" + field + "', which " +
                                              catalogue_.find(field)->owner +
                                              " prescribes: give a number there, or remove one of the two");
        else if (catalogue_.is_state(field))
          throw Error(ExitCode::plugin_refused,
                      "'" + scheduled.title() + "' writes '" + field +
                          "', which keeps its value from step to step: add to its rate of change instead");
  }
}

void StepGraph::check_writers() const {
  std::map<std::pair<Phase, std::string>, const ScheduledPass*> writer;
  for (const ScheduledPass& scheduled : passes_) {
    for (const std::string& field : scheduled.pass.write_list) {
      const auto [at, first] = writer.emplace(std::pair{scheduled.pass.phase, field}, &scheduled);
      if (!first)
        throw Error(ExitCode::bad_case, "field '" + field + "' has two writers: '" + at->second->title() + "' and '" +
                                            scheduled.title() +
                                            "'. Remove one of them from the case, or let both accumulate");
    }
  }
}

// Marks everything that must run so that `field` has a value.
void StepGraph::follow(const std::string& field, const std::string& wanted_by, Need& need) {
  if (!need.seen.insert(field).second) return;
  need.chain.push_back("'" + field + "', wanted by " + wanted_by);
  if (catalogue_.find(field) == nullptr) {
    const DerivedName derived = derived_name(field);
    if (derived.kind != DerivedName::Kind::none) {
      if (!derived.source.empty()) follow(derived.source, "'" + field + "'", need);
      need.derived->insert(field);
      need.chain.pop_back();
      return;
    }
  }
  const bool given = catalogue_.is_prescribed(field);
  if (given)
    for (const std::string& source : catalogue_.find(field)->sources) follow(source, "'" + field + "'", need);
  bool made = given || catalogue_.is_state(field);
  if (!made) {
    for (ScheduledPass* const scheduled : makers(field, need.integration)) {
      made = true;
      if (!scheduled->pass.adds_nothing && !scheduled->pass.beside_sums) mark(*scheduled, need);
    }
  }
  if (!made) {
    std::string chain;
    for (auto link = need.chain.rbegin(); link != need.chain.rend(); ++link) chain.append("\n  ").append(*link);
    throw Error(ExitCode::bad_case,
                "nobody in this case provides the field" + chain +
                    "\nAdd a physics plugin that writes it (`mesogen plugin list`), or remove what needs it");
  }
  need.chain.pop_back();
}

void StepGraph::mark(ScheduledPass& scheduled, Need& need) {
  if (need.integration) {
    scheduled.for_integration = true;
  } else {
    scheduled.for_observer[need.reader] = true;
  }
  for (const std::string& source : sources(scheduled)) follow(source, "'" + scheduled.title() + "'", need);
}

// A reader takes what is made for it at the end of the step, if anything is.
std::vector<ScheduledPass*> StepGraph::makers(const std::string& field, bool for_integration) {
  std::vector<ScheduledPass*> in_step;
  std::vector<ScheduledPass*> for_readers;
  for (ScheduledPass& scheduled : passes_)
    if (makes(scheduled, field)) (scheduled.pass.phase == Phase::observe ? for_readers : in_step).push_back(&scheduled);
  return for_integration || for_readers.empty() ? in_step : for_readers;
}

bool StepGraph::sums_pairs() const {
  return !derived_for_integration_.empty() ||
         std::any_of(passes_.begin(), passes_.end(), [](const ScheduledPass& scheduled) {
           return scheduled.for_integration && !scheduled.pass.neighbour_reads.empty();
         });
}

std::vector<std::string> StepGraph::sources(const ScheduledPass& scheduled) const {
  std::vector<std::string> all = scheduled.pass.own_reads;
  all.insert(all.end(), scheduled.pass.neighbour_reads.begin(), scheduled.pass.neighbour_reads.end());
  for (const std::string& field : scheduled.pass.optional_reads)
    if (catalogue_.exists(field)) all.push_back(field);
  return all;
}

}  // namespace mesogen
