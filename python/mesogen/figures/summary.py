"""Four panels on one page: the picture of a run."""

from functools import partial

from . import director, mixing, pathlines, series, style, vorticity

# Series that fill the places of maps that are not stored, most telling first.
WANTED = ("v_rms", "count_plus", "mean_order", "mixing_index")


def _drawers(scene):
    """The four most telling panels that the run can fill, in order."""
    found = []
    if director.lacking(scene) is None:
        found.append(partial(director.draw, lines_across=40))
    if vorticity.lacking(scene) is None:
        found.append(vorticity.draw)
    if pathlines.lacking(scene) is None:
        found.append(pathlines.draw)
    if mixing.has_map(scene):
        found.append(mixing.draw)
    panels = series.panels(scene.run) if len(found) < 4 else []
    for quantity in WANTED:
        found += [partial(series.draw_panel, panel=panel) for panel in panels if quantity in panel.quantities][:1]
    return found[:4]


def lacking(scene):
    return None if _drawers(scene) else "nothing is stored that it could show"


def figure(scene):
    drawers = _drawers(scene)
    rows, columns = (1, len(drawers)) if len(drawers) < 3 else (2, 2)
    title = scene.run.title
    page, axes = style.tiles(rows, columns, style.map_size(scene.box, 3.9), head=0.4 if title else 0.05)
    for letter, place, draw in zip("abcd", axes, drawers):
        draw(place, scene)
        place.set_xlabel(place.get_xlabel() or scene.time_label)
        place.set_title(f"({letter}) {place.get_title('left')}")
    for unused in axes[len(drawers) :]:
        unused.set_visible(False)
    if title:
        page.text(
            0.14 / page.get_figwidth(), 1 - 0.24 / page.get_figheight(), title, fontsize=13, weight="bold", va="center"
        )
    return page
