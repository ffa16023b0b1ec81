"""Charts of studies: the same bytes each time, no label upon another, failures drawn."""

import math
import os
import pathlib
import unittest

import synthetic
from matplotlib.text import Text
from test_charts_analysis import point

from mesogen.charts.drawing import error_cost, error_resolution, labels, look


def many(variants=10, resolutions=(16, 24, 32, 48, 64)):
    """Points as a large study has them, two of them failures."""
    found = []
    for v in range(variants):
        for n in resolutions:
            error = (0.6 + 0.25 * math.sin(7 * v)) * (n / 16) ** -(1 + 0.15 * v) / (1 + v)
            found.append(point(f"variant_{v}", n, error, (n / 16) ** 3.3 * (0.2 + 0.13 * v)))
    found[7] = point("variant_1", 32, 0, 0.4, "broke down")
    found[24] = point("variant_4", 64, 0, 3.0, "took longer than 3 s")
    return found


def extents(page):
    """Boxes of the words of all labels, without what ties them to their markers."""
    page.canvas.draw()
    renderer = page.canvas.get_renderer()
    return [Text.get_window_extent(text, renderer) for text in page.axes[0].texts]


class Drawing(synthetic.FolderTest):
    def setUp(self):
        super().setUp()
        os.mkdir(self.folder)

    def test_equal_points_give_equal_bytes(self):
        for module in (error_cost, error_resolution):
            written = []
            for name in ("one", "two"):
                with look.settings():
                    files = look.save(module.draw("Title", "scene", many()), os.path.join(self.folder, name))
                written.append([pathlib.Path(file).read_bytes() for file in files])
            self.assertEqual(written[0], written[1], module.__name__)
            self.assertTrue(written[0][0].startswith(b"\x89PNG"))
            self.assertNotIn(b"<dc:date>", written[0][1])

    def test_no_label_covers_another(self):
        with look.settings():
            boxes = extents(error_cost.draw("Title", "scene", many()))
        self.assertGreater(len(boxes), 5)
        for number, box in enumerate(boxes):
            for other in boxes[:number]:
                self.assertFalse(box.overlaps(other))

    def test_a_label_avoids_a_line(self):
        with look.settings():
            page, axes = look.chart("Title")
            line = [(0.0, 0.0), (0.5, 0.5), (1.0, 1.0)]
            axes.set(xlim=(0, 1), ylim=(0, 1))
            labels.place_labels(axes, [(0.5, 0.5, "a label of some length")], [line])
            (box,) = extents(page)
            for share in range(101):
                self.assertFalse(box.contains(*axes.transData.transform((share / 100, share / 100))))

    def test_a_long_legend_stays_on_the_page(self):
        for module in (error_cost, error_resolution):
            with look.settings():
                page = module.draw("Title", "scene", many(variants=26))
                page.canvas.draw()
                box = page.axes[0].get_legend().get_window_extent()
            self.assertGreater(box.y0, 0.0, module.__name__)

    def test_failures_are_crosses(self):
        with look.settings():
            axes = error_resolution.draw("Title", "scene", many()).axes[0]
            crosses = [tuple(line.get_xdata()) for line in axes.lines if line.get_marker() == "x"]
        self.assertEqual([places for places in crosses if places], [(32,), (64,)])

    def test_the_legend_has_the_order(self):
        with look.settings():
            axes = error_resolution.draw("Title", "scene", [point("a", n, 1 / n**2, n) for n in (10, 20, 40)]).axes[0]
        self.assertEqual([text.get_text() for text in axes.get_legend().get_texts()], ["a, order 2.0"])

    def test_ticks_are_never_few_and_numbers_short(self):
        self.assertEqual(look.log_ticks(0.9, 1200.0), [1.0, 10.0, 100.0, 1000.0])
        self.assertEqual(look.log_ticks(1.5, 30.0), [2.0, 5.0, 10.0, 20.0])
        self.assertEqual([look.plain(x) for x in (0.05, 1200.0, 2e6, 5e-5, 1e-6)],
                         ["0.05", "1200", "2·10⁶", "5·10⁻⁵", "10⁻⁶"])


if __name__ == "__main__":
    unittest.main()
