#pragma once

#include <string>

#include "case/case.hpp"
#include "mesogen/sph/smoothing_kernel.hpp"

namespace mesogen {

/// The kernel of a case, from its shape.
sph::SmoothingKernel smoothing_of(const Case& source, sph::KernelShape shape);

/// What is wrong where the kernel's numbers leave the range of the case's precision at its spacing, in words; empty if
/// they do not. The widest range is that of |W'| / r, which goes with h^-(Dim + 2).
std::string range_problem(const Case& source, const sph::SmoothingKernel& kernel);

/// The axis along which the box is shortest; 0 if it has no size yet.
int shortest_axis(const Case& source);

/// What is wrong with the kernel's support in this box, in words; empty if nothing, or if the box has no size yet.
/// `walls`: is the box closed along its shortest axis?
std::string support_problem(const Case& source, const sph::SmoothingKernel& kernel, bool walls);

}  // namespace mesogen
