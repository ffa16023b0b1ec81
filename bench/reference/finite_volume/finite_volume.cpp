// A serial finite-volume solver of the equations of Mesogen, the grid method that particles are compared with. It
// shares no code with Mesogen. `finite_volume --help` lists its options.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "active_nematic.hpp"

namespace {

using namespace finite_volume;

struct Options {
  Scene scene;
  Stepping stepping;
  int cells = 48;
  double end = 60.0, interval = 10.0, tolerance = 1e-5;
  bool fft = false, csv = false;
};

constexpr double kLargest = 1e12;

/// name is "text", then what it should be.
std::invalid_argument refused(const std::string& name, const std::string& text, const std::string& rule) {
  std::ostringstream message;
  message << name << " is \"" << text << "\", " << rule;
  return std::invalid_argument(message.str());
}

double number(const std::string& name, const std::string& text, double low, double high) {
  char* rest = nullptr;
  const double value = std::strtod(text.c_str(), &rest);
  if (text.empty() || *rest != '\0' || !(value >= low && value <= high)) {
    std::ostringstream rule;
    rule << "not a number from " << low << " to " << high;
    throw refused(name, text, rule.str());
  }
  return value;
}

bool one_of(const std::string& name, const std::string& text, const std::string& yes, const std::string& no) {
  if (text != yes && text != no) throw refused(name, text, "not " + yes + " or " + no);
  return text == yes;
}

/// Waves "mx,my,amplitude,phase; ...".
std::vector<Wave> waves(const std::string& name, const std::string& text) {
  std::vector<Wave> found;
  std::istringstream list(text);
  for (std::string one; std::getline(list, one, ';');) {
    Wave wave{};
    char end = 0;
    if (std::sscanf(one.c_str(), " %lf , %lf , %lf , %lf %c", &wave.mx, &wave.my, &wave.amplitude, &wave.phase, &end) !=
        4) {
      throw refused("a wave of " + name, one, "not mx,my,amplitude,phase");
    }
    found.push_back(wave);
  }
  return found;
}

Scene case_of(const std::string& name) {
  Scene scene;
  if (name == "benchmark") return scene;
  if (name == "taylor_green") {  // U = 1 m/s, Re = 100: cases/accuracy/taylor_green
    scene.length = 1.0;
    scene.viscosity = 0.01;
    scene.activity = scene.elastic = scene.rotation = scene.alignment = 0.0;
    scene.director.clear();
    scene.stream = {{1, 1, 0.25 / std::numbers::pi, 0}, {1, -1, 0.25 / std::numbers::pi, 0}};
    return scene;
  }
  if (name == "relaxation") {  // a small wave of the director
    scene.flow = false;
    scene.director = {{1, 1, 0.01, 0.0}};
    return scene;
  }
  throw refused("case", name, "not benchmark, taylor_green or relaxation");
}

struct Setting {
  const char* doc;  // with unit and range
  std::function<void(Options&, const std::string& name, const std::string& value)> set;
};

Setting real(const char* doc, double Scene::*member, double low, double high) {
  return {doc, [=](Options& options, const std::string& name, const std::string& value) {
            options.scene.*member = number(name, value, low, high);
          }};
}

Setting real(const char* doc, double Options::*member, double low, double high) {
  return {doc, [=](Options& options, const std::string& name, const std::string& value) {
            options.*member = number(name, value, low, high);
          }};
}

const std::map<std::string, Setting>& settings() {
  using O = Options;
  using S = std::string;
  static const std::map<std::string, Setting> all{
      {"case",
       {"benchmark, taylor_green or relaxation; what is named after it changes it",
        [](O& o, const S&, const S& value) { o.scene = case_of(value); }}},
      {"cells",
       {"across the box, 4 to 8192, even; multigrid: 2^n times a number up to 15 (48)",
        [](O& o, const S& name, const S& value) {
          const double cells = number(name, value, 4.0, 8192.0);
          o.cells = static_cast<int>(cells);
          if (o.cells != cells || o.cells % 2 != 0) throw refused(name, value, "not even");
        }}},
      {"end", real("s, above 0 (60)", &O::end, 1e-9, kLargest)},
      {"interval", real("of the rows that are printed, s, above 0 (10)", &O::interval, 1e-9, kLargest)},
      {"step",
       {"s, above 0, or auto: what stability allows (auto)",
        [](O& o, const S& name, const S& value) {
          o.stepping.step = value == "auto" ? 0.0 : number(name, value, 1e-9, kLargest);
        }}},
      {"factor",
       {"of the step that stability allows, 0.0001 to 2 (1)",
        [](O& o, const S& name, const S& value) { o.stepping.factor = number(name, value, 1e-4, 2.0); }}},
      {"time_scheme",
       {"backward (differences of second order) or euler (backward)",
        [](O& o, const S& name, const S& value) {
          o.stepping.second_order = one_of(name, value, "backward", "euler");
        }}},
      {"pressure",
       {"multigrid or fft: solver for pressure and implicit diffusion (multigrid)",
        [](O& o, const S& name, const S& value) { o.fft = one_of(name, value, "fft", "multigrid"); }}},
      {"tolerance", real("of multigrid, residual over right side, 1e-12 to 0.1 (1e-5)", &O::tolerance, 1e-12, 0.1)},
      {"length", real("of the box, m, above 0 (10)", &Scene::length, 1e-9, kLargest)},
      {"density", real("rho, kg/m^3, above 0 (1)", &Scene::density, 1e-9, kLargest)},
      {"viscosity", real("mu, Pa s, 0 or more (2/3)", &Scene::viscosity, 0.0, kLargest)},
      {"activity", real("zeta, Pa; above 0 extensile (0.05)", &Scene::activity, -kLargest, kLargest)},
      {"elastic", real("K, N, 0 or more (0.02)", &Scene::elastic, 0.0, kLargest)},
      {"rotation", real("Gamma, 1/(Pa s), 0 or more (0.4)", &Scene::rotation, 0.0, kLargest)},
      {"alignment", real("lambda, -10 to 10 (0.7)", &Scene::alignment, -10.0, 10.0)},
      {"bulk_a", real("A, Pa (-1)", &Scene::bulk_a, -kLargest, kLargest)},
      {"bulk_c", real("C, Pa, 0 or more (0.5)", &Scene::bulk_c, 0.0, kLargest)},
      {"order", real("q at the start, 0 to 2 (1)", &Scene::order, 0.0, 2.0)},
      {"flow",
       {"inertia, or none: the fluid rests (inertia)",
        [](O& o, const S& name, const S& value) { o.scene.flow = one_of(name, value, "inertia", "none"); }}},
      {"director",
       {"waves of its angle at the start: \"mx,my,rad,phase; ...\"",
        [](O& o, const S& name, const S& value) { o.scene.director = waves(name, value); }}},
      {"stream",
       {"waves of the stream function at the start: \"mx,my,m^2/s,phase; ...\"",
        [](O& o, const S& name, const S& value) { o.scene.stream = waves(name, value); }}}};
  return all;
}

void set(Options& options, const std::string& name, const std::string& value) {
  const auto found = settings().find(name);
  if (found == settings().end()) throw std::invalid_argument("no option \"" + name + "\"; --help lists them");
  found->second.set(options, name, value);
}

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// Lines "name = value"; # begins a comment.
void read_file(Options& options, const std::string& name) {
  std::ifstream file(name);
  if (!file) throw std::invalid_argument("cannot read " + name);
  for (std::string line; std::getline(file, line);) {
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const auto equals = line.find('=');
    if (equals == std::string::npos) throw refused("a line of " + name, line, "not name = value");
    set(options, trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1)));
  }
}

