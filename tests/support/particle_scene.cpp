#include "particle_scene.hpp"

#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "test_plugins.hpp"

namespace mesogen::test {

namespace {

std::set<std::string> derived_from_f(bool stages) {
  std::set<std::string> all = {"volume", "correction", "f_gradient"};
  if (!stages) all.insert("f_laplacian");
  return all;
}

sph::SmoothingKernel smoothing(const ParticleScene::Options& options) {
  const double h = options.smoothing_length * options.spacing;
  const auto shape = built_plugins().make_kernel(options.kernel, 2)->shape();
  return {shape, h, shape.normalisation(2) / (h * h)};
}

Scene scene_of(const ParticleScene::Options& options, std::size_t count) {
  Scene scene;
  scene.dimension = 2;
  scene.precision = options.precision;
  scene.box = options.box;
  scene.fluid_volume = 1.0;
  for (int d = 0; d < scene.dimension; ++d) scene.fluid_volume *= scene.box[static_cast<std::size_t>(d)];
  scene.spacing = options.spacing;
  scene.smoothing_length = smoothing(options).smoothing_length;
  scene.support = smoothing(options).radius();
  scene.particle_count = static_cast<Index>(count);
  return scene;
}

Particles particles_at(const std::array<std::vector<double>, 2>& points) {
  Particles particles;
  particles.dimension = 2;
  particles.id.resize_for_overwrite(points[0].size());
  const auto id = particles.id.host(exec::Access::write);
  std::iota(id.begin(), id.end(), 0);
  for (std::size_t d = 0; d < 2; ++d) {
    particles.position[d].assign(points[d]);
    particles.images[d].resize(points[d].size());
  }
  return particles;
}

}  // namespace

ParticleScene::ParticleScene(const Options& options, const std::array<std::vector<double>, 2>& points)
    : ParticleScene(options, points, built_plugins().make_boundary(options.boundary, 2)) {}

ParticleScene::ParticleScene(const Options& options, const std::array<std::vector<double>, 2>& points,
                             std::unique_ptr<Boundary> boundary)
    : boundary_(std::move(boundary)),
      state_(std::make_unique<State>(scene_of(options, points[0].size()), smoothing(options), *boundary_,
                                     particles_at(points))),
      catalogue_(2) {
  FieldDeclaration f;
  f.name = "f";
  f.rank = options.rank;
  catalogue_.add_initial(f, "test");
  state_->add_field("f", catalogue_.components("f"), false);
  state_->add_field("laplacian", catalogue_.components("f"), false);
  fields_ = std::make_unique<DerivedFields>(
      *state_, catalogue_, derived_from_f(options.stages), std::vector<std::set<std::string>>{},
      DerivedFields::Form{options.consistent_laplacian, !options.still, options.stages});
  state_->order.settle();
}

void ParticleScene::set(const std::function<double(double x, double y)>& function) {
  Field& f = state_->fields.at("f");
  const Particles& particles = state_->particles;
  for (Index i = 0; i < particles.count(); ++i) {
    const auto n = static_cast<std::size_t>(i);
    const double value = function(particles.position[0].host()[n], particles.position[1].host()[n]);
    for (int c = 0; c < f.components(); ++c) f.set(c, i, (c + 1) * value);
  }
  ++f.version;
}

std::vector<double> ParticleScene::derived(const std::string& name, int component) {
  state_->order.settle();
  fields_->make(name);
  return by_id(name, component);
}

std::vector<double> ParticleScene::laplacian_by_stages(const std::string& beside, int component) {
  state_->order.settle();
  const DerivedFields::BeforeStages before(*fields_);
  if (!beside.empty()) fields_->make(beside);
  fields_->laplacian(state_->fields.at("f"), state_->fields.at("laplacian"));
  return by_id("laplacian", component);
}

std::vector<double> ParticleScene::by_id(const std::string& name, int component) const {
  const Field& field = state_->fields.at(name);
  const auto id = state_->particles.id.host();
  std::vector<double> values(id.size());
  for (std::size_t i = 0; i < id.size(); ++i)
    values[static_cast<std::size_t>(id[i])] = field.value(component, static_cast<Index>(i));
  return values;
}

std::int64_t ParticleScene::weights_found() const {
  std::int64_t found = 0;
  for (const auto& counter : fields_->counters())
    if (counter.title.starts_with("framework: weights of ")) found += counter.runs;
  return found;
}

void ParticleScene::move(const std::function<std::array<double, 2>(std::int64_t id)>& by) {
  Particles& particles = state_->particles;
  for (std::size_t i = 0; i < particles.id.size(); ++i) {
    const auto shift = by(particles.id.host()[i]);
    for (std::size_t d = 0; d < 2; ++d) particles.position[d].host(exec::Access::read_write)[i] += shift[d];
  }
  state_->order.mark_moved();
}

std::array<std::vector<double>, 2> lattice(int columns, int rows, double spacing) {
  return jittered(columns, rows, spacing, 0.0);
}

std::array<std::vector<double>, 2> jittered(int columns, int rows, double spacing, double shift, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto moved = [&] { return shift * (2.0 * std::generate_canonical<double, 53>(random) - 1.0); };
  std::array<std::vector<double>, 2> points;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      points[0].push_back((i + 0.5 + moved()) * spacing);
      points[1].push_back((j + 0.5 + moved()) * spacing);
    }
  }
  return points;
}

}  // namespace mesogen::test
