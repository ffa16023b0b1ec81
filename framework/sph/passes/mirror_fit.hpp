#pragma once

#include "mesogen/exec/lanes.hpp"
#include "mesogen/exec/unroll.hpp"
#include "mesogen/sph/small_matrix.hpp"
#include "sph/mirror_values.hpp"
#include "sph/passes/linear_fit.hpp"

/// The fit at one mirror point, the same by blocks and by runs. Ways are from the mirror point, in smoothing lengths h.
namespace mesogen::sph {

/// The wall particle of a mirror point; its surface is taken as round.
template <int Dim>
struct MirroredWall {
  double at[Dim];
  double normal[Dim];
  double depth;
  double curvature;

  MESOGEN_HOST_DEVICE MirroredWall(const MirrorPoints<Dim>& points, Index n, double length)
      : at{}, normal{}, depth(0.0), curvature(points.curvature[n] * length) {
    exec::unroll<Dim>([&](auto d) {
      at[d] = points.to_wall[d][n] / length;
      normal[d] = points.normal[d][n];
      depth -= 0.5 * at[d] * normal[d];
    });
  }

  /// How far a particle is from the surface; zero behind it.
  template <class Lane>
  [[nodiscard]] [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane distance(const Lane (&way)[Dim]) const {
    Lane along(0.0);
    Lane square(0.0);
    exec::unroll<Dim>([&](auto d) __attribute__((always_inline)) {
      along = along + way[d] * normal[d];
      square = square + way[d] * way[d];
    });
    const Lane from_plane = along + depth;
    const Lane bent = exec::positive_part(from_plane * curvature + 1.0);  // 0 beyond the centre of a hollow
    const Lane aside = (square - along * along) * curvature;
    const Lane root = exec::square_root(exec::positive_part(bent * bent + aside * curvature));
    return exec::positive_part(from_plane + aside / (bent + root + 1e-12));
  }

  /// depth * l, as a function of the way from the mirror point.
  [[nodiscard]] MESOGEN_HOST_DEVICE Linear<Dim> seen(const Linear<Dim>& l) const {
    Linear<Dim> result{depth * l.constant, {}};
    exec::unroll<Dim>([&](auto d) {
      result.slope[d] = depth * l.slope[d];
      result.constant -= result.slope[d] * at[d];
    });
    return result;
  }
};

/// Least squares with the kernel; see mirror_values.hpp.
template <MirrorFit fit, int Dim>
struct MirrorFitting {
  /// Sums over the particles of W, of W d, of W dd (upper triangle), with the way d from where the fit is evaluated.
  static constexpr int moments = 1 + Dim + symmetric_components<Dim>;

  MirroredWall<Dim> wall;

  /// Adds a particle, or a pack of them, to the moments. Returns what its weight is but for the fitted function.
  template <class Lane>
  [[gnu::always_inline]] MESOGEN_HOST_DEVICE Lane add(const Lane& kernel, const Lane (&way)[Dim],
                                                      Lane (&moment)[moments]) const {
    Lane share = kernel;
    Lane value = kernel;
    Lane from[Dim];
    exec::unroll<Dim>([&](auto d) __attribute__((always_inline)) { from[d] = way[d]; });
    if constexpr (fit == MirrorFit::curved) {
      const Lane distance = wall.distance(from);
      share = value * distance;
      value = share * distance;
      exec::unroll<Dim>([&](auto d) __attribute__((always_inline)) { from[d] = from[d] - wall.at[d]; });
    }
    moment[0] = moment[0] + value;
    exec::unroll<Dim>([&](auto a) __attribute__((always_inline)) {
      const Lane first = value * from[a];
      moment[1 + a] = moment[1 + a] + first;
      exec::unroll<Dim - a>([&](auto more) __attribute__((always_inline)) {
        constexpr int n = 1 + Dim + symmetric_index<Dim>(a, a + more);
        moment[n] = moment[n] + first * from[a + more];
      });
    });
    return share;
  }

  /// The fitted function of the way from the mirror point.
  [[nodiscard]] MESOGEN_HOST_DEVICE Linear<Dim> solve(const double (&moment)[moments]) const {
    if constexpr (fit == MirrorFit::curved) {
      // It is evaluated far from its particles, so those near a line would be magnified.
      return wall.seen(fit_linear<Dim>(moment, 1e-3));
    } else {
      return fit_linear<Dim>(moment, 1e-8);
    }
  }
};

}  // namespace mesogen::sph
