"""runs.csv and the other files of a folder of runs."""

import math
import os

import synthetic

from mesogen.errors import StudyError
from mesogen.runs.ledger import Ledger, csv_text, locked, stopped_too_early

COLUMNS = ("key", "seconds", "reason")


class Ledgers(synthetic.FolderTest):
    def setUp(self):
        super().setUp()
        os.makedirs(self.folder)
        self.file = os.path.join(self.folder, "runs.csv")

    def test_keeps_every_digit_and_one_line_per_run(self):
        Ledger(self.file, COLUMNS).add({"key": "a", "seconds": 0.1 + 0.2, "reason": "two\nlines, and a comma"})
        Ledger(self.file, COLUMNS).add({"key": "b"})
        rows = Ledger(self.file, COLUMNS).rows
        self.assertEqual(rows, [{"key": "a", "seconds": "0.30000000000000004", "reason": "two lines, and a comma"},
                                {"key": "b", "seconds": "", "reason": ""}])

    def test_a_line_that_was_cut_off_is_dropped(self):
        Ledger(self.file, COLUMNS).add({"key": "a"})
        with open(self.file, "a", encoding="utf-8") as file:
            file.write("b,1.")
        Ledger(self.file, COLUMNS).add({"key": "c"})
        self.assertEqual([row["key"] for row in Ledger(self.file, COLUMNS).rows], ["a", "c"])

    def test_columns_of_another_version(self):
        Ledger(self.file, COLUMNS).add({"key": "a"})
        with self.assertRaisesRegex(StudyError, "its columns are not those of this version; move the file away, and all "
                                                "runs are done again"):
            Ledger(self.file, ("key", "other"))

    def test_a_folder_in_use(self):
        with locked(self.folder):
            with self.assertRaisesRegex(StudyError, "another study is writing into .*; choose another folder with --output"):
                locked(self.folder).__enter__()
            with self.assertRaisesRegex(StudyError, "^busy$"):
                locked(self.folder, "busy").__enter__()

    def test_numbers_that_are_not_finite_are_left_empty(self):
        self.assertEqual(csv_text(("a", "b", "c", "d"), [(math.nan, None, math.inf, 0.1)]), "a,b,c,d\n,,,0.1\n")

    def test_more_time_than_a_run_had(self):
        row = {"wall_seconds": "0.5"}
        self.assertEqual([stopped_too_early(row, timeout) for timeout in (0.5, 0.6, None)], [False, True, True])


if __name__ == "__main__":
    synthetic.unittest.main()
