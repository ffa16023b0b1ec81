#include "simulation/setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "case/nearest.hpp"
#include "case/resolved.hpp"
#include "initial/defects.hpp"
#include "initial/distortion.hpp"
#include "initial/fields.hpp"
#include "plugin/plugin_call.hpp"
#include "simulation/choose_backend.hpp"
#include "simulation/refusals.hpp"
#include "simulation/rounded_text.hpp"
#include "simulation/smoothing.hpp"
#include "sph/lattice.hpp"
#include "sph/standard_passes.hpp"

namespace mesogen {

namespace {

// Of the largest stable step: disordered particles take the shortest waves down up to a tenth faster than a lattice
// does, and diffusion is not alone.
constexpr double diffusion_margin = 0.6;

/// See TimeScheme.
double stable_rate(const std::string& scheme) { return scheme == "midpoint" ? 1.0 : 2.0; }

/// One case being set up: the steps in order, each leaving its problems.
class SetupBuilder {
 public:
  SetupBuilder(Setup& setup, const PluginRegistry& registry, Problems& problems, const SetupAdditions& additions)
      : setup_(setup),
        source_(setup.source),
        registry_(registry),
        problems_(problems),
        additions_(additions),
        resolved_(setup.source) {}

  void choose_backend();
  void make_plugins();
  void choose_kernel();
  void place_defects();
  void put_together();
  [[nodiscard]] bool refused() const { return refused_; }

 private:
  template <class Make>
  auto make(const PluginChoice& choice, Make&& made) -> decltype(made(choice.type));
  void read(const PluginChoice& choice, const ParameterList& list);
  template <class Action>
  void attempt(const PluginChoice& choice, Action&& action);
  void describe_scene();
  void find_distortion();
  void collect_fields();
  void choose_output();
  void plan_observers();

