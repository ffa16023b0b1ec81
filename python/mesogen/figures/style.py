"""One look for all figures: fonts, sizes, colours, axes, colour bars."""

import re

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

RESOLUTION = 200  # dots per inch

INK = "#22262b"
QUIET = "#7a828c"
PLUS = "#f0592b"  # defects of charge +1/2
MINUS = "#5b2a86"  # defects of charge -1/2
SERIES = ("#2a5c8a", "#d1662b", "#4f9a6a", "#8a5a9e")

SETTINGS = {
    "font.family": "DejaVu Sans",
    "mathtext.fontset": "dejavusans",
    "font.size": 8.5,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.titlepad": 6.0,
    "axes.labelsize": 8.5,
    "axes.labelcolor": INK,
    "axes.edgecolor": INK,
    "axes.linewidth": 0.6,
    "axes.formatter.limits": (-3, 4),
    "axes.formatter.use_mathtext": True,
    "text.color": INK,
    "xtick.color": INK,
    "ytick.color": INK,
    "xtick.labelsize": 8.0,
    "ytick.labelsize": 8.0,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 2.8,
    "ytick.major.size": 2.8,
    "legend.frameon": False,
    "legend.fontsize": 7.5,
    "lines.linewidth": 1.2,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
}


def settings():
    """Context in which figures are made and saved; leaves the caller's matplotlib as it was."""
    return matplotlib.rc_context(SETTINGS)


def page(width, height):
    """A figure of width x height inches that draws without a display."""
    figure = Figure(figsize=(width, height), dpi=RESOLUTION)
    FigureCanvasAgg(figure)
    return figure


def tiles(rows, columns, size, head=0.0, margins=(0.55, 0.85, 0.36, 0.5)):
    """A page of axes laid out in inches, so that all panels and gaps are alike whatever they show.

    size: (width, height) of each axes. margins: left, right, top, bottom around each of them, for labels and colour
    bars. head: room for a title of the page. Returns (page, list of axes by rows).
    """
    left, right, top, bottom = margins
    wide, tall = left + size[0] + right, top + size[1] + bottom
    width, height = wide * columns, tall * rows + head
    figure = page(width, height)
    axes = [
        figure.add_axes(
            [
                (column * wide + left) / width,
                ((rows - 1 - row) * tall + bottom) / height,
                size[0] / width,
                size[1] / height,
            ]
        )
        for row in range(rows)
        for column in range(columns)
    ]
    return figure, axes


def map_size(box, longest=4.4):
    """Inches of a map of the box, its longer side `longest`."""
    return tuple(np.maximum(0.8, longest * np.asarray(box) / max(box)))


def box_axes(axes, box, unit="m"):
    """Axes over the whole periodic box, equal on both. unit: that of lengths."""
    axes.set_xlim(0, box[0])
    axes.set_ylim(0, box[1])
    axes.set_aspect("equal")
    axes.set_xlabel(labelled("x", unit))
    axes.set_ylabel(labelled("y", unit))
    axes.locator_params(nbins=6)


def titles(axes, left, scene):
    """What is shown, on the left; the time, on the right."""
    axes.set_title(left)
    axes.set_title(scene.time_text, loc="right", color=QUIET, fontsize=8.5)


def colour_bar(axes, image, label):
    """A slim colour bar as tall as the map."""
    width = axes.figure.get_figwidth() * axes.get_position().width
    bar = axes.figure.colorbar(image, cax=axes.inset_axes([1 + 0.12 / width, 0.0, 0.14 / width, 1.0]))
    bar.outline.set_linewidth(0.5)
    bar.set_label(label)
    return bar


def unit_text(unit):
    """A unit as it is printed in a label: "kg/m^3" and "kg/m3" become "kg/m³", "1/s" "s⁻¹", "1" nothing."""
    raised = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
    if unit in ("", "1"):
        return ""
    unit = re.sub(r"^1/(\w+)$", r"\1^-1", unit)
    return re.sub(r"(?<=[A-Za-z])\^?(-?\d+)|\^(-?\d+)", lambda power: (power[1] or power[2]).translate(raised), unit)


def labelled(name, unit, power=0):
    """"name (10^power unit)", without what is not needed."""
    factor = unit_text(f"10^{power}") if power else ""
    unit = " ".join(part for part in (factor, unit_text(unit)) if part)
    return f"{name} ({unit})" if unit else name
