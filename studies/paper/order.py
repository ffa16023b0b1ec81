"""The order q, and where it is lost."""

import numpy as np

from mesogen.figures import style
from mesogen.figures.director import ORDER_COLOURS, draw_defects
from mesogen.figures.scene import Scene
from mesogen.study import decided, over_seeds

TITLE = "Nematic order"
FIGURE = "contour of the nematic order at ζ = ±0.023 Pa"
SWEEPS = ["turbulence"]
ORDERED = 0.9


def write(section):
    runs = section.runs("turbulence")
    page, axes = style.tiles(1, 2, (4.0, 4.0))
    rows, largest, at_defects, shares = [], {}, [], {}
    for place, zeta in zip(axes, (0.023, -0.023)):
        some = runs.where(physics__activity__activity=zeta)
        some.first()
        most, share = [], []
        for number, one in enumerate(some.runs):
            with one.open() as run:
                scene = Scene(run, -1)
                order = np.hypot(*scene.order_tensor)
                particles = np.hypot(*np.asarray(run.field("order_tensor")).T)
                most.append(float(np.quantile(particles, 0.999)))
                share.append(float((particles > ORDERED).mean()))
                at_defects += _at(order, scene)
                if number == 0:
                    image = place.imshow(order, origin="lower", extent=scene.grid.extent, cmap=ORDER_COLOURS, vmin=0,
                                         vmax=1.1, interpolation="bicubic")
                    draw_defects(place, scene, 0.012 * max(scene.box))
                    style.box_axes(place, scene.box)
                    style.colour_bar(place, image, "order q")
                    place.set_title(f"ζ = {zeta:+g} Pa")
        largest[zeta], shares[zeta] = over_seeds(most), over_seeds(share)
        rows.append((f"{zeta:+g}", largest[zeta].text(), shares[zeta].text()))
    section.picture("order", page, "The order q and the defects.", quality=88)
    section.table(("ζ, Pa", "q that 0.1 % of the particles exceed", f"share of the box with q > {ORDERED:g}"), rows)
    section.claim("q lies between 0 and 1.", decided(all(x.mean <= 1.01 for x in largest.values()), *(x.mean for x in largest.values())),
                  f"one particle in a thousand is above {largest[0.023].text()} (extensile) and {largest[-0.023].text()} "
                  "(contractile)", "Flow alignment raises the order above that of rest where the fluid is stretched: "
                  "nothing in the equations holds q below 1.")
    section.claim("Most of the box is ordered, q near 1.",
                  decided(all(x.mean > 0.5 for x in shares.values()), *(x.mean for x in shares.values())),
                  "; ".join(f"ζ = {zeta:+g} Pa: q > {ORDERED:g} in {100 * x.mean:.0f} %" for zeta, x in shares.items()))
    if at_defects:
        section.claim("Defects lie on walls of low order.", decided(max(at_defects) < 0.8),
                      f"q at {len(at_defects)} defects is at most {max(at_defects):.2f}, {np.mean(at_defects):.2f} in the mean")


def _at(order, scene):
    found = []
    for x, y, *_ in scene.defects:
        i, j = (int(v / c) % n for v, c, n in zip((x, y), scene.grid.cell, order.shape[::-1]))
        found.append(float(order[j, i]))
    return found
