"""Maps of stability studies: the same bytes each time, bars and lines, what failed shown."""

import os
import pathlib
import types
import unittest

import synthetic

from mesogen.charts.drawing import look, stability_map
from mesogen.charts.search import Sweep
from mesogen.charts.stability import Found


def study(across=(), log=True):
    variants = tuple(types.SimpleNamespace(name=name) for name in ("default", "no_shift"))
    return types.SimpleNamespace(title="Steps", sweep=Sweep(0.5, 32.0, log, 0.05), sweep_name="step", variants=variants,
                                 across_key="viscosity" if across else None, across_name="viscosity", across_values=across)


def searches(made, *limits):
    """A search for each cell, which held below its limit."""
    cells = [types.SimpleNamespace(variant=variant, across=value, name=f"{variant.name}, {value}")
             for variant in made.variants for value in made.across_values or (None,)]
    found = []
    for cell, limit in zip(cells, limits, strict=True):
        rows = {value: {"how": "density" if value >= limit else ""} for value in (0.5, 2.0, 2.1, 8.0, 8.2, 32.0)}
        values = sorted(rows)
        edges = [(low, high, rows[high]) for low, high in zip(values, values[1:]) if rows[low]["how"] != rows[high]["how"]]
        found.append(Found(cell, rows, edges, True))
    return found


class Map(synthetic.FolderTest):
    def drawn(self, made, *limits):
        with look.settings():
            return stability_map.draw(made, searches(made, *limits))

    def test_equal_searches_give_equal_bytes(self):
        os.mkdir(self.folder)
        for made, limits in ((study(), (2.1, 8.2)), (study((0.1, 1.0)), (2.1, 8.2, 2.1, 99.0))):
            written = []
            for name in ("one", "two"):
                with look.settings():
                    files = look.save(stability_map.draw(made, searches(made, *limits)), os.path.join(self.folder, name))
                written.append([pathlib.Path(file).read_bytes() for file in files])
            self.assertEqual(written[0], written[1])

    def test_bars_without_a_second_parameter(self):
        axes = self.drawn(study(), 2.1, 99.0).axes[0]
        words = [text.get_text() for text in axes.texts]
        self.assertIn("density at 2.1", words)
        self.assertIn("holds over the whole range", words)
        self.assertEqual([label.get_text() for label in axes.get_yticklabels()], ["default, None", "no_shift, None"])

    def test_lines_over_a_second_parameter(self):
        axes = self.drawn(study((0.1, 1.0)), 2.1, 8.2, 0.1, 99.0).axes[0]
        markers = [(line.get_marker(), tuple(line.get_xdata())) for line in axes.lines if len(line.get_xdata()) == 1]
        self.assertEqual(markers, [("D", (0.1,)), ("D", (1.0,)), ("x", (0.1,))])
        self.assertEqual([text.get_text() for text in axes.get_legend().get_texts()],
                         ["default", "no_shift", "density", "fails over the whole range"])

    def test_spans_cover_what_was_tried(self):
        made = study(log=False)
        (found, _) = searches(made, 2.1, 99.0)
        self.assertEqual([(low, high, held) for low, high, held in stability_map.spans(made.sweep, found)],
                         [(0.5, 2.0, True), (2.0, 2.05, True), (2.05, 2.1, False), (2.1, 8.0, False), (8.0, 8.2, False),
                          (8.2, 32.0, False)])

    def test_every_way_to_fail_has_a_marker(self):
        from mesogen.charts import judge
        ways = {name for name, _ in judge.WAYS} | set(judge.CRITERIA) | {"stopped"}
        self.assertEqual(ways, set(stability_map.WAYS))


if __name__ == "__main__":
    unittest.main()
