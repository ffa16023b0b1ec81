#pragma once

#include <string>
#include <string_view>

#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"
#include "mesogen/plugin/step_limits.hpp"

namespace mesogen {

/// A linear part of a field's rate of change that evens out the field (diffusion) or reduces it to zero (damping):
///
///     diffusion    rate += coefficient / divisor x Laplacian of the field
///     damping      rate -= coefficient / divisor x field
///
/// The damping of a vector may be of its component along an axis alone (see along).
///
/// A plugin declares it and writes no pass for it: the framework adds it to the rate, and in stabilised steps
/// (time.stepping) takes it into account however long the step is.
struct MESOGEN_EXPORT LinearTerm {
  enum class Kind { diffusion, damping };

  Kind kind;
  std::string field;
  std::string rate;          ///< name of the field of the rate of change
  double coefficient;        ///< at least 0; of a diffusion without divisor m2/s, of a damping 1/s
  StepCause cause;           ///< of the limit on explicit steps
  std::string rule;          ///< its formula
  std::string divisor = {};  ///< name of a scalar field; empty: none
  double usual_divisor = 1.0;
  std::string scale = {};  ///< see varies_with; empty: uniform
  double usual_scale = 1.0;
  std::string axis = {};    ///< see along; empty: all components alike
  bool limits_step = true;  ///< see takes_any_step

  /// A scalar field that divides the coefficient at each particle, such as the density. `usual`: about its value, in
  /// its unit. All terms of a field have the same divisor.
  LinearTerm& divided_by(std::string_view scalar, double usual) {
    divisor = scalar;
    usual_divisor = usual;
    return *this;
  }
  /// The coefficient varies in proportion to a scalar field, and is as declared where that has its `largest` value.
  LinearTerm& varies_with(std::string_view scalar, double largest) {
    scale = scalar;
    usual_scale = largest;
    return *this;
  }
  /// A damping of the component of a vector along an axis alone, whose direction is a field of unit vectors n:
  ///
  ///     rate -= coefficient / divisor x n (n . field)
  LinearTerm& along(std::string_view directions) {
    axis = directions;
    return *this;
  }
  /// The longest explicit step, s: of a diffusion the longest stable one, of a damping so long that it is off by 3 % at
  /// most. Infinite where the term takes any step.
  [[nodiscard]] double longest_step(const Scene& scene) const;
  /// If true, another plugin takes the term into account in steps of any length: it limits none.
  LinearTerm& takes_any_step(bool any) {
    limits_step = !any;
    return *this;
  }
};

}  // namespace mesogen
