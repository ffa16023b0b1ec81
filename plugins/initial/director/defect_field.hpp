#pragma once

#include <string>
#include <vector>

#include "mesogen/plugin/parameters.hpp"
#include "mesogen/plugin/scene.hpp"

namespace mesogen::director {

/// Order q and angle theta (rad) of the director.
struct DirectorValue {
  double order;
  double angle;
};

/// The director around given defects in a periodic box: the angle is harmonic (a minimum of the elastic energy with
/// one constant), turns by 2 pi times the charge around each defect, and fits the box.
///
/// A row of images along x has the closed form arg sin(pi (z - z_k) / Lx), z = x + i y; all rows together are the
/// product formula of the first Jacobi theta function,
///   arg theta_1(w) = arg sin w + sum over m > 0 of arg(1 - cos(2 w) / cosh(2 m pi Ly / Lx)),  w = pi (z - z_k) / Lx.
/// For charges that add up to 0 it repeats along x, and along y but for the slope -2 pi P_x / (Lx Ly), where P is the
/// sum of charge times position; a linear term takes that away. Half turns across the box may then be added freely:
/// those are taken that make the mean slope smallest.
/// Near a defect the order falls as r / sqrt(r^2 + 2 core^2), within 0.05 of the exact profile of a core of that
/// length (physically sqrt(elastic_constant / |A|)).
class DefectField {
 public:
  /// `rows`: x (m), y (m), charge (0.5 or -0.5) of each; those beyond a periodic face of the scene's box are folded
  /// into it. `core`: radius of the cores, m. Throws BadParameter if a defect lies outside, if two are at one place, or
  /// if the charges do not add up to 0.
  /// `length_unit`: of the case, for messages.
  DefectField(const Parameter::Rows& rows, double core, const Scene& scene, const std::string& length_unit = "m");
  /// Order relative to that far from defects, and angle modulo pi, at a point of the box.
  [[nodiscard]] DirectorValue at(double x, double y) const;

 private:
  struct Defect {
    double x;
    double y;
    double charge;
  };
  [[nodiscard]] bool at_same_place(const Defect& defect, double x, double y) const;
  [[nodiscard]] double angle_around(double dx, double dy) const;

  std::vector<Defect> defects_;
  double width_;
  double height_;
  double core_;
  double slope_x_ = 0.0;
  double slope_y_ = 0.0;
};

}  // namespace mesogen::director
