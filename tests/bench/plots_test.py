#!/usr/bin/env python3
"""Plots of results: what is drawn, and what is refused. Usage: plots_test.py [FACET]; with the
program, and a device, a real sweep is plotted, too. Exit code 77 without matplotlib."""

import os
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from plots_helper import PlotsTest, estimate  # noqa: E402

PROGRAM = sys.argv[1] if len(sys.argv) > 1 else None


def shape(name, ms):
    return {"shape": name, "standing": "measured", "warm_up_ms": 1, "kernel": estimate(ms),
            "wall": estimate(2 * ms), "speed_up": {
                "kernel": {"value": 50 / ms, "interval": [40 / ms, 60 / ms]},
                "wall": {"value": 25 / ms, "interval": [20 / ms, 30 / ms]}}}


def experiment(name):
    shapes = [shape("1x1", 20), shape("2x1", 11), shape("1x2", 12), shape("2x2", 6),
              shape("4x1", 7), shape("1x4", 9), shape("4x2", 3), shape("driver", 5)]
    shapes.append({"shape": "64x64", "standing": "refused", "reason": "too large"})
    shapes.append({"shape": "2x4", "standing": "different", "reason": "1 of 99 pixels"})
    return {
        "name": name, "complete": True,
        "scene": {"name": "made up", "hash": "fnv1a64:0123456789abcdef", "triangles": 1234,
                  "instances": 1},
        "picture": {"width": 64, "height": 32, "max_depth": 2, "samples": 1},
        "tree": {"kind": "none" if name == "no-tree" else "levels", "depth": 0, "nodes": 0},
        "kernel": {"text_hash": "fnv1a64:00000000000000aa"},
        "serial": {"build_ms": 1, "wall": estimate(50), "pixels_off": 0},
        "best": ["4x2"], "shapes": shapes, "order": []}


def result(*names):
    return {
        "format": "facet-sweep", "version": 1, "complete": True, "date": "2026-01-31T23:59:59Z",
        "facet": {"version": "0.1.0", "commit": "0123456789abcdef0123456789abcdef01234567"},
        "device": {"name": "Abacus 9000", "driver": "1.2.3"}, "cpu": "Some CPU",
        "settings": {"repeats": 10, "bootstrap": {"level": 0.95}},
        "experiments": [experiment(name) for name in names or ("tree",)]}


