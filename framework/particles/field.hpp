#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "exec/backend.hpp"
#include "mesogen/exec/array.hpp"
#include "mesogen/export.hpp"
#include "mesogen/fields/field_kind.hpp"
#include "mesogen/fields/field_reader.hpp"
#include "mesogen/fields/field_view.hpp"
#include "ranks/journey.hpp"

namespace mesogen {

/// A named array over the particles of the fluid, those of walls, and ghosts.
///
/// Passes see it in the precision of the run. A field that is advanced in time also has a master copy in double: a step
/// changes it by less than float resolves (at the paper's parameters by 1e-7 of itself).
class MESOGEN_EXPORT Field {
 public:
  Field(std::string name, int components, Precision precision, bool integrated,
        const Backend& backend = Backend::host());

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] int components() const { return components_; }
  [[nodiscard]] bool integrated() const { return integrated_; }
  [[nodiscard]] bool is_double() const { return precision_ == Precision::double_precision; }

  /// Makes room for so many particles, and for wall particles and ghosts; keeps the values of the particles.
  void resize(Index particles, Index of_boundary);

  template <class Real>
  [[nodiscard]] FieldView<const Real> view(exec::Side side) const {
    return {values<Real>().on(side), stride_};
  }
  template <class Real>
  [[nodiscard]] FieldView<Real> view(exec::Side side, exec::Access access) {
    return {values<Real>().on(side, access), stride_};
  }
  /// Of an integrated field: the double that is advanced. The same memory as view<double>() in double precision.
  [[nodiscard]] FieldView<const double> master(exec::Side side) const { return {double_.on(side), stride_}; }
  [[nodiscard]] FieldView<double> master(exec::Side side, exec::Access access) {
    return {double_.on(side, access), stride_};
  }
  [[nodiscard]] FieldReader reader() const;
  /// Does a reader see doubles? Otherwise single precision is the best there is.
  [[nodiscard]] bool reads_doubles() const { return is_double() || integrated_; }
  /// Are the values that a reader sees up to date on this side?
  [[nodiscard]] bool is_on(exec::Side side) const {
    return reads_doubles() ? double_.is_on(side) : single_.is_on(side);
  }
  /// Of one particle; a loop over particles takes a reader().
  [[nodiscard]] double value(int component, Index particle) const { return reader()(component, particle); }
  void set(int component, Index particle, double value);
  void fill_zero();
  /// Exchanges the doubles of two integrated fields of as many components, without touching them. Ghosts and walls of
  /// either are out of date then.
  void exchange_master(Field& other);

  /// Room for the values of a field in their new order. A field leaves its old values there, which are room for the
  /// next field with as many components.
  class Scratch {
   public:
    explicit Scratch(exec::DeviceMemory* memory = nullptr) : memory_(memory) {}
    template <class T>
    exec::Array<T>& room(int components, std::size_t size);

   private:
    exec::DeviceMemory* memory_;
    std::map<int, exec::Array<double>> exact_;  // by number of components
    std::map<int, exec::Array<float>> single_;
  };
  /// New place of every particle: place n takes what stood at order[n]. No particle gets another value, so the version
  /// stays. Values of ghosts and walls are lost.
  void permute(const exec::Array<Index>& order, Scratch& scratch);

  /// Brings the values of particles to other ranks, and those of others here; or back, from after the journey to before
  /// it.
  void carry(const Journey& journey, bool back);

  /// Every write raises the version; ghosts are of version `refreshed`, and walls of the positions `refreshed_at`.
  std::uint64_t version = 1;
  std::uint64_t refreshed = 0;
  std::uint64_t refreshed_at = 0;

  /// What a boundary goes by. Without it the values at ghosts and walls are the same as in the fluid.
  std::optional<FieldKind> kind;
  /// Its values are differences of two values of a field of that kind.
  bool difference = false;
  /// Its values are made anew wherever particles have moved: they need not follow when particles change places. Who
  /// reads it has it made first; after a sorting it holds the values of other particles.
  bool follows_positions = false;

 private:
  template <class Real>
  [[nodiscard]] const exec::Array<Real>& values() const {
    if constexpr (sizeof(Real) == sizeof(float)) {
      return single_;
    } else {
      return double_;
    }
  }
  template <class Real>
  [[nodiscard]] exec::Array<Real>& values() {
    return const_cast<exec::Array<Real>&>(std::as_const(*this).template values<Real>());
  }

  std::string name_;
  int components_;
  Precision precision_;
  bool integrated_;
  const Backend& backend_;
  Index particles_ = 0;
  std::ptrdiff_t stride_ = 0;
  exec::Array<float> single_;
  exec::Array<double> double_;
};

/// All fields of a run, by name.
class MESOGEN_EXPORT FieldStore {
 public:
  Field& add(std::unique_ptr<Field> field);
  [[nodiscard]] Field* find(std::string_view name) const;
  [[nodiscard]] Field& at(std::string_view name) const;
  [[nodiscard]] const std::map<std::string, std::unique_ptr<Field>, std::less<>>& all() const { return fields_; }

 private:
  std::map<std::string, std::unique_ptr<Field>, std::less<>> fields_;
};

}  // namespace mesogen
