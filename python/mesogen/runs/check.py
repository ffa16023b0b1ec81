"""What mesogen says against cases, asked before the first run starts.

recorded: what the observers of a case will record, {observer: {quantity: columns}}, with 0 columns for a single number
per sample.
"""

import json
import subprocess

from ..errors import StudyError
from .execution import without_prefix
from .overrides import set_arguments
from .table_reader import nearest


def check_cases(file, program, case, changes, unfit, joined=", ".join):
    """Asks mesogen whether the case can be run with each of the changes. Runs nothing.

    file: the study or sweep, for messages. program: the command `mesogen`. changes: {name: overrides}. unfit: function
    that takes `recorded` of an accepted case and gives further problems, one text each. joined: function that makes
    one text of the names with the same problem. Raises StudyError with mesogen's own words.
    """
    problems = {}
    for name, overrides in changes.items():
        refused, recorded = _ask(program, case, overrides)
        for line in refused or unfit(recorded):
            problems.setdefault(line, []).append(name)
    if problems:
        raise StudyError([f"{file}: {joined(names)}: {line}" for line, names in problems.items()])


def unfit_series(recorded, wanted, purpose):
    """One text for each wanted series that will not be recorded, or is no single number per sample.

    wanted: (place in a file, observer, quantity) of each. purpose: why it must be a number: "a sweep collects numbers".
    """
    for place, observer, quantity in wanted:
        there = recorded.get(observer)
        if there is None:
            yield f"{place}: the case has no observer '{observer}'" + nearest(observer, sorted(recorded))
        elif quantity not in there:
            yield f"{place}: observer '{observer}' records no '{quantity}'" + nearest(quantity, sorted(there))
        elif there[quantity] > 0:
            yield f"{place}: '{observer}.{quantity}' is a table in each sample; {purpose}"


def _ask(program, case, overrides):
    """(lines that mesogen says against the case, `recorded`); no lines if the case can be run."""
    done = subprocess.run([program, "quantity", "list", "--json", case, *set_arguments(overrides)],
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return without_prefix(done.stderr).splitlines(), {}
    return [], {observer: {name: one["columns"] for name, one in quantities.items()}
                for observer, quantities in json.loads(done.stdout).items()}
