#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "domain/neighbourhood.hpp"
#include "field/field.hpp"
#include "mesogen/plugin/boundary.hpp"
#include "mesogen/sph/kernel_function.hpp"

namespace mesogen {

/// What fields are at the dummies of a wall: interpolated at their mirror points and continued as the boundary says.
///
/// The interpolation is by moving least squares with the kernel of the run, exact where a field is linear
/// (S. Marrone et al., Comput. Methods Appl. Mech. Engrg. 200, 1526 (2011)). Its weights depend on positions alone:
/// found once for all fields, whenever particles have moved.
class MESOGEN_EXPORT WallValues {
 public:
  void refresh(const Neighbourhood& neighbourhood, const Scene& scene, const sph::SmoothingKernel& kernel,
               const Boundary& boundary, Field& field);

 private:
  struct Weight {
    Index particle;
    double value;
  };
  template <class Real, int Dim>
  void find_weights(const Neighbourhood& neighbourhood, const sph::SmoothingKernel& kernel);
  template <class Real>
  void apply(const std::vector<Extension>& extension, FieldView<Real> field, int components, Index count) const;

  std::vector<std::vector<Weight>> weights_;                              // by dummy
  std::map<std::string, std::vector<Extension>, std::less<>> extension_;  // by field
  std::uint64_t version_ = 0;  // of the neighbourhood that the weights belong to
  std::uint64_t sorted_version_ = 0;
};

}  // namespace mesogen
