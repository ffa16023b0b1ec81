#pragma once

#include "exec/program.hpp"
#include "mesogen/plugin/scene.hpp"
#include "prescribed/film.hpp"

namespace mesogen {

/// A scene at a time; without positions, fields and films.
template <class Real>
exec::Surroundings<Real> surroundings(const Scene& scene, double time) {
  exec::Surroundings<Real> around;
  around.dimension = scene.dimension;
  around.time = time;
  for (int d = 0; d < scene.dimension; ++d) {
    around.box[d] = scene.box[static_cast<std::size_t>(d)];
    around.periodic[d] = scene.periodic[static_cast<std::size_t>(d)];
  }
  return around;
}

/// A film at a time; `pixels`: its pixels, on the side where they are read.
inline exec::FilmView film_view(const Film& film, const float* pixels, double time) {
  const Film::Moment moment = film.at(time);
  const std::size_t size = static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height);
  return {pixels + moment.before * size, pixels + moment.after * size, moment.share, film.width, film.height};
}

}  // namespace mesogen
