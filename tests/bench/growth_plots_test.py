#!/usr/bin/env python3
"""Plots of growth: what is drawn, and what is refused. Exit code 77 without matplotlib."""

import sys
import unittest

sys.dont_write_bytecode = True
from plots_helper import PlotsTest, estimate  # noqa: E402


def point(mesh, triangles, ms, kinds=("eye",)):
    return {"mesh": mesh, "triangles": triangles, "scene_hash": f"fnv1a64:{triangles:016x}",
            "geometry": "buffer", "tree_depth": 3, "device_bytes": 1000, "compile_ms": 1,
            "upload_ms": 1, "build": estimate(ms),
            "figures": [{"rays": rays, "count": 1000, "warm_up_ms": 1, "time": estimate(ms)}
                        for rays in kinds]}


def family(name):
    sizes = (100, 1000, 10000)
    return {"family": name, "series": [
        {"way": "tree", "ended": None, "points": [
            point(f"{name}:{n}", n, 3, ("eye", "shadow", "bounce")) for n in sizes]},
        {"way": "no-tree", "points": [point(f"{name}:100", 100, 40)],
         "ended": {"triangles": 1000, "reason": "it would take about 99 s"}},
        {"way": "serial", "ended": None, "points": [point(f"{name}:{n}", n, 9) for n in sizes]}]}


def result(*families):
    return {
        "format": "facet-growth", "version": 1, "complete": True, "date": "2026-01-31T23:59:59Z",
        "facet": {"version": "0.1.0", "commit": "0123456789abcdef0123456789abcdef01234567-modified"},
        "device": {"name": "Abacus $9000$", "driver": "1.2.3"}, "cpu": "Some CPU",
        "settings": {"picture": {"width": 64, "height": 36}, "repeats": 10, "builds": 3,
                     "bootstrap": {"level": 0.95}},
        "kernel": {"text_hash": "fnv1a64:00000000000000aa"},
        "families": [family(name) for name in families or ("soup",)]}


class GrowthPlots(PlotsTest):
    def test_each_family_has_its_plot_as_png_and_svg(self):
        code, said = self.run_plots(self.put("a.json", result("terrain", "soup")))
        self.assertEqual(code, 0, said)
        self.assertEqual(self.names("plots"), sorted(
            f"a-{name}-growth.{extension}" for name in ("terrain", "soup")
            for extension in ("png", "svg")))

    def test_axes_have_units_and_the_plot_says_device_date_and_where_series_end(self):
        self.run_plots(self.put("a.json", result()))
        text = self.texts("a-soup-growth.svg")
        for part in ("time of an eye ray (ns)", "time of a ray (ns)", "time to build (ms)",
                     "triangles", "log n", "64\u00d736 eye rays", "Abacus $9000$", "driver 1.2.3",
                     "Some CPU", "2026-01-31T23:59:59Z", "0123456789ab-modified",
                     "without a tree: ends before 1,000 triangles: it would take about 99 s"):
            self.assertIn(part, text)
        self.assertNotIn("HITS DIFFER", text)

    def test_hits_that_differ_are_told(self):
        doubtful = result()
        figure = doubtful["families"][0]["series"][2]["points"][1]["figures"][0]
        figure["differing_hits"] = 5
        self.run_plots(self.put("a.json", doubtful))
        self.assertIn("5 HITS DIFFER", self.texts("a-soup-growth.svg"))

    def test_series_without_a_point_are_drawn_as_nothing(self):
        early = result()
        early["complete"] = False
        for series in early["families"][0]["series"]:
            series["points"] = []
        code, said = self.run_plots(self.put("a.json", early))
        self.assertEqual(code, 0, said)
        self.assertIn("interrupted, not complete", self.texts("a-soup-growth.svg"))

    def test_two_devices_stand_side_by_side_even_if_one_goes_further(self):
        other = result()
        other["device"]["name"] = "Slide rule"
        del other["families"][0]["series"][0]["points"][2]
        code, said = self.run_plots(self.put("a.json", result()), self.put("b.json", other))
        self.assertEqual(code, 0, said)
        text = self.texts("a-soup-growth.svg")
        self.assertIn("Abacus", text)
        self.assertIn("Slide rule", text)

    def test_what_is_not_comparable_is_not_mixed(self):
        changes = {
            "another picture": lambda r: r["settings"]["picture"].update(width=65),
            "another kernel text": lambda r: r["kernel"].update(text_hash="fnv1a64:00"),
            "soup:1000: found another scene": lambda r: r["families"][0]["series"][2]["points"][
                1].update(scene_hash="fnv1a64:00"),
        }
        file = self.put("a.json", result())
        for word, change in changes.items():
            other = result()
            change(other)
            self.refused(["a.json", "b.json", word], file, self.put("b.json", other))
        self.refused(["b.json", "other families of meshes (terrain)"], file,
                     self.put("b.json", result("terrain")))

    def test_what_is_no_result_is_refused_with_its_place(self):
        newer = result()
        newer["version"] = 2
        self.refused(["found version 2 of facet-growth"], self.put("a.json", newer))
        wrong = result()
        wrong["families"][0]["series"][0]["points"][1]["figures"][2]["count"] = 0
        self.refused(["/families/0/series/0/points/1/figures/2/count: found 0"],
                     self.put("a.json", wrong))

    def test_another_format_beside_it_is_refused(self):
        sweep = {"format": "facet-sweep", "version": 1}
        self.refused(["b.json: found the format facet-sweep", "a.json has facet-growth"],
                     self.put("a.json", result()), self.put("b.json", sweep))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
