#pragma once

#include <string>
#include <vector>

#include "mesogen/export.hpp"
#include "schedule/catalogue.hpp"
#include "schedule/world.hpp"

namespace mesogen {

/// What a step found while it moved the particles.
struct Motion {
  double fastest = 0.0;             ///< largest speed, m/s
  double largest_acceleration = 0;  ///< m/s2
  bool finite = true;               ///< was every advanced number finite?
};

/// Advances positions and integrated fields, with one evaluation of the rates a step:
///
///     u* = u + dt/2 a (of the last midpoint),  r* = r + dt/2 u*          predict()
///     rates at (r*, u*)
///     u = u* + dt/2 a,  f = f + dt df/dt,  r = r* + dt/2 u + dt shift    correct()
///
/// (u = u + dt/2 a alone, as the scheme is printed by Saghatchi, Kolukisa and Yildiz, would lose half of a.)
/// Velocity is a `predicted` field, all others are `midpoint` fields (see Advance). Sums are kept in double.
class MESOGEN_EXPORT Integrator {
 public:
  /// `velocity` and `shift` may be empty: then nothing moves.
  Integrator(World& world, const Catalogue& catalogue, const std::string& velocity, const std::string& shift);

  void predict(double step_size);
  Motion correct(double step_size);

  /// Largest magnitude of the rates of velocity now; 0 if nothing moves.
  [[nodiscard]] double largest_acceleration() const;
  /// Largest speed now; 0 if nothing moves.
  [[nodiscard]] double fastest() const;
  [[nodiscard]] bool moves() const { return velocity_ != nullptr; }
  /// What particles move with, and its rate; null if nothing moves.
  [[nodiscard]] const Field* velocity() const { return velocity_; }
  [[nodiscard]] const Field* acceleration() const { return acceleration_; }

  /// An advanced field and particle that is not finite, for the error; empty if all are.
  struct Bad {
    std::string field;
    Index particle = -1;
  };
  [[nodiscard]] Bad find_bad() const;

 private:
  struct Advanced {
    Field* field;
    Field* rate;
    bool predicted;
  };
  struct Largest {
    double value;  // length of the advanced vector; infinite if something is not a number
    double rate;
  };
  template <class Real, int Components>
  Largest advance(const Advanced& one, double by);
  template <class Real>
  Largest advance(const Advanced& one, double by);
  Largest advance(const Advanced& one, double by);
  // False if a particle is nowhere.
  template <class Real>
  bool move(double by, double shift_by);
  bool move(double by, double shift_by);

  World& world_;
  std::vector<Advanced> advanced_;
  Field* velocity_ = nullptr;
  Field* acceleration_ = nullptr;
  Field* shift_ = nullptr;
};

}  // namespace mesogen
