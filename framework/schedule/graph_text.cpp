// The step graph for people: as text, and for Graphviz.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "schedule/step_graph.hpp"

namespace mesogen {

namespace {

constexpr Phase phases[] = {Phase::begin, Phase::rates, Phase::end, Phase::observe};

std::string_view name_of(Phase phase) {
  switch (phase) {
    case Phase::begin: return "begin";
    case Phase::rates: return "rates";
    case Phase::end: return "end";
    case Phase::observe: return "observe";
  }
  return "";
}

std::string needed_by(const ScheduledPass& scheduled, const std::vector<Reader>& readers) {
  if (scheduled.for_integration) return "the time integration";
  std::string names;
  for (std::size_t n = 0; n < readers.size(); ++n)
    if (scheduled.for_observer[n]) names += (names.empty() ? "" : ", ") + readers[n].name;
  return names.empty() ? "nobody" : names;
}

std::string quoted(const std::string& text) { return '"' + text + '"'; }

}  // namespace

std::string StepGraph::text() const {
  std::string text;
  const auto list = [](const char* title, const std::vector<std::string>& fields) {
    return fields.empty() ? std::string() : fmt::format("      {:<12}{}\n", title, fmt::join(fields, ", "));
  };
  for (const Phase phase : phases) {
    if (order(phase).empty()) continue;
    text += fmt::format("phase {}\n", name_of(phase));
    int number = 0;
    for (const std::size_t n : order(phase)) {
      const ScheduledPass& scheduled = passes_[n];
      text += fmt::format("  {:2}. {}", ++number, scheduled.title());
      if (!scheduled.for_integration) text += fmt::format("   (only when due: {})", needed_by(scheduled, readers_));
      text += '\n';
      text += list("reads", scheduled.pass.own_reads) + list("neighbours", scheduled.pass.neighbour_reads) +
              list("if present", scheduled.pass.optional_reads) + list("writes", scheduled.pass.write_list) +
              list("adds to", scheduled.pass.accumulate_list);
    }
  }
  if (!derived_for_integration_.empty())
    text += fmt::format("computed by the framework, every step\n      {}\n", fmt::join(derived_for_integration_, ", "));
  std::set<std::string> seldom;
  for (const auto& derived : derived_for_reader_)
    for (const std::string& field : derived)
      if (!derived_for_integration_.contains(field)) seldom.insert(field);
  if (!seldom.empty())
    text += fmt::format("computed by the framework, when an observer or a frame needs it\n      {}\n",
                        fmt::join(seldom, ", "));
  const Transport& flow = transport_;
  if (flow.velocity.empty()) {
    text += "nothing moves: neighbours are found once\n";
  } else if (flow.fixed) {
    text += fmt::format("{} flows past the particles: neighbours are found once\n", flow.velocity);
  } else {
    text += fmt::format("particles move with {}{}\n", flow.velocity, flow.shift.empty() ? "" : " and " + flow.shift);
  }
  const auto why_pruned = [](const Pass& pass) {
    if (pass.adds_nothing) return "with its parameters it adds nothing";
    return pass.beside_sums ? "nobody else sums over neighbours in a step" : "nobody needs what it makes";
  };
  for (const ScheduledPass& scheduled : passes_)
    if (scheduled.pruned()) text += fmt::format("pruned: {} ({})\n", scheduled.title(), why_pruned(scheduled.pass));
  return text;
}

std::string StepGraph::graphviz() const {
  std::string text = "digraph step {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
  std::set<std::string> fields;
  const auto edge = [&](const std::string& from, const std::string& to, const std::string& style) {
    text += fmt::format("  {} -> {}{};\n", quoted(from), quoted(to), style);
  };
  for (const Phase phase : phases) {
    text += fmt::format("  subgraph cluster_{0} {{\n    label=\"{0}\";\n", name_of(phase));
    for (const ScheduledPass& scheduled : passes_)
      if (scheduled.pass.phase == phase)
        text += fmt::format("    {} [shape=box{}];\n", quoted(scheduled.title()),
                            scheduled.pruned() ? ", style=dashed, color=gray, fontcolor=gray" : "");
    text += "  }\n";
  }
  for (const ScheduledPass& scheduled : passes_) {
    for (const std::string& field : sources(scheduled)) {
      edge(field, scheduled.title(), "");
      fields.insert(field);
    }
    for (const std::string& field : scheduled.pass.write_list) edge(scheduled.title(), field, "");
    for (const std::string& field : scheduled.pass.accumulate_list) edge(scheduled.title(), field, " [label=\"+\"]");
  }
  for (const Reader& reader : readers_) {
    text += fmt::format("  {} [shape=note];\n", quoted(reader.name));
    for (const std::string& field : reader.fields) {
      edge(field, reader.name, "");
      fields.insert(field);
    }
  }
  for (const std::string& field : fields)
    if (catalogue_.find(field) == nullptr)
      text += fmt::format("  {} [shape=box, style=rounded, color=blue];\n", quoted(field));
  return text + "}\n";
}

}  // namespace mesogen
