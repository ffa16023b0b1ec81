#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "schedule/catalogue.hpp"
#include "schedule/derived_fields.hpp"
#include "schedule/state.hpp"

namespace mesogen::test {

/// Particles of a test in a box, with one field "f", a scalar if nothing else is asked for, and all that the framework
/// derives from it.
class ParticleScene {
 public:
  struct Options {
    std::array<double, 3> box{1.0, 1.0, 0.0};
    double spacing = 0.05;
    double smoothing_length = 4.0 / 3.0;  ///< in spacings
    std::string kernel = "quintic";
    std::string boundary = "periodic_ghosts";
    bool consistent_laplacian = false;
    bool still = false;        ///< as where particles never move; they may be moved all the same
    Rank rank = Rank::scalar;  ///< of f
    bool stages = false;       ///< as in stabilised steps: Laplacians come from laplacian_by_stages() alone
    Precision precision = Precision::double_precision;
  };

  /// `points`: coordinates by axis, m; the n-th gets id n.
  ParticleScene(const Options& options, const std::array<std::vector<double>, 2>& points);
  /// In a boundary of the test's own.
  ParticleScene(const Options& options, const std::array<std::vector<double>, 2>& points,
                std::unique_ptr<Boundary> boundary);

  /// f = function(x, y), and in other components twice, three times that, at the particles' coordinates, as they are
  /// stored.
  void set(const std::function<double(double x, double y)>& function);
  /// Component of "volume", "correction", "f_gradient" or "f_laplacian", by id.
  [[nodiscard]] std::vector<double> derived(const std::string& field, int component = 0);
  /// The Laplacian of f as stages need it, by id; `beside`: a derived field that is made first, in the same pass.
  [[nodiscard]] std::vector<double> laplacian_by_stages(const std::string& beside = "", int component = 0);
  /// Moves every particle by (x, y)(id), m.
  void move(const std::function<std::array<double, 2>(std::int64_t id)>& by);
  /// How often weights were found for particles that keep still.
  [[nodiscard]] std::int64_t weights_found() const;

  [[nodiscard]] State& state() { return *state_; }

 private:
  [[nodiscard]] std::vector<double> by_id(const std::string& field, int component) const;

  std::unique_ptr<Boundary> boundary_;
  std::unique_ptr<State> state_;
  Catalogue catalogue_;
  std::unique_ptr<DerivedFields> fields_;
};

/// Coordinates of a square lattice (cell centres, id = row * columns + column), m.
std::array<std::vector<double>, 2> lattice(int columns, int rows, double spacing);
/// The same, each point moved by up to `shift` spacings along each axis, at random.
std::array<std::vector<double>, 2> jittered(int columns, int rows, double spacing, double shift, unsigned seed = 1);

}  // namespace mesogen::test