class Plots(PlotsTest):
    def test_each_experiment_has_its_plots_as_png_and_svg(self):
        code, said = self.run_plots(self.put("a.json", result("no-tree", "tree")))
        self.assertEqual(code, 0, said)
        names = [f"a-{e}-{kind}.{extension}" for e in ("no-tree", "tree")
                 for kind in ("blocks", "shapes") for extension in ("png", "svg")]
        self.assertEqual(sorted(os.listdir(self.path("plots"))), sorted(names))
        with open(self.path("plots/a-tree-blocks.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")

    def test_axes_have_units_and_each_plot_names_scene_device_and_date(self):
        self.run_plots(self.put("a.json", result()))
        blocks, shapes = self.texts("a-tree-blocks.svg"), self.texts("a-tree-shapes.svg")
        for text in (blocks, shapes):
            for part in ("made up, 1,234 triangles", "Abacus 9000", "driver 1.2.3", "Some CPU",
                         "2026-01-31T23:59:59Z", "1 refused by the device (64\u00d764)",
                         "1 with another picture (2\u00d74)"):
                self.assertIn(part, text)
        for part in ("kernel time (ms)", "work-items of a group", "speed-up", "serial reference",
                     "the driver's choice"):
            self.assertIn(part, blocks)
        for part in ("width of a group (work-items)", "kernel time in ms", "20", "11"):
            self.assertIn(part, shapes)

    def test_what_was_interrupted_says_so(self):
        interrupted = result()
        interrupted["complete"] = False
        interrupted["experiments"][0]["shapes"][0]["kernel"] = {"samples_ms": [], "summary": None}
        code, _ = self.run_plots(self.put("a.json", interrupted))
        self.assertEqual(code, 0)
        self.assertIn("interrupted, not complete", self.texts("a-tree-blocks.svg"))

    def test_without_the_serial_reference_there_are_times(self):
        alone = result()
        for e in alone["experiments"]:
            e["serial"]["wall"] = {"samples_ms": [], "summary": None}
            for s in e["shapes"]:
                if "speed_up" in s:
                    s["speed_up"] = {"kernel": None, "wall": None}
        self.assertEqual(self.run_plots(self.put("a.json", alone))[0], 0)

    def test_the_same_data_give_the_same_bytes(self):
        file = self.put("a.json", result())
        self.run_plots(file)
        self.run_plots(file, out="again")
        for name in ("a-tree-blocks.svg", "a-tree-shapes.svg"):
            with open(self.path(f"plots/{name}"), "rb") as one, \
                    open(self.path(f"again/{name}"), "rb") as other:
                self.assertEqual(one.read(), other.read())

    def test_two_devices_on_one_scene_stand_side_by_side(self):
        other = result()
        other["device"]["name"] = "Slide rule"
        code, _ = self.run_plots(self.put("a.json", result()), self.put("b.json", other))
        self.assertEqual(code, 0)
        text = self.texts("a-tree-blocks.svg")
        self.assertIn("Abacus 9000", text)
        self.assertIn("Slide rule", text)

    def test_another_format_or_version_is_refused(self):
        self.refused(['found the format "npy"', '"facet-sweep"'],
                     self.put("a.json", {"format": "npy", "version": 1}))
        self.refused(["found the format null"], self.put("a.json", [1, 2]))
        newer = result()
        newer["version"] = 2
        self.refused(["a.json", "found version 2 of facet-sweep", "allowed: 1"],
                     self.put("a.json", newer))

    def test_what_is_no_result_is_refused_with_its_place(self):
        self.refused(["none.json", "cannot be read"], self.path("none.json"))
        self.refused(["line 1, column 2"], self.put("a.json", "{"))
        lacking = result("no-tree", "tree")
        del lacking["experiments"][1]["scene"]["hash"]
        self.refused(['/experiments/1/scene: lacks "hash"'], self.put("a.json", lacking))
        wrong = result()
        wrong["experiments"][0]["shapes"][2]["kernel"]["summary"]["median_ms"] = "fast"
        self.refused(["/experiments/0/shapes/2/kernel/summary/median_ms", '"fast"'],
                     self.put("a.json", wrong))

    def test_results_of_different_scenes_are_not_mixed(self):
        changes = {
            "another scene": lambda e: e["scene"].update(hash="fnv1a64:fedcba9876543210"),
            "another picture": lambda e: e["picture"].update(width=65),
            "another kernel text": lambda e: e["kernel"].update(text_hash="fnv1a64:00"),
        }
        file = self.put("a.json", result("no-tree", "tree"))
        for word, change in changes.items():
            other = result("no-tree", "tree")
            change(other["experiments"][1])
            self.refused(["a.json", "b.json", "experiment tree", word], file,
                         self.put("b.json", other))
        self.refused(["b.json", "has no experiment tree"], file,
                     self.put("b.json", result("no-tree")))

    @unittest.skipUnless(PROGRAM and subprocess.run(
        [PROGRAM or "", "devices"], capture_output=True).returncode == 0, "no program or no device")
    def test_a_real_sweep_is_plotted(self):
        subprocess.run(
            [PROGRAM, "sweep", "icosphere:1", "--json", self.path("real.json"), "--large",
             "terrain:4", "--shapes", "1x1,2x2,32768x2,driver", "--width", "16", "--repeats", "2",
             "--experiments", "tree,large", "-q"], check=True, capture_output=True)
        code, said = self.run_plots(self.path("real.json"))
        self.assertEqual(code, 0, said)
        self.assertEqual(len(os.listdir(self.path("plots"))), 2 * 2 * 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
