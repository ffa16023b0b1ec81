"""The elastic constant."""

import numpy as np

from mesogen.figures import director, style, vorticity
from mesogen.figures.scene import Scene
from mesogen.study import above, agrees, exponent, over_seeds
from mesogen.study.verdict import all_of

TITLE = "The elastic constant"
FIGURE = "vorticity, defects and mixing at K = 0.02, 0.05, 0.1 N"
SWEEPS = ["elasticity"]
KEY = "physics.nematic.elastic_constant"


def write(section):
    runs = section.runs("elasticity")
    end = runs.value("time.end")
    constants = runs.points(KEY)
    page, axes = style.tiles(2, len(constants), (3.0, 3.0))
    lengths, defects, mixing = [], [], []
    for column, constant in enumerate(constants):
        some = runs.where(physics__nematic__elastic_constant=constant)
        with some.first().open() as run:
            scene = Scene(run, -1)
            vorticity.draw(axes[column], scene)
            director.draw(axes[len(constants) + column], scene, lines_across=40)
            axes[column].set_title(f"K = {constant:g} N")
            axes[len(constants) + column].set_title("")
        lengths.append(some.estimate("correlation", "vorticity_level_radial", 0.6 * end))
        defects.append(some.estimate("defects", "count_plus", 0.6 * end))
        mixing.append(over_seeds([float(np.interp(0.5 * end, t, v)) for t, v in some.series("mixing", "mixing_index")]))
    section.picture("maps", page, "Vorticity with streamlines, director with defects.", ("K", "length", "defects", "mixing"),
                    [(k, a.mean, b.mean, c.mean) for k, a, b, c in zip(constants, lengths, defects, mixing)], quality=86)
    section.table(("K, N", "vorticity correlation is 0.2 at, m", "pairs of defects", f"mixing index at {0.5 * end:g} s"),
                  [(f"{k:g}", a.text(), b.text(), c.text(2)) for k, a, b, c in zip(constants, lengths, defects, mixing)])
    section.claim("Vortices grow with K.", all_of(above(b, a) for a, b in zip(lengths, lengths[1:])),
                  ", ".join(f"{a.text()} m at {k:g} N" for k, a in zip(constants, lengths)))
    power = exponent(constants, lengths)
    section.claim("Their size goes as the root of K / ζ.", agrees(power, 0.5, 0.1),
                  f"exponent of K: {power.text(2)}; asked for within 0.1")
    section.claim("Defects become fewer as K rises.", all_of(above(a, b) for a, b in zip(defects, defects[1:])),
                  ", ".join(f"{a.text()} at {k:g} N" for k, a in zip(constants, defects)))
    section.claim("A larger K mixes less.", above(mixing[0], mixing[-1]),
                  ", ".join(f"{a.text(2)} at {k:g} N" for k, a in zip(constants, mixing)))

