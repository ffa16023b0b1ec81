"""Verdicts of scripts/device: one line for each thing that was checked, the table of them, and the exit code."""

import json
import typing

PASS, FAIL, NOT_RUN = "PASS", "FAIL", "NOT RUN"


class NotRun(Exception):
    """Something cannot be checked here; the text says why, and what would mend it."""


class Line(typing.NamedTuple):
    """What was checked in which stage, the verdict, a sentence of detail or reason, and numbers by name."""
    stage: str
    what: str
    verdict: str
    detail: str = ""
    numbers: dict = {}


class Report:
    """What a stage has found so far. Each line is written to a file at once, so a stage that is killed for taking too
    long keeps what it had found."""

    def __init__(self, stage, file):
        self.stage = stage
        self.file = file

    def line(self, what, verdict, detail="", **numbers):
        print(f"{verdict}: {what}: {detail}", flush=True)
        self._write({"line": [self.stage, what, verdict, detail, numbers]})

    def judge(self, what, good, detail="", **numbers):
        """PASS or FAIL."""
        self.line(what, PASS if good else FAIL, detail, **numbers)

    def figures(self, figures):
        """Figures (bench/speed_tables.py) for the tables of docs/performance.md."""
        self._write({"figures": [list(figure) for figure in figures]})

    def _write(self, record):
        with open(self.file, "a", encoding="utf-8") as out:
            out.write(json.dumps(record) + "\n")


def read_report(file):
    """(lines, figures) of a Report's file; nothing where there is no file. A last line that is cut off is left out."""
    lines, figures = [], []
    if not file.exists():
        return lines, figures
    for text in file.read_text(encoding="utf-8").splitlines():
        try:
            record = json.loads(text)
        except json.JSONDecodeError:
            continue
        if "line" in record:
            lines.append(Line(*record["line"]))
        figures += record.get("figures", [])
    return lines, figures


def exit_code(lines):
    """0: all passed; 1: something failed; 3: nothing failed, but something was not run."""
    verdicts = {line.verdict for line in lines}
    if FAIL in verdicts or not lines:
        return 1
    return 3 if NOT_RUN in verdicts else 0


def summary(lines, heading):
    """The table of all verdicts as Markdown. heading: a sentence on what was measured, and when."""
    rows = [["stage", "what", "verdict", "detail"], ["---"] * 4]
    rows += [[line.stage, line.what, line.verdict, line.detail] for line in lines]
    table = "\n".join("| " + " | ".join(" ".join(cell.replace("|", "/").split()) for cell in row) + " |"
                      for row in rows)
    counts = {verdict: sum(line.verdict.startswith(verdict) for line in lines) for verdict in (PASS, FAIL, NOT_RUN)}
    total = ", ".join(f"{number} {verdict}" for verdict, number in counts.items())
    return f"# scripts/device\n\n{heading}\n\n{table}\n\n{total}\n"
