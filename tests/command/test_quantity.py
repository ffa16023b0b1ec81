"""quantity list: what the observers of a case record."""

import json
import unittest

from support import CASE, CommandTest

TABLE = '[observers.tracks]\ntype = "defects"\ninterval = 0.05\n[output]'


class QuantityList(CommandTest):
    def test_for_people(self):
        out, _ = self.mesogen("quantity", "list", self.write_case(CASE.replace("[output]", TABLE)))
        lines = out.splitlines()
        self.assertRegex(lines[0], "^QUANTITY +A SAMPLE IS +UNIT$")
        self.assertRegex(out, r"(?m)^flow\.v_rms +one number +m/s +root of the mean square velocity")
        self.assertRegex(out, r"(?m)^tracks\.defects +a changing number of rows of 4 numbers m, m, 1, rad ")

    def test_for_programs(self):
        out, _ = self.mesogen("quantity", "list", "--json", self.write_case(CASE.replace("[output]", TABLE)),
                              "--set", "observers.tracks.type=pathlines")
        found = json.loads(out)
        self.assertEqual(sorted(found), ["flow", "tracks"])
        v_rms = found["flow"]["v_rms"]
        self.assertEqual((v_rms["unit"], v_rms["columns"], v_rms["varying"]), ("m/s", 0, False))
        self.assertEqual(found["tracks"]["path"]["columns"], 2)

    def test_a_case_that_is_wrong(self):
        _, err = self.mesogen("quantity", "list", self.write_case(CASE.replace("viscosity", "viscocity")), code=2)
        self.assertIn('viscocity: unknown key; did you mean "viscosity"?', err)


if __name__ == "__main__":
    unittest.main()
