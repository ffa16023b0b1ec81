#pragma once

#include <vector>

#include "mesogen/plugin/advice.hpp"
#include "mesogen/plugin/scene.hpp"

/// Numbers that characterise a scene, made from the constants that plugins publish: for PassList::numbers. A number
/// that the scene does not define is left out. Lengths are compared with the shortest edge of the box.
namespace mesogen::nematics {

/// For a nematic: the core size of a defect, xi = sqrt(K / |A|).
void add_core_numbers(const Scene& scene, std::vector<SceneNumber>& list);

/// For an active nematic: active length and speed, and the growth rate of the wave in the box that grows fastest.
void add_active_numbers(const Scene& scene, std::vector<SceneNumber>& list);

/// For a flow: Reynolds, Mach and Ericksen numbers, its artificial density, and the time in which momentum relaxes.
void add_flow_numbers(const Scene& scene, std::vector<SceneNumber>& list);

/// Returns l_Q = sqrt(K / |zeta|), m; 0 if the scene has no active nematic.
double active_length(const Scene& scene);
/// With fewer spacings in an active length a flow between walls is advised to take a smaller spacing.
inline constexpr double few_in_active_length = 5.0;

/// Returns |zeta| l_Q / mu, m/s: the speed that an active stress drives against viscosity over the active length. 0 if
/// the scene has no active nematic in a viscous flow.
double active_speed(const Scene& scene);

/// Returns rho u L / mu with the expected speed and the fluid's own density; 0 if the scene defines none.
double reynolds_number(const Scene& scene);

}  // namespace mesogen::nematics