  Setup& setup_;
  const Case& source_;
  const PluginRegistry& registry_;
  Problems& problems_;
  const SetupAdditions& additions_;
  ResolvedCase resolved_;
  bool refused_ = false;
};

template <class Make>
auto SetupBuilder::make(const PluginChoice& choice, Make&& made) -> decltype(made(choice.type)) {
  if (choice.type.empty()) return nullptr;
  try {
    return made(choice.type);
  } catch (const Error& error) {
    refused_ = refused_ || error.code() == ExitCode::plugin_refused;
    problems_.add(choice.type_place, choice.type_key, error.what());
    return nullptr;
  }
}

// What a plugin finds wrong by itself is one problem among the others.
template <class Action>
void SetupBuilder::attempt(const PluginChoice& choice, Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    refused_ = refused_ || error.code() == ExitCode::plugin_refused;
    problems_.add(choice.section.place(), choice.section.path(), error.what());
  }
}

void SetupBuilder::read(const PluginChoice& choice, const ParameterList& list) {
  choice.read(list, problems_);
  resolved_.add(choice.section, list);
}

void SetupBuilder::choose_backend() {
  BackendChoice choice = mesogen::choose_backend(source_, registry_);
  setup_.backend = choice.backend;
  setup_.why_on_host = std::move(choice.why_on_host);
  if (!choice.problem.empty()) problems_.add(source_.place("run.device"), "run.device", choice.problem);
}

void SetupBuilder::make_plugins() {
  const auto simple = [&](const PluginChoice& choice, auto& plugin) {
    if (!plugin) return;
    bool understood = false;
    attempt(choice, [&] {
      ParameterList list;
      call_plugin(choice.type, "parameters()", [&] { plugin->parameters(list); });
      read(choice, list);
      understood = true;
    });
    if (!understood) plugin.reset();
  };
  setup_.boundary = make(source_.boundary,
                         [&](const std::string& type) { return registry_.make_boundary(type, source_.units.length); });
  simple(source_.boundary, setup_.boundary);
  setup_.kernel = make(source_.kernel, [&](const std::string& type) { return registry_.make_kernel(type); });
  simple(source_.kernel, setup_.kernel);
  for (const PluginChoice& choice : source_.physics) {
    const bool on_device = !setup_.backend->on_host() && registry_.has_cuda(choice.type);
    auto plugin = make(choice, [&](const std::string& type) {
      return on_device ? registry_.make_physics_for_cuda(type, source_.run.precision, 2)
                       : registry_.make_physics(type, source_.run.precision, 2);
    });
    simple(choice, plugin);
    if (plugin) setup_.physics.push_back({"physics." + choice.instance, std::move(plugin), {}, choice.type, on_device});
  }
  setup_.instruction_sets = "derivatives " + (setup_.backend->on_host() ? sph::instruction_set() : std::string("cuda"));
  for (const auto& member : setup_.physics)
    if (const LoadedPlugin* const plugin = registry_.find(PluginKind::physics, member.type))
      setup_.instruction_sets += ", " + member.type + " " + (member.on_device ? "cuda" : plugin->instruction_set);
  for (std::size_t n = 0; n < source_.observers.size(); ++n) {
    const PluginChoice& choice = source_.observers[n];
    auto plugin = make(choice, [&](const std::string& type) { return registry_.make_observer(type); });
    simple(choice, plugin);
    if (plugin)
      setup_.observers.push_back({choice.instance, std::move(plugin), {}, source_.timings[n], {}, choice.type});
  }
}

void SetupBuilder::choose_kernel() {
  if (!setup_.kernel || !(source_.particles.spacing > 0.0) || !(source_.smoothing_length_ratio > 0.0)) return;
  bool made = false;
  attempt(source_.kernel, [&] {
    setup_.smoothing.shape = call_plugin(source_.kernel.type, "shape()", [&] { return setup_.kernel->shape(); });
    made = true;
  });
  if (!made) return;
  if (const std::string problem = setup_.smoothing.shape.problem(); !problem.empty()) {
    problems_.add(source_.kernel.type_place, source_.kernel.type_key, "this kernel cannot be used: " + problem);
    return;
  }
  setup_.smoothing = smoothing_of(source_, std::move(setup_.smoothing.shape));
  if (const std::string problem = range_problem(source_, setup_.smoothing); !problem.empty())
    problems_.add(source_.place("particles.spacing"), "particles.spacing", problem);
  const bool walls = setup_.boundary && !setup_.boundary->periodic(shortest_axis(source_));
  if (const std::string problem = support_problem(source_, setup_.smoothing, walls); !problem.empty())
    problems_.add(source_.place("kernel.smoothing_length"), "kernel.smoothing_length", problem);
}

void SetupBuilder::place_defects() {
  if (!setup_.boundary || source_.domain.size.size() != 2) return;
  const std::array<bool, 3> periodic = {setup_.boundary->periodic(0), setup_.boundary->periodic(1), false};
  if (const std::string problem = fold_defects(setup_.source, periodic); !problem.empty())
    problems_.add(source_.place("director.defects"), "director.defects", problem);
}

void SetupBuilder::describe_scene() {
  Scene& scene = setup_.scene;
  setup_.arrangement = arrange(source_);
  scene.dimension = 2;
  scene.precision = source_.run.precision;
  scene.box = {source_.domain.size[0], source_.domain.size[1], 0.0};
  for (int d = 0; d < 2; ++d) scene.periodic[d] = setup_.boundary->periodic(d);
  scene.spacing = source_.particles.spacing;
  scene.smoothing_length = setup_.smoothing.smoothing_length;
  scene.support = setup_.smoothing.radius();
  scene.particle_count = setup_.arrangement.count;
  scene.diffusion_step =
      diffusion_margin * stable_rate(source_.time.scheme) /
      sph::largest_laplacian(setup_.smoothing, scene.spacing, scene.dimension, source_.laplacian == "consistent");
  for (std::size_t n = 0; n < setup_.physics.size(); ++n)
    attempt(source_.physics[n], [&] {
      const auto& member = setup_.physics[n];
      call_plugin(member.type, "constants()", [&] { member.plugin->constants(scene.constants); });
    });
  if (additions_.scene) additions_.scene(scene);
  attempt(source_.boundary, [&] { setup_.boundary->prepare(scene); });
  find_distortion();
  for (std::size_t n = 0; n < setup_.physics.size(); ++n)
    attempt(source_.physics[n], [&] {
      const auto& member = setup_.physics[n];
      call_plugin(member.type, "scales()", [&] { member.plugin->scales(scene, scene.scales); });
    });
  attempt(source_.boundary, [&] { setup_.boundary->scales(scene.scales); });
  if (source_.velocity.given) {
    const auto velocity = initial_velocity(source_, setup_.arrangement);
    for (std::size_t i = 0; i < velocity[0].size(); ++i)
      scene.scales.speed = std::max(scene.scales.speed, std::hypot(velocity[0][i], velocity[1][i]));
  }
  const auto for_each_physics = [&](const auto& action) {
    for (std::size_t n = 0; n < setup_.physics.size(); ++n)
      attempt(source_.physics[n], [&] { action(setup_.physics[n]); });
  };
  for_each_physics([&](const Setup::PhysicsMember& member) {
    call_plugin(member.type, "prepare()", [&] { member.plugin->prepare(scene); });
  });
  if (!problems_.empty()) return;
  for_each_physics([&](const Setup::PhysicsMember& member) {
    call_plugin(member.type, "constants()", [&] { member.plugin->constants(scene.constants); });
  });
  for_each_physics([&](const Setup::PhysicsMember& member) {
    call_plugin(member.type, "step_limits()", [&] {
      member.plugin->step_limits(scene, setup_.limits);
      for (const auto& limit : setup_.limits.all())
        if (!(limit.seconds > 0.0))
          throw Error(ExitCode::plugin_refused, "the limit on the step \"" + limit.name + "\" is " +
                                                    rounded_text(limit.seconds) + " " + source_.units.time +
                                                    ": it must be above 0");
    });
  });
}

// Of a boundary that refused its parameters nothing more is asked.
void SetupBuilder::find_distortion() {
  if (!source_.director.given || !problems_.empty()) return;
  attempt(source_.boundary, [&] {
    setup_.scene.distortion =
        distortion_of(initial_order_tensor(source_, setup_.arrangement), setup_.arrangement.position, setup_.scene,
                      *setup_.boundary, setup_.smoothing);
  });
}

void SetupBuilder::collect_fields() {
  for (std::size_t n = 0; n < setup_.physics.size(); ++n)
    attempt(source_.physics[n], [&] {
      auto& member = setup_.physics[n];
      call_plugin(member.type, "passes()", [&] { member.plugin->passes(member.passes); });
      for (const FieldDeclaration& field : member.passes.fields()) setup_.catalogue.add(field, member.instance);
    });
  const auto initial = [&](const std::string& name, Rank rank, const std::string& unit, const std::string& owner) {
    FieldDeclaration field;
    field.name = name;
    field.rank = rank;
    field.unit_text = unit;
    field.doc_text = "as the initial conditions set it";
    setup_.catalogue.add_initial(field, owner);
  };
  if (source_.director.given) initial("order_tensor", Rank::order_tensor, "1", "director");
  if (source_.velocity.given) initial("velocity", Rank::vector, "m/s", "velocity");
  if (source_.colour.given) initial("colour", Rank::scalar, "1", "colour");
  if (additions_.fields) additions_.fields(setup_);
  const auto* const order_tensor = setup_.catalogue.find("order_tensor");
  if (order_tensor != nullptr && !order_tensor->initial)
    problems_.add({source_.file, 0, 0}, "director",
                  "this scene has an order tensor: say how it starts, such as [director] with type = \"perturbed\"");
}

void SetupBuilder::choose_output() {
  for (const std::string& field : source_.output.fields) {
    if (field == "position") continue;
    if (setup_.catalogue.exists(field)) {
      setup_.output_fields.push_back(field);
    } else if (source_.output.fields_given) {
      std::string text = "there is no field '" + field + "' in this scene";
      if (const std::string near = nearest(field, setup_.catalogue.names()); !near.empty())
        text += "; did you mean '" + near + "'";
      std::string all;
      for (const std::string& name : setup_.catalogue.names()) all += (all.empty() ? "" : ", ") + name;
      problems_.add(source_.place("output.fields"), "output.fields",
                    text + ". There are: position, " + all + ", and X_gradient and X_laplacian of each X");
    }
  }
  resolved_.set_output_fields(setup_.output_fields);
}

void SetupBuilder::plan_observers() {
  for (std::size_t n = 0; n < setup_.observers.size(); ++n)
    attempt(source_.observers[n], [&] {
      auto& member = setup_.observers[n];
      call_plugin(member.type, "plan()", [&] { member.plugin->plan(setup_.scene, member.plan); });
      member.fields = member.plan.read_list();
      for (const std::string& field : member.plan.optional_list())
        if (setup_.catalogue.exists(field)) member.fields.push_back(field);
    });
}

void SetupBuilder::put_together() {
  // Fields depend on which plugins there are, the rest on sound parameters too.
  const bool all_made =
      setup_.physics.size() == source_.physics.size() && setup_.observers.size() == source_.observers.size();
  const bool sound = problems_.empty();
  if (!all_made || source_.tree == nullptr) return;
  if (sound) describe_scene();
  collect_fields();
  choose_output();
  if (!sound) return;
  plan_observers();
  refuse_traces(setup_, problems_);
  if (!problems_.empty()) return;
  if (additions_.readers) additions_.readers(setup_);
  std::vector<StepGraph::Member> members;
  for (const auto& member : setup_.physics)
    members.push_back({member.instance, &member.passes, member.type, member.on_device});
  std::vector<Reader> readers;
  for (const auto& member : setup_.observers) readers.push_back({"observers." + member.instance, member.fields});
  readers.push_back({"output.fields", setup_.output_fields});
  setup_.graph = std::make_unique<StepGraph>(setup_.catalogue, members, readers, *setup_.backend);
  refuse_few_neighbours(setup_, problems_);
  setup_.resolved_text = resolved_.text();
}

}  // namespace

std::unique_ptr<Setup> set_up(Case source, const PluginRegistry& registry, Problems& problems,
                              const SetupAdditions& additions) {
  auto setup = std::make_unique<Setup>(std::move(source));
  SetupBuilder builder(*setup, registry, problems, additions);
  builder.choose_backend();
  builder.make_plugins();
  builder.choose_kernel();
  builder.place_defects();
  try {
    builder.put_together();
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_case) throw;
    problems.add_lines({setup->source.file, 0, 0}, error.what());
  }
  if (problems.empty() && !setup->graph) throw std::logic_error("a case without problems could not be set up");
  if (!problems.empty())
    throw Error(builder.refused() ? ExitCode::plugin_refused : ExitCode::bad_case, problems.text());
  return setup;
}

}  // namespace mesogen
