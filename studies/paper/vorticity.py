"""Vorticity and streamlines of a thin fluid at three magnifications."""

from mesogen.figures import director, style, vorticity
from mesogen.figures.scene import Scene
from mesogen.study import HOLDS, NOT_RESOLVED, Estimate, above

TITLE = "Active turbulence"
FIGURE = "vorticity and streamlines at ζ = ±0.03 Pa, μ = 0.1 Pa s"
SWEEPS = ["thin"]
SIGNS = ((0.03, "extensile"), (-0.03, "contractile"))


def zoomed(axes, scene, share):
    """The middle of the box, this share of each edge."""
    for axis, length in enumerate(scene.box):
        low, high = 0.5 * (1 - share) * length, 0.5 * (1 + share) * length
        (axes.set_xlim if axis == 0 else axes.set_ylim)(low, high)


def write(section):
    runs = section.runs("thin")
    page, axes = style.tiles(3, 2, (3.4, 3.4))
    exponents, vorticities = [], []
    for column, (zeta, name) in enumerate(SIGNS):
        some = runs.where(physics__activity__activity=zeta)
        with some.first().open() as run:
            scene = Scene(run, -1)
            for row, share in enumerate((1.0, 0.4, 0.15)):
                place = axes[2 * row + column]
                vorticity.draw(place, scene)
                if row == 2:
                    director.draw_lines(place, scene, int(30 / share))
                zoomed(place, scene, share)
                place.set_title(f"ζ = {zeta:+g} Pa, {name}" if row == 0 else "")
            end = run.times[-1]
        exponents.append(some.estimate("lyapunov", "exponent", 0.98 * end))
        vorticities.append(some.estimate("flow", "vorticity_rms", 0.5 * end))
    section.picture("maps", page, "Vorticity (colour) and streamlines, whole box and close up; the director in the last "
                    "row.", quality=88)
    section.table(("", "vorticity rms, 1/s", "Lyapunov exponent of the paths, 1/s"),
                  [(name, w.text(), e.text()) for (_, name), w, e in zip(SIGNS, vorticities, exponents)])
    nothing = Estimate(0.0, 0.0, 1)
    section.claim("Activity of either sign makes a turbulent-like flow of vortices.",
                  HOLDS if all(above(e, nothing) == HOLDS for e in exponents) else NOT_RESOLVED,
                  f"neighbouring paths part at {exponents[0].text()} and {exponents[1].text()} 1/s (extensile, contractile): "
                  "chaos, with vorticity that is steady in the mean")
    with runs.where(physics__activity__activity=0.03).first().open() as run:
        frames = range(0, len(run.times), max(1, len(run.times) // 60))
        section.animation("flow", (_frame(run, frame) for frame in frames),
                          [f"t = {run.times[frame]:.0f} s" for frame in frames],
                          "Extensile: how turbulence begins and goes on.")


def _frame(run, frame):
    page, (axes,) = style.tiles(1, 1, (4.4, 4.4))
    vorticity.draw(axes, Scene(run, frame))
    return page
