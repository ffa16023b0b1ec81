"""Whether what is asked for will be recorded, known from the observers of a case before anything is run.

recorded: {observer: {quantity: columns}}, with 0 columns for a single number (execution.refusals).
"""

from .table_reader import nearest


def unfit_series(recorded, wanted, purpose):
    """Lines about series that will not be there, or are no numbers.

    wanted: (place, observer, quantity) of each. purpose: why it must be a number: "a sweep collects numbers".
    """
    for place, observer, quantity in wanted:
        there = recorded.get(observer)
        if there is None:
            yield f"{place}: the case has no observer '{observer}'" + nearest(observer, sorted(recorded))
        elif quantity not in there:
            yield f"{place}: observer '{observer}' records no '{quantity}'" + nearest(quantity, sorted(there))
        elif there[quantity] > 0:
            yield f"{place}: '{observer}.{quantity}' is a table in each sample; {purpose}"


def observer_of(recorded, quantities):
    """The first observer that records all these quantities, None if there is none."""
    return next((name for name in sorted(recorded) if set(quantities) <= set(recorded[name])), None)


def unfit_answer(recorded, answer):
    """Lines about the quantities of a scene's answer."""
    wanted = [(f"{answer.file}: quantity[{number}].series", one.observer, one.column)
              for number, one in enumerate(answer.quantities, start=1)]
    return unfit_series(recorded, wanted, "an answer is about one number at a time")
