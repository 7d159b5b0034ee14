#!/usr/bin/env python3
"""A second run of a sweep against the first. Exit code 77 without matplotlib, as its neighbours."""

import contextlib
import copy
import io
import sys
import unittest

sys.dont_write_bytecode = True
from plots_helper import FilesTest  # noqa: E402
import agreement  # noqa: E402
import plots_test  # noqa: E402


class Agreement(FilesTest):
    def compared(self, first, second):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            code = agreement.main([self.put("a.json", first), self.put("b.json", second)])
        return code, out.getvalue()

    def test_a_run_agrees_with_itself(self):
        run = plots_test.result("tree")
        code, said = self.compared(run, run)
        self.assertEqual(code, 0)
        self.assertNotIn("does not agree", said)
        self.assertIn("of 7 shapes, 7 agree in time and 7 in speed-up", said)

    def test_intervals_apart_do_not_agree(self):
        run = plots_test.result("tree")
        other = copy.deepcopy(run)
        summary = other["experiments"][0]["shapes"][0]["kernel"]["summary"]  # 1x1
        summary["median_ms"], summary["interval_ms"] = 30, [25, 31]  # it was [18, 24]
        code, said = self.compared(run, other)
        self.assertEqual(code, 0)
        self.assertIn("+50.0%  does not agree", said)
        self.assertIn("of 7 shapes, 6 agree in time", said)

    def test_another_device_or_scene_is_refused(self):
        run = plots_test.result("tree")
        other = copy.deepcopy(run)
        other["device"]["name"] = "Another"
        paths = [self.put("a.json", run), self.put("b.json", other)]
        self.assertEqual(self.said_by(agreement.main, *paths)[0], 3)
        other = copy.deepcopy(run)
        other["experiments"][0]["scene"]["hash"] = "fnv1a64:00000000000000bb"
        paths = [self.put("a.json", run), self.put("b.json", other)]
        code, said = self.said_by(agreement.main, *paths)
        self.assertEqual(code, 3)
        self.assertIn("another scene", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