void help() {
  std::puts(
      "finite_volume [--csv] [--parameters FILE] [--OPTION VALUE ...]\n"
      "Rows at each interval; FILE has lines OPTION = VALUE. Defaults in brackets, of the case benchmark.\n");
  for (const auto& [name, setting] : settings()) std::printf("  --%-12s %s\n", name.c_str(), setting.doc);
}

std::unique_ptr<EllipticSolver> solver_of(const Options& options) {
  const double h = options.scene.length / options.cells;
  if (options.fft) return std::make_unique<Fourier>(options.cells, h);
  auto multigrid = std::make_unique<Multigrid>(options.cells, h, options.tolerance);
  if (multigrid->coarsest() > 15) {
    throw std::invalid_argument("cells is " + std::to_string(options.cells) + ": multigrid halves it down to " +
                                std::to_string(multigrid->coarsest()) + ", more than 15; or take --pressure fft");
  }
  return multigrid;
}

void run(const Options& options) {
  ActiveNematic nematic(options.scene, options.stepping, options.cells, solver_of(options));
  std::puts(options.csv ? "time,v_rms,vorticity_rms,mean_order,angle_rms,divergence_rms,steps,processor_seconds,"
                          "pressure_share,diffusion_share,pressure_cycles"
                        : "t/s  v_rms/(m/s)  vorticity_rms s  mean_order  angle_rms/rad");
  const char* format = options.csv ? "%.9g,%.10g,%.10g,%.10g,%.10g" : "%-4.4g %.8f   %.8f       %.7f   %.8f";
  const auto print = [&] {
    std::printf(format, nematic.time(), nematic.v_rms(), nematic.vorticity_rms(), nematic.mean_order(),
                nematic.angle_rms());
    const Cost& cost = nematic.cost();
    const double total = cost.total > 0.0 ? cost.total : 1.0, steps = cost.steps > 0 ? double(cost.steps) : 1.0;
    if (options.csv) {
      std::printf(",%.3g,%ld,%.6g,%.4f,%.4f,%.3f", nematic.divergence_rms(), cost.steps, cost.total,
                  cost.pressure / total, cost.diffusion / total, double(cost.pressure_cycles) / steps);
    }
    std::printf("\n");
    std::fflush(stdout);
  };
  print();
  for (long row = 1; nematic.time() < options.end; ++row) {
    nematic.advance(std::min(options.end, options.interval * double(row)));
    print();
  }
  if (options.csv) return;
  const Cost& cost = nematic.cost();
  std::printf(
      "%d x %d cells, %ld steps, %.4g s of processor time: pressure %.0f %%, diffusion %.0f %%; %.1f %s a step\n",
      options.cells, options.cells, cost.steps, cost.total, 100.0 * cost.pressure / cost.total,
      100.0 * cost.diffusion / cost.total, double(cost.pressure_cycles) / double(cost.steps),
      options.fft ? "transforms" : "V cycles for the pressure");
}

}  // namespace

int main(int count, char** words) {
  try {
    Options options;
    const std::vector<std::string> arguments(words + 1, words + count);
    for (std::size_t n = 0; n < arguments.size(); ++n) {
      const std::string& word = arguments[n];
      if (word == "--help") {
        help();
        return 0;
      }
      if (word == "--csv") {
        options.csv = true;
      } else if (word.rfind("--", 0) != 0 || n + 1 == arguments.size()) {
        throw std::invalid_argument("\"" + word + "\" is not --OPTION VALUE; --help lists them");
      } else if (word == "--parameters") {
        read_file(options, arguments[++n]);
      } else {
        set(options, word.substr(2), arguments[n + 1]);
        ++n;
      }
    }
    run(options);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
