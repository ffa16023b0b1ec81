"""What may import what: charts, sweep and study build on runs, and know nothing of each other."""

import ast
import pathlib
import unittest

PACKAGE = pathlib.Path(__file__).resolve().parent.parent / "mesogen"
COMMANDS = {"charts", "sweep", "study"}


def imported(file):
    """Names below mesogen of all that a file imports, as "runs.ledger"."""
    here = ("mesogen", *file.relative_to(PACKAGE).parts)
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            start = here[:len(here) - node.level] if node.level else ()
            names = [".".join(filter(None, (*start, node.module, one.name))) for one in node.names]
        elif isinstance(node, ast.Import):
            names = [one.name for one in node.names]
        else:
            continue
        yield from (name.removeprefix("mesogen.") for name in names if name.startswith("mesogen."))


class Packages(unittest.TestCase):
    def test_dependencies_go_one_way(self):
        seen = set()
        for folder in (*COMMANDS, "runs"):
            for file in (PACKAGE / folder).rglob("*.py"):
                others = {name.split(".")[0] for name in imported(file)}
                seen |= others
                self.assertEqual(others & COMMANDS - {folder}, set(), file)
        self.assertLessEqual({"runs", "run", "errors", "units"}, seen, "the test sees no imports")

    def test_results_are_read_without_runs(self):
        for file in [*PACKAGE.glob("*.py"), *(PACKAGE / "figures").glob("*.py")]:
            self.assertEqual({name.split(".")[0] for name in imported(file)} & {*COMMANDS, "runs"}, set(), file)


if __name__ == "__main__":
    unittest.main()
