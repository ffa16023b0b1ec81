#pragma once

#include <vector>

#include "mesogen/plugin/advice.hpp"
#include "mesogen/plugin/scene.hpp"

/// Numbers that tell what kind of scene this is, made from the constants that plugins publish: for PassList::numbers.
/// A number that the scene does not define is left out. Lengths are compared with the shortest edge of the box.
namespace mesogen::nematics {

/// Of a nematic: the size of a defect's core, xi = sqrt(K / |A|).
void add_core_numbers(const Scene& scene, std::vector<SceneNumber>& list);

/// Of an active nematic: active length and speed; growth rate of the wave in the box that grows fastest.
void add_active_numbers(const Scene& scene, std::vector<SceneNumber>& list);

/// Of a flow: Reynolds, Mach and Ericksen numbers, its artificial density, and the time in which momentum relaxes.
void add_flow_numbers(const Scene& scene, std::vector<SceneNumber>& list);

/// |zeta| l_Q / mu, m/s: what an active stress drives over the active length l_Q = sqrt(K / |zeta|) against viscosity;
/// 0 where the scene has no active nematic in a viscous flow.
double active_speed(const Scene& scene);

/// rho u L / mu with the expected speed and the fluid's own density; 0 if the scene defines none.
double reynolds_number(const Scene& scene);

}  // namespace mesogen::nematics
