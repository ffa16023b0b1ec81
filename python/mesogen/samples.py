"""What the observers of a run recorded over time."""

import numpy as np

from .errors import MesogenError, NoSuchName, missing
from .units import stored_unit

GROUP = "observables"  # where results.h5 holds the samples


def observer_of(observers, quantities):
    """The first of the observers, {observer: quantities}, that records all these quantities; None if there is none."""
    return next((name for name in sorted(observers) if set(quantities) <= set(observers[name])), None)


class Samples:
    """The part of a Run that reads samples. The Run has `file`, its path, and `_file`, the open h5py.File."""

    @property
    def observers(self):
        """What the observers recorded: {observer: [quantities]}, named as in the case."""
        group = self._file.get(GROUP, {})
        return {name: sorted(group[name]) for name in sorted(group)}

    def observer_of(self, *quantities):
        """Name of the first observer that recorded all these quantities, None if there is none."""
        return observer_of(self.observers, quantities)

    def series(self, observer, quantity):
        """Samples of a quantity over time. Raises NoSuchName if it was not recorded.

        Returns (time, value): time of shape (T,) in time_unit; value in series_unit(), of shape (T,) for a scalar,
        (T, rows, columns) for a table. Tables of varying length (defects) are padded with NaN; see table().
        """
        recorded = self._recorded(observer, quantity)
        return np.asarray(recorded["time"], dtype=float), np.asarray(recorded["value"])

    def series_steps(self, observer, quantity):
        """Step number of each sample, shape (T,)."""
        return np.asarray(self._recorded(observer, quantity)["step"], dtype=np.int64)

    def series_unit(self, observer, quantity):
        """Unit of a recorded quantity, as text; "1" for numbers."""
        return stored_unit(self._recorded(observer, quantity)["value"])

    def table(self, observer, quantity, sample=-1):
        """One sample of a table without its padding, shape (rows, columns)."""
        recorded = self._recorded(observer, quantity)
        value = recorded["value"]
        if value.ndim != 3:
            raise MesogenError(f"quantity '{quantity}' of observer '{observer}' is no table; use series()")
        if not -len(value) <= sample < len(value):
            raise NoSuchName(f"no sample {sample} of '{quantity}'; observer '{observer}' holds {len(value)}")
        sample %= len(value)
        rows = value[sample]
        return rows[: int(recorded["count"][sample])] if "count" in recorded else rows

    def _recorded(self, observer, quantity):
        observers = self.observers
        if observer not in observers:
            raise missing("observer", observer, observers, self.file)
        if quantity not in observers[observer]:
            raise missing("quantity", quantity, observers[observer], f"observer '{observer}' of {self.file}")
        return self._file[GROUP][observer][quantity]

    def _sample_clocks(self):
        """The datasets of the times of all quantities."""
        return (self._file[GROUP][observer][quantity]["time"]
                for observer, quantities in self.observers.items() for quantity in quantities)
