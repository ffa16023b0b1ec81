"""The mean flow about +1/2 defects."""

import numpy as np

from mesogen.figures import style
from mesogen.study import decided

TITLE = "Flow about a +1/2 defect"
FIGURE = "average +1/2 defect flow at ζ = 0.05 Pa"
SWEEPS = ["strong"]


def write(section):
    runs = section.runs("strong")
    patches = [np.asarray(value[-1], dtype=float) for _, value in runs.series("around", "plus")]  # means of whole runs
    mean = np.nanmean(patches, axis=0)  # a run may have seen no such defect
    n = int(round(np.sqrt(len(mean))))
    x, y, u, v, w = (mean[:, c].reshape(n, n) for c in range(5))
    fu, fv = dipole(x, y, float(np.abs(x).max()))
    inside = np.hypot(x, y) < 0.8 * np.abs(x).max()
    page, axes = style.tiles(1, 2, (3.6, 3.6))
    for place, (a, b, title) in zip(axes, ((u, v, "measured"), (fu, fv, "analytic, a defect alone in a disc"))):
        vorticity = np.gradient(b, x[0, 1] - x[0, 0], axis=1) - np.gradient(a, y[1, 0] - y[0, 0], axis=0)
        most = float(np.abs(vorticity[inside]).max())
        place.pcolormesh(x, y, vorticity, cmap="RdBu_r", vmin=-most, vmax=most, shading="gouraud")
        place.streamplot(x, y, a, b, color="#22262b", linewidth=0.6, density=1.1, arrowsize=0.6)
        place.set_aspect("equal")
        place.set_title(title)
        place.set_xlabel("x (m), along the defect's axis")
        place.set_ylabel("y (m)")
    section.picture("dipole", page, "Streamlines and vorticity in the frame of the defect, averaged over all +1/2 "
                    "defects, all times and seeds, beside the flow of a defect alone.", ("x", "y", "u", "v", "vorticity"), mean.tolist())
    core = inside & (np.hypot(x, y) < 0.5 * np.abs(x).max())
    measured, formula = np.concatenate([u[core], v[core]]), np.concatenate([fu[core], fv[core]])
    agreement = float(measured @ formula / np.sqrt((measured @ measured) * (formula @ formula)))
    odd = float(np.corrcoef(w[inside].ravel(), -w[::-1][inside].ravel())[0, 1]) if np.isfinite(w).all() else float("nan")
    section.claim("A pair of counter-rotating vortices goes with a +1/2 defect, as the analytic solution says.",
                  decided(agreement > 0.8, agreement),
                  f"the mean flow and the formula point the same way: their normalised product is {agreement:.2f} (1: "
                  f"the same pattern); the vorticity changes sign across the axis (correlation with its mirror image {odd:.2f})",
                  "Magnitudes differ: the formula is of one defect in a disc.")


def dipole(x, y, radius):
    """Flow (up to its magnitude) of an extensile +1/2 defect with its tail along x, in a disc of this radius: Giomi, Bowick,
    Mishra, Sknepnek, Marchetti, Phil. Trans. R. Soc. A 372, 20130365 (2014), head along x there."""
    r, phi = np.hypot(x, y), np.arctan2(y, x)
    return -(3.0 * (radius - r) + r * np.cos(2.0 * phi)), -r * np.sin(2.0 * phi)
