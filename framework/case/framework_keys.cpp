#include "case/framework_keys.hpp"

#include <utility>

#include "mesogen/fields/dimensions.hpp"

namespace mesogen::case_keys {

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      {.name = "", .doc = "Keys that stand before the first section."},
      {.name = "units",
       .doc = "Units of all numbers of the case; messages, pictures and results use them too. No number is converted: "
              "with um, s and pN, a viscosity is in pN s/um2 and a density in pN s2/um4."},
      {.name = "domain", .doc = "The box that the particles fill.", .required = true},
      {.name = "domain.boundary",
       .doc = "What is beyond the faces of the box: the name of a boundary plugin, or a table with its type and keys.",
       .required = true,
       .plugin = PluginKind::boundary},
      {.name = "solids",
       .doc = "Solids in the box, or around the fluid: tables with names of your choice, such as [solids.pillar]. The "
              "fluid is where no solid is. What is at the faces of the box is for domain.boundary to say.",
       .instances = true,
       .plugin = PluginKind::shape,
       .chooser = "shape"},
      {.name = "particles", .doc = "How particles fill the box at the start.", .required = true},
      {.name = "kernel", .doc = "The smoothing kernel.", .required = true, .plugin = PluginKind::kernel},
      {.name = "NAME",
       .doc = "An initial condition: what the particles carry when the run starts. The section has the name of the "
              "plugin, such as [director] or [velocity].",
       .plugin = PluginKind::initial},
      {.name = "physics",
       .doc = "The physics: at least one table with a name of your choice, such as [physics.flow].",
       .required = true,
       .instances = true,
       .plugin = PluginKind::physics},
      {.name = "time", .doc = "How much time the run simulates, and in which steps.", .required = true},
      {.name = "output", .doc = "What is stored of the particles, and when."},
      {.name = "observers",
       .doc = "What is recorded: tables with names of your choice, such as [observers.defects]. Each observer samples "
              "at the start, at the end, and in between as `interval` or `every` says.",
       .instances = true,
       .plugin = PluginKind::observer},
      {.name = "run", .doc = "How the run is computed."},
  };
  return all;
}

ParameterList title(std::string& title) {
  ParameterList list;
  list.text("title", title).doc("title of the case, for people who read it");
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
  list.number("spacing", particles.spacing)
      .unit("m")
      .doc("distance between neighbouring particles at the start")
      .above(0.0)
      .required();
  list.text("arrangement", particles.arrangement)
      .doc("how particles are arranged at the start")
      .choices({"lattice", "hexagonal", "jittered"});
  list.integer("seed", particles.seed).doc("seed of the random numbers");
  list.number("jitter", particles.jitter)
      .doc("largest random shift of a particle along each axis, in spacings")
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
          "how second derivatives are summed. plain: costs less, but needs evenly spread particles; consistent: exact "
          "for quadratic fields however the particles lie")
      .choices({"plain", "consistent"});
  return list;
}

ParameterList time(Case::Time& time) {
  ParameterList list;
  list.number("end", time.end).unit("s").doc("simulated time to run").above(0.0).required();
  list.number_or("step", time.step, "auto")
      .unit("s")
      .doc(
          "time step; auto: as the stability limits of all plugins allow. A step is shortened to end exactly at a "
          "sample, a frame or a kept checkpoint")
      .above(0.0);
  list.text("scheme", time.scheme)
      .choices({"half_steps", "midpoint"})
      .doc(
          "how velocity and order tensor are advanced. midpoint: by the rate at the midpoint of the step; half_steps: "
          "by half of this rate and half of the one a step earlier, as published");
  list.text("stepping", time.stepping)
      .choices({"auto", "explicit", "stabilised"})
      .doc(
          "explicit: viscosity, elasticity and friction limit the step. stabilised: they are taken in stages and limit "
          "no "
          "step; a step costs more. auto: stabilised where the whole run is expected to take less time that way");
  list.number("factor", time.factor)
      .doc("automatic step in multiples of its stability limit; above 1 a run may break down")
      .above(0.0)
      .only_with("step", {"auto"});
  return list;
}

