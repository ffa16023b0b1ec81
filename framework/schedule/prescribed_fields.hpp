#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mesogen/exec/array.hpp"
#include "mesogen/export.hpp"
#include "prescribed/prescribed.hpp"
#include "schedule/state.hpp"

namespace mesogen {

/// The fields that a case prescribes in space and time, and their gradients. Each is made when asked for, where
/// particles are and at the time that it is.
class MESOGEN_EXPORT PrescribedFields {
 public:
  /// `prescribed` must outlive it.
  PrescribedFields(State& state, const std::vector<Prescribed>& prescribed);
  PrescribedFields(const PrescribedFields&) = delete;
  PrescribedFields& operator=(const PrescribedFields&) = delete;

  [[nodiscard]] bool has(const std::string& field) const { return made_by_.contains(field); }
  /// Brings a field up to date.
  void make(const std::string& field);

  [[nodiscard]] const Counter& counter() const { return counter_; }

 private:
  /// A program, with what it reads on the side of the backend.
  struct Component {
    const Program* program;
    exec::Array<exec::Instruction> code;
    std::vector<exec::Array<float>> films;
  };
  struct Made {
    const Prescribed* prescribed = nullptr;
    std::vector<Component> components;
    Field* value = nullptr;  // null if nobody reads it
    Field* gradient = nullptr;
    std::uint64_t positions = 0;
    double time = 0.0;
    std::vector<std::uint64_t> sources;
  };
  [[nodiscard]] bool stale(const Made& made) const;
  [[nodiscard]] std::vector<std::uint64_t> versions(const Made& made) const;
  template <class Real>
  void run(Made& made, std::size_t component);

  State& state_;
  std::vector<Made> all_;
  std::map<std::string, std::size_t> made_by_;
  Counter counter_{"framework: prescribed values"};
};

}  // namespace mesogen
