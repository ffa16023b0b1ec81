#pragma once

#include <string>
#include <vector>

#include "run/setup.hpp"
#include "schedule/state.hpp"
#include "time/integrator.hpp"

namespace mesogen {

/// The functions by which plugins adapt their numerics to a field while a run goes on: FieldDeclaration::watched_by.
class Watches {
 public:
  /// All of these must outlive it.
  Watches(const Setup& setup, const State& state, const Integrator& integrator);

  /// After a step: calls each, and returns what they changed, "physics.flow: sound_speed rises from 2 to 4".
  [[nodiscard]] std::vector<std::string> look() const;

 private:
  struct Watched {
    std::string field;
    const Setup::PhysicsMember* owner;
    Watch function;
  };

  const State& state_;
  const Integrator& integrator_;
  std::vector<Watched> watched_;
};

}  // namespace mesogen
