#pragma once

#include <array>
#include <span>

#include "mesogen/fields/field_kind.hpp"

namespace mesogen {

/// The value of a field at a ghost or a wall particle: f' = A f + b for all components together. For a ghost, f is the
/// value at the particle of which it is a copy; for a wall particle, the fluid's value at its mirror point.
class AffineRule {
 public:
  /// Largest number of components of a field: a matrix in 3D.
  static constexpr int most = 9;

  /// Same value: f' = f. At a wall this means that the field has no slope along the normal.
  explicit AffineRule(const FieldKind& field) : AffineRule(field.components()) {}
  /// Holds the field at `value` at the wall: f' = 2 value - f. The wall is half way between a mirror point and its wall
  /// particle. `value` needs at least as many numbers as the field has components. A linear field goes on exactly. Sums
  /// over pairs stay symmetric, so an energy built on them cannot rise. Second derivatives at the wall are zero.
  static AffineRule held_at(const FieldKind& field, std::span<const double> value) {
    AffineRule rule(field);
    for (int c = 0; c < rule.components_; ++c) {
      rule.matrix(c, c) = -1.0;
      rule.summand(c) = 2.0 * value[static_cast<std::size_t>(c)];
    }
    return rule;
  }
  /// The same with the curvature that the field has in the fluid, of a vector in its part along the wall: a quadratic
  /// field goes on exactly too. Use it for the velocity of a wall without slip. The framework finds f so that f' goes
  /// on as a fit through this value at the wall.
  static AffineRule curved_at(const FieldKind& field, std::span<const double> value) {
    AffineRule rule = held_at(field, value);
    rule.curved_ = true;
    for (int c = 0; c < rule.components_; ++c)
      rule.at_wall_[static_cast<std::size_t>(c)] = value[static_cast<std::size_t>(c)];
    return rule;
  }
  /// Mirror image of a vector: its part along the normal changes sign, v' = v - 2 (v . n) n. `normal` has length 1.
  static AffineRule reflected(const FieldKind& vector, const std::array<double, 3>& normal) {
    AffineRule rule(vector);
    for (int r = 0; r < rule.components_; ++r)
      for (int c = 0; c < rule.components_; ++c)
        rule.matrix(r, c) -= 2.0 * normal[static_cast<std::size_t>(r)] * normal[static_cast<std::size_t>(c)];
    return rule;
  }

  [[nodiscard]] int components() const { return components_; }
  /// Was it made by curved_at()?
  [[nodiscard]] bool curved() const { return curved_; }
  /// The value given to curved_at().
  [[nodiscard]] double at_wall(int component) const { return at_wall_[static_cast<std::size_t>(component)]; }
  [[nodiscard]] double matrix(int row, int column) const { return matrix_[place(row, column)]; }
  [[nodiscard]] double& matrix(int row, int column) { return matrix_[place(row, column)]; }
  [[nodiscard]] double summand(int component) const { return summand_[static_cast<std::size_t>(component)]; }
  [[nodiscard]] double& summand(int component) { return summand_[static_cast<std::size_t>(component)]; }

  /// Returns the rule for the difference of two values that both follow this rule: without its constants. Where the
  /// field is curved the difference is held at zero: the Laplacian of what is held has real eigenvalues, that of what
  /// is curved has not, and stages of a stabilised step would make its waves at a wall grow. A steady field is the same
  /// either way: its difference is zero.
  [[nodiscard]] AffineRule of_differences() const {
    AffineRule rule = *this;
    rule.curved_ = false;
    rule.summand_ = {};
    rule.at_wall_ = {};
    return rule;
  }
  /// Returns the rule that applies `first` and then this rule. Both must be for the same field.
  [[nodiscard]] AffineRule after(const AffineRule& first) const {
    AffineRule both(components_);
    both.curved_ = first.curved_;
    both.at_wall_ = first.at_wall_;
    for (int r = 0; r < components_; ++r) {
      both.summand(r) = summand(r);
      for (int c = 0; c < components_; ++c) {
        both.summand(r) += matrix(r, c) * first.summand(c);
        both.matrix(r, c) = 0.0;
        for (int k = 0; k < components_; ++k) both.matrix(r, c) += matrix(r, k) * first.matrix(k, c);
      }
    }
    return both;
  }

 private:
  explicit AffineRule(int components) : components_(components) {
    for (int c = 0; c < components; ++c) matrix(c, c) = 1.0;
  }
  [[nodiscard]] std::size_t place(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(components_) + static_cast<std::size_t>(column);
  }

  int components_;
  bool curved_ = false;
  std::array<double, std::size_t{most} * most> matrix_{};
  std::array<double, most> summand_{};
  std::array<double, most> at_wall_{};
};

}  // namespace mesogen
