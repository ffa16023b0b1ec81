"""Figures of a CUDA device, for the tables of docs/performance.md: of bench/speed.py, and of scripts/device."""

import datetime
import json
import pathlib

from speed_tables import Figure, row

TABLES = ["device", "device shares", "device roofline"]
NOT_MEASURED = "Not measured yet on a device. `scripts/device OUT` measures it where there is one."


def device_steps(budget, across):
    """How many steps a run of `across` particles along each edge takes; budget: particle-steps."""
    return int(min(4000, max(40, budget / across**2)))


def time_figures(across, precision, seconds):
    """The time of a step, s."""
    return row("device", f"{across * across:,}", {f"ms a step, {precision}": 1e3 * seconds,
                                                  f"million particle-steps/s, {precision}": 1e-6 * across**2 / seconds})


def origin_figures(across, name):
    """On which device that was, and when."""
    return row("device", f"{across * across:,}", {"device": f"{name}, {datetime.date.today().isoformat()}"})


def share_figures(across, shares):
    """The parts of a step, the longest first. shares: {name: seconds a step}."""
    column = f"ms a step, each waited for, {across * across:,} particles"
    return [figure for name, seconds in sorted(shares.items(), key=lambda share: -share[1])
            for figure in row("device shares", name, {column: 1e3 * seconds})]


def read_results(folder):
    """The figures that `scripts/device FOLDER` measured. Exits with a message if there are none that can be shown."""
    file = pathlib.Path(folder) / "results.json"
    if not file.exists():
        raise SystemExit(f"{file}: there is no such file; --device-results takes the folder OUT that "
                         "`scripts/device OUT` wrote")
    results = json.loads(file.read_text(encoding="utf-8"))
    if results["emulated"]:
        raise SystemExit(f"{file}: was made by the emulated device, whose times say nothing of a GPU; run "
                         "`scripts/device OUT` on a machine with one, without MESOGEN_CUDA_ON_HOST")
    figures = [Figure(*figure) for figure in results["figures"]]
    if not figures:
        raise SystemExit(f"{file}: holds no measurements; the stages of speed passed on no device, see "
                         f"{file.parent / 'summary.md'}")
    return figures
