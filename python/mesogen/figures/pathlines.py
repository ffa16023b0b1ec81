"""Paths of chosen particles, from the start to the frame."""

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize

from . import style


def lacking(scene):
    observer = scene.run.observer_of("path")
    if observer is None:
        return "no observer recorded 'path' (add one of type \"pathlines\")"
    time, _ = scene.until_now(observer, "path")
    return None if len(time) > 1 else "fewer than two samples of 'path' up to this frame"


def wrapped_segments(path, box):
    """Straight pieces of unwrapped paths, brought into the periodic box.

    path: (T, particles, 2) without jumps. Returns (segments, sample): segments (M, 2, 2) that begin in the box, and the
    sample each begins with. A piece that crosses a face is there twice, once for each side, to be clipped by the axes:
    nothing is drawn across the box.
    """
    begin, end = path[:-1].reshape(-1, 2), path[1:].reshape(-1, 2)
    sample = np.repeat(np.arange(len(path) - 1), path.shape[1])
    known = np.isfinite(begin).all(axis=1) & np.isfinite(end).all(axis=1)
    begin, end, sample = begin[known], end[known], sample[known]
    home = np.floor(begin / box)
    segments = np.stack([begin - home * box, end - home * box], axis=1)
    across = np.floor(end / box) - home
    leaves = across.any(axis=1)
    again = segments[leaves] - (across[leaves] * box)[:, None, :]
    return np.concatenate([segments, again]), np.concatenate([sample, sample[leaves]])


def draw(axes, scene):
    """The map: lines that darken with time, a dot where each particle is at the frame."""
    observer = scene.run.observer_of("path")
    time, path = scene.until_now(observer, "path")
    box = np.asarray(scene.box)
    path = np.asarray(path, dtype=float)[:, :, :2]
    segments, sample = wrapped_segments(path, box)
    crowd = np.clip(60 / max(path.shape[1], 1), 0.15, 1.0)
    lines = LineCollection(
        segments, cmap="viridis_r", norm=Normalize(time[0], time[-1]), linewidths=0.5 + 0.8 * crowd, capstyle="round"
    )
    lines.set_array(0.5 * (time[sample] + time[sample + 1]))
    axes.add_collection(lines)
    now = path[-1] % box
    axes.scatter(
        now[:, 0], now[:, 1], s=3 + 13 * crowd, color=style.INK, edgecolors="white", linewidths=0.5, zorder=3
    )
    style.box_axes(axes, box, scene.run.length_unit)
    style.titles(axes, f"Paths of {path.shape[1]} particles", scene)
    style.colour_bar(axes, lines, scene.time_label)


def figure(scene):
    page, (axes,) = style.tiles(1, 1, style.map_size(scene.box))
    draw(axes, scene)
    return page
