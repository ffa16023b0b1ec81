#pragma once

#include <array>
#include <memory>
#include <string>

#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen {

/// A formula of place that a case gives, such as "sqrt(x^2 + y^2) - 4". It may hold x, y, z, pi, the edges Lx, Ly, Lz
/// of the box, constants that plugins publish, and the operators and functions of docs/varying.md.
class MESOGEN_EXPORT Expression {
 public:
  /// Throws Error(bad_case) that tells what is wrong with the text; also if it depends on the time.
  Expression(const std::string& text, const Scene& scene);
  ~Expression();
  Expression(const Expression&) = delete;
  Expression& operator=(const Expression&) = delete;

  /// Its value at a point, m. May be called by several threads at a time.
  [[nodiscard]] double operator()(const std::array<double, 3>& at) const;
  /// Its values at the nine points (x + i step, y + j step), i and j from -1 to 1, the i-th of row j at
  /// 3 (j + 1) + i + 1: for slopes and curvatures, faster than one by one.
  [[nodiscard]] std::array<double, 9> around(const std::array<double, 3>& at, double step) const;

 private:
  struct Implementation;
  std::unique_ptr<const Implementation> implementation_;
};

}  // namespace mesogen