ParameterList output(Case::Output& output) {
  ParameterList list;
  list.number("interval", output.interval)
      .unit("s")
      .doc(
          "simulated time between stored frames; by default the whole run. Steps are shortened to end exactly at these "
          "times, so another interval changes the steps, and with them the rounding")
      .above(0.0);
  list.number("checkpoint_interval", output.checkpoint_interval)
      .unit("s of wall time")
      .doc(
          "wall time between checkpoints, from which `mesogen resume` continues a run that was interrupted; only the "
          "newest two are kept")
      .above(0.0);
  list.numbers("checkpoint_times", output.checkpoint_times)
      .unit("s")
      .doc(
          "simulated times of checkpoints that are kept for good, in the run's folder `checkpoints`; `mesogen branch "
          "--at` starts new runs from them")
      .above(0.0);
  list.number_or("checkpoint_every", output.checkpoint_every, "")
      .unit("s")
      .doc("simulated time between checkpoints that are kept for good; those of checkpoint_times are kept in addition")
      .above(0.0);
  list.texts("fields", output.fields)
      .doc("fields that frames store in addition to the positions; by default those that the plugins mark as shown");
  return list;
}

ParameterList run(Case::Run& run, std::string& precision) {
  ParameterList list;
  list.text("precision", precision)
      .doc(
          "precision of sums over neighbours and of derived fields; fields that are advanced in time are always double")
      .choices({"single", "double"});
  list.text("device", run.device)
      .doc(
          "where the run is computed. cpu: on the host; cuda: on the first CUDA device; auto: on that device if there "
          "is one and all physics plugins have code for it, otherwise on the host")
      .choices({"cpu", "cuda", "auto"});
  return list;
}

ParameterList solid(Case::Solid& solid) {
  ParameterList list;
  list.text("fluid", solid.fluid)
      .choices({"inside", "outside"})
      .doc("on which side of the shape's surface the fluid is; the other side is solid");
  const std::vector<int> built = built_dimensions.list();
  list.numbers("velocity", solid.velocity)
      .unit("m/s")
      .sizes({built.begin(), built.end()})
      .doc("velocity of the surface; the solid stays");
  list.number("angular_velocity", solid.angular_velocity)
      .unit("rad/s")
      .doc("angular velocity of the surface about the centre of the shape, counterclockwise");
  list.word_or_number("slip", solid.slip, {"none", "free"})
      .unit("m")
      .at_least(0.0)
      .doc(
          "none: the fluid sticks to the surface; free: the surface takes no force along itself; a number: the slip "
          "length, the depth in the solid at which the velocity, continued straight, is that of the surface");
  const std::vector<std::string> anchored = {"tangential", "normal", "angle"};
  list.text("anchoring", solid.anchoring)
      .choices({"none", "tangential", "normal", "angle"})
      .doc("director at the surface. none: free (no torque); angle: at `angle` from the tangent");
  list.number("angle", solid.angle)
      .unit("degree")
      .at_least(-180.0)
      .at_most(180.0)
      .doc(
          "angle of the director from the tangent, counterclockwise; the tangent has the fluid at its left, so 90 "
          "points "
          "into the fluid")
      .only_with("anchoring", {"angle"});
  list.number_or("anchoring_strength", solid.anchoring_strength, "strong")
      .unit("N/m")
      .above(0.0)
      .doc(
          "strong: the surface holds the order tensor; a number W: it pulls the order tensor to Q_wall, by "
          "K dQ/dn = W (Q - Q_wall) with n into the fluid")
      .only_with("anchoring", anchored);
  list.number("order", solid.order)
      .at_least(0.0)
      .at_most(1.0)
      .doc("order q of Q_wall")
      .only_with("anchoring", anchored);
  return list;
}

ParameterList plugin(std::string& type, const std::string& chooser) {
  ParameterList list;
  list.text(chooser, type).doc("name of the plugin").required();
  return list;
}

ParameterList timing(ObserverTiming& timing, std::int64_t& every) {
  ParameterList list;
  list.number_or("interval", timing.interval, "")
      .unit("s")
      .doc(
          "simulated time between samples. Steps are shortened to end exactly at these times, so another interval "
          "changes the steps. The observation itself changes nothing")
      .above(0.0);
  list.integer("every", every)
      .unit("steps")
      .doc("number of steps between samples; not together with interval. Does not change the steps")
      .at_least(1.0);
  return list;
}

}  // namespace mesogen::case_keys
