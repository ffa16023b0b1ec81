#include "case/framework_keys.hpp"

#include <utility>

#include "mesogen/particles/dimensions.hpp"

namespace mesogen::case_keys {

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      {.name = "", .doc = "Before the first section."},
      {.name = "units",
       .doc =
           "Units of all numbers of the case, for messages, pictures and results. No number is converted: with um, s "
           "and pN a viscosity is in pN s/um2, a density in pN s2/um4."},
      {.name = "domain", .doc = "The box.", .required = true},
      {.name = "domain.boundary",
       .doc =
           "What lies beyond the faces of the box: the name of a boundary plugin, or a table with its type and keys.",
       .required = true,
       .plugin = PluginKind::boundary},
      {.name = "particles", .doc = "How the box is filled.", .required = true},
      {.name = "kernel", .doc = "The smoothing kernel.", .required = true, .plugin = PluginKind::kernel},
      {.name = "NAME",
       .doc = "An initial condition: what the particles carry when the run starts. The section has the name of the "
              "plugin, such as [director] or [velocity].",
       .plugin = PluginKind::initial},
      {.name = "physics",
       .doc = "What happens: at least one table, named at will, such as [physics.flow].",
       .required = true,
       .instances = true,
       .plugin = PluginKind::physics},
      {.name = "time", .doc = "How long, and in which steps.", .required = true},
      {.name = "output", .doc = "What is stored of the particles, and when."},
      {.name = "observers",
       .doc = "What is recorded: tables named at will, such as [observers.defects]. Each samples at the start, at the "
              "end, and as `interval` or `every` says.",
       .instances = true,
       .plugin = PluginKind::observer},
      {.name = "run", .doc = "How it is computed."},
  };
  return all;
}

ParameterList title(std::string& title) {
  ParameterList list;
  list.text("title", title).doc("what the case is, for people");
  return list;
}

ParameterList units(Units& units) {
  ParameterList list;
  list.text("length", units.length).doc("unit of lengths, such as um");
  list.text("time", units.time).doc("unit of times, such as ms");
  list.text("force", units.force).doc("unit of forces, such as pN");
  return list;
}

ParameterList domain(Case::Domain& domain) {
  ParameterList list;
  const std::vector<int> built = built_dimensions.list();
  list.numbers("size", domain.size)
      .unit("m")
      .doc("edge lengths of the box, one for each dimension")
      .above(0.0)
      .sizes({built.begin(), built.end()})
      .required();
  return list;
}

ParameterList particles(Case::Particles& particles) {
  ParameterList list;
  list.number("spacing", particles.spacing).unit("m").doc("distance of particles").above(0.0).required();
  list.text("arrangement", particles.arrangement)
      .doc("where particles start")
      .choices({"lattice", "hexagonal", "jittered"});
  list.integer("seed", particles.seed).doc("of the random numbers");
  list.number("jitter", particles.jitter)
      .doc("largest shift along each axis, in spacings")
      .at_least(0.0)
      .at_most(0.5)
      .only_with("arrangement", {"jittered"});
  return list;
}

ParameterList kernel(double& smoothing_length_ratio, std::string& laplacian) {
  ParameterList list;
  list.number("smoothing_length", smoothing_length_ratio).doc("smoothing length h in particle spacings").above(0.0);
  list.text("laplacian", laplacian)
      .doc(
          "how second derivatives are summed: plain is cheaper and wants evenly spread particles; consistent is exact "
          "for quadratic fields on any")
      .choices({"plain", "consistent"});
  return list;
}

ParameterList time(Case::Time& time) {
  ParameterList list;
  list.number("end", time.end).unit("s").doc("simulated time to run").above(0.0).required();
  list.number_or("step", time.step, "auto")
      .unit("s")
      .doc("time step; shortened where a sample, a frame or a kept checkpoint is asked for between two steps")
      .above(0.0);
  list.text("scheme", time.scheme)
      .choices({"half_steps", "midpoint"})
      .doc("velocity and order tensor advanced by halves of the rates before and after, or by the midpoint's alone");
  list.number("factor", time.factor)
      .doc("automatic step in multiples of its stability limit")
      .above(0.0)
      .only_with("step", {"auto"});
  return list;
}

ParameterList output(Case::Output& output) {
  ParameterList list;
  list.number("interval", output.interval)
      .unit("s")
      .doc(
          "simulated time between stored frames; by default the whole run. Steps end exactly on these times: they are "
          "shortened for that, so another interval changes the steps, and rounding with them")
      .above(0.0);
  list.number("checkpoint_interval", output.checkpoint_interval)
      .unit("s of wall time")
      .doc("time between checkpoints, from which a run that was broken off goes on; only the newest two stay")
      .above(0.0);
  list.numbers("checkpoint_times", output.checkpoint_times)
      .unit("s")
      .doc(
          "simulated times of checkpoints that stay for good, in the run's folder `checkpoints`: `mesogen branch --at` "
          "starts new runs from them")
      .above(0.0);
  list.number_or("checkpoint_every", output.checkpoint_every, "")
      .unit("s")
      .doc("simulated time between such checkpoints; beside checkpoint_times: both")
      .above(0.0);
  list.texts("fields", output.fields)
      .doc("stored fields of the particles, beside their positions; by default those that their plugins show");
  return list;
}

ParameterList run(Case::Run& run, std::string& precision) {
  ParameterList list;
  list.text("precision", precision).doc("arithmetic of the pair sums").choices({"single", "double"});
  list.text("device", run.device)
      .doc(
          "where it computes: the first CUDA device, or with \"auto\" there if there is one and all physics plugins "
          "have "
          "code for it")
      .choices({"cpu", "cuda", "auto"});
  return list;
}

ParameterList plugin(std::string& type) {
  ParameterList list;
  list.text("type", type).doc("name of the plugin").required();
  return list;
}

ParameterList timing(ObserverTiming& timing, std::int64_t& every) {
  ParameterList list;
  list.number_or("interval", timing.interval, "")
      .unit("s")
      .doc(
          "simulated time between samples. Steps end exactly on these times: they are shortened for that, so another "
          "interval changes the steps. Observing itself changes nothing")
      .above(0.0);
  list.integer("every", every)
      .unit("steps")
      .doc("steps between samples; not beside interval. Leaves the steps as they are")
      .at_least(1.0);
  return list;
}

}  // namespace mesogen::case_keys
