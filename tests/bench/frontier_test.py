#!/usr/bin/env python3
"""Plots of speed against error: what is drawn, and what is refused. Usage: frontier_test.py [FACET];
with the program, and a device, a real study is plotted, too. Exit code 77 without matplotlib."""

import copy
import os
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from plots_helper import PlotsTest, estimate  # noqa: E402
import frontier_figures  # noqa: E402
import plot_labels  # noqa: E402
import plot_style  # noqa: E402
import variant_results  # noqa: E402
from matplotlib.text import Text  # noqa: E402

PROGRAM = sys.argv[1] if len(sys.argv) > 1 else None


def variant(name, family, ms, rmse, flip, errors=0, ties=0, hits_of=None):
    hit_errors = {"wrong": errors + ties, "ties": ties, "silhouettes": 0, "errors": errors}
    return {
        "name": name, "family": family, "about": name, "state": "measured", "max_depth": 2,
        "promised_exact": family == "exact", "hits_of": hits_of or name,
        "picture": {
            "kernel": estimate(ms), "rays": 1000,
            "errors": {"linear": {"all": {"rmse": 2 * rmse}, "without_silhouettes": {"rmse": rmse}},
                       "displayed": {"flip_mean": flip}}},
        "hits": [{"rays": kind, "count": 500, "kernel": estimate(ms / 4), "errors": dict(hit_errors)}
                 for kind in ("eye", "bounce")]}


def result():
    return {
        "format": "facet-variants", "version": 1, "complete": True, "date": "2026-01-31T23:59:59Z",
        "facet": {"version": "0.1.0", "commit": "0123456789abcdef0123456789abcdef01234567"},
        "device": {"name": "Abacus 9000", "driver": "1.2.3"}, "cpu": "Some CPU",
        "settings": {"repeats": 10, "bootstrap": {"level": 0.95}},
        "scene": {"name": "made up", "hash": "fnv1a64:0123456789abcdef", "triangles": 1234,
                  "instances": 1},
        "picture": {"width": 64, "height": 32, "max_depth": 2, "samples": 1},
        "variants": [
            variant("strict", "exact", 10, 1e-5, 0, ties=2),
            variant("fast-math", "arithmetic", 9, 2e-5, 1e-4, errors=3),
            variant("moller-trumbore", "moller-trumbore", 8, 1e-3, 1e-3, errors=5),
            variant("depth-1", "fewer bounces", 4, 1e-2, 2e-2, hits_of="strict"),
            variant("abacus", "beads", 12, 1e-1, 0.5),
            {"name": "images", "family": "exact", "about": "", "state": "refused", "max_depth": 2,
             "promised_exact": True, "hits_of": "images", "reason": "no images"}]}


