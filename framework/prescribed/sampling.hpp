#pragma once

#include <functional>
#include <string>
#include <vector>

#include "case/arrangement.hpp"
#include "case/problems.hpp"
#include "mesogen/export.hpp"
#include "mesogen/plugin/scene.hpp"
#include "prescribed/prescribed.hpp"

namespace mesogen {

/// The values of a scalar field of particles at the start, by id; empty if it starts from 0.
using FieldAtStart = std::function<std::vector<double>(const std::string& field)>;

/// Looks at a prescribed number where particles start, and at many times up to the end of the run. Returns, for each
/// component, its value of largest size. A value that is not finite, or that the parameter does not allow, is a problem
/// that tells where and when.
///
/// Fields are taken as they are at the start, and as large as the constant FIELD_largest, if a plugin publishes that.
std::vector<double> largest_values(const Prescribed& prescribed, const Scene& scene, const Arrangement& particles,
                                   double end, const FieldAtStart& field_at_start, Problems& problems);

}  // namespace mesogen