class Frontier(PlotsTest):
    def test_each_layer_has_its_plot_with_units_names_scene_device_and_date(self):
        code, said = self.run_plots(self.put("a.json", result()))
        self.assertEqual(code, 0, said)
        self.assertEqual(sorted(os.listdir(self.path("plots"))), sorted(
            f"a-{layer}.{extension}" for layer in ("hits", "linear", "displayed")
            for extension in ("png", "svg")))
        with open(self.path("plots/a-hits.png"), "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        units = {"hits": ("(Mrays/s)", "per million rays"), "linear": ("(Mpixels/s)", "RMSE"),
                 "displayed": ("(Mpixels/s)", "FLIP")}
        for layer, axes in units.items():
            text = self.texts(f"a-{layer}.svg")
            for part in (*axes, "made up, 1,234 triangles", "Abacus 9000", "driver 1.2.3",
                         "2026-01-31T23:59:59Z", "64\u00d732 pixels", "strict", "fast-math", "MT",
                         "abacus", "frontier", "refused by the device: images"):
                self.assertIn(part, text)
        # What changes shading alone has the strict one's hits: it is no point of that plot.
        self.assertIn("depth-1", self.labels("a-linear.svg"))
        self.assertNotIn("depth-1", self.labels("a-hits.svg"))
        # An error of 0 has its tick where there is one.
        self.assertIn("0", self.labels("a-displayed.svg"))
        self.assertNotIn("0", self.labels("a-linear.svg"))

    def test_an_error_of_0_has_its_place_below_all_others(self):
        axis = frontier_figures.ErrorAxis([0, 3e-4, 0.2])
        self.assertTrue(axis.has_zero)
        self.assertLess(axis.place(0), 1e-4)
        self.assertEqual(axis.place(0.2), 0.2)
        nothing_wrong = frontier_figures.ErrorAxis([0, 0])
        self.assertGreater(nothing_wrong.place(0), 0)

    def test_the_frontier_holds_what_nothing_beats(self):
        points = [(1, 0), (2, 0.1), (2, 0.2), (3, 0.1), (4, 0.5), (3.5, 0.6), (1, 0)]
        self.assertEqual(frontier_figures.frontier(points), [(1, 0), (3, 0.1), (4, 0.5)])
        self.assertEqual(frontier_figures.frontier([]), [])

    def test_speeds_follow_from_times_and_their_intervals(self):
        read = variant_results.read_variants(self.put("a.json", result())).variants[0]
        # 64 * 32 pixels in 10 ms; the interval of time is 9 to 12 ms.
        self.assertAlmostEqual(read.pixels.value, 0.2048)
        self.assertAlmostEqual(read.pixels.low, 2048 / 12 * 1e-3)
        self.assertAlmostEqual(read.pixels.high, 2048 / 9 * 1e-3)
        self.assertAlmostEqual(read.rays.value, 1000 / 5 * 1e-3)
        self.assertEqual(read.errors_per_million, 0)
        self.assertEqual(read.wrong_per_million, 4000)

    def test_names_beside_crowded_points_cover_nothing(self):
        figure, axes = plot_style.plt.subplots(figsize=(6, 5))
        axes.set_xlim(0, 10)
        axes.set_ylim(0, 10)
        points = [(f"variant-{k}", 5 + 0.12 * (k % 4), 5 + 0.1 * (k // 4), k == 0) for k in range(12)]
        plot_labels.place_labels(axes, points)
        figure.canvas.draw()
        renderer = figure.canvas.get_renderer()
        boxes = [Text.get_window_extent(t, renderer) for t in axes.texts]  # without its line
        plot_style.plt.close(figure)
        self.assertEqual([t.get_text() for t in axes.texts][0], "variant-0")
        self.assertEqual(len(boxes), 12)
        frame = axes.get_window_extent(renderer)
        places = axes.transData.transform([(x, y) for _, x, y, _ in points])
        for k, box in enumerate(boxes):
            self.assertFalse(any(box.overlaps(other) for other in boxes[k + 1:]))
            self.assertFalse(any(box.contains(x, y) for x, y in places))
            self.assertTrue(frame.contains(box.x0, box.y0) and frame.contains(box.x1, box.y1))

    def test_what_was_interrupted_says_so(self):
        interrupted = result()
        interrupted["complete"] = False
        unfinished = interrupted["variants"][2]
        unfinished["state"] = "unfinished"
        for part in (unfinished["picture"], *unfinished["hits"]):
            part["kernel"] = {"samples_ms": [], "summary": None}
        self.assertEqual(self.run_plots(self.put("a.json", interrupted))[0], 0)
        text = self.texts("a-linear.svg")
        self.assertIn("interrupted, not complete", text)
        self.assertIn("not timed: moller-trumbore", text)

    def test_the_same_data_give_the_same_bytes(self):
        file = self.put("a.json", result())
        self.run_plots(file)
        self.run_plots(file, out="again")
        with open(self.path("plots/a-linear.svg"), "rb") as one, \
                open(self.path("again/a-linear.svg"), "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_two_devices_on_one_scene_stand_side_by_side(self):
        other = result()
        other["device"]["name"] = "Slide rule"
        other["picture"].update(width=640, height=320)
        code, said = self.run_plots(self.put("a.json", result()), self.put("b.json", other))
        self.assertEqual(code, 0, said)
        text = self.texts("a-hits.svg")
        for part in ("Abacus 9000", "Slide rule", "640\u00d7320 pixels"):
            self.assertIn(part, text)

    def test_results_of_different_scenes_are_not_mixed(self):
        file = self.put("a.json", result())
        other = copy.deepcopy(result())
        other["scene"]["hash"] = "fnv1a64:fedcba9876543210"
        self.refused(["a.json", "b.json", "another scene"], file, self.put("b.json", other))
        other = result()
        other["picture"]["max_depth"] = 3
        self.refused(["another depth and samples"], file, self.put("b.json", other))

    def test_another_format_or_version_is_refused(self):
        newer = result()
        newer["version"] = 2
        self.refused(["found version 2 of facet-variants", "allowed: 1"], self.put("a.json", newer))
        sweep = {"format": "facet-sweep", "version": 1}
        self.refused(["b.json: found the format facet-sweep", "a.json has facet-variants"],
                     self.put("a.json", result()), self.put("b.json", sweep))
        self.refused(['"facet-sweep", "facet-variants"'],
                     self.put("a.json", {"format": "npy", "version": 1}))

    def test_what_is_missing_is_named_with_its_place(self):
        lacking = result()
        del lacking["variants"][1]["picture"]["errors"]["displayed"]["flip_mean"]
        self.refused(['/variants/1/picture/errors/displayed: lacks "flip_mean"'],
                     self.put("a.json", lacking))

    @unittest.skipUnless(PROGRAM and subprocess.run(
        [PROGRAM or "", "devices"], capture_output=True).returncode == 0, "no program or no device")
    def test_a_real_study_is_plotted(self):
        subprocess.run(
            [PROGRAM, "accuracy", "--variants", "icosphere:1", "--json", self.path("real.json"),
             "--size", "16x12", "--repeats", "2", "--only", "no-tree,cutoff-1/16", "-q"], check=True,
            capture_output=True)
        code, said = self.run_plots(self.path("real.json"))
        self.assertEqual(code, 0, said)
        self.assertEqual(len(os.listdir(self.path("plots"))), 3 * 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
