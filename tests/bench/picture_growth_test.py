#!/usr/bin/env python3
"""Plots of how whole pictures' time grows with pixels and with depth: what is drawn, and what is
refused. Exit code 77 without matplotlib."""

import sys
import unittest

sys.dont_write_bytecode = True
from plots_helper import PlotsTest  # noqa: E402
import picture_growth_figures as figures  # noqa: E402
import picture_growth_results as results  # noqa: E402

WIDTHS, DEPTHS = (160, 320, 640), (0, 1, 4)


def spread(ms):
    return {"median": ms, "least": 0.9 * ms, "most": 1.2 * ms, "all": [ms, 0.9 * ms, 1.2 * ms]}


def measured(width, depth, way="default", scene="knot.json", ms=None):
    """1 ms for every 1000 pixels, and 0.1 ms for a thousand rays that are no eye rays."""
    height = width // 2
    pixels = width * height
    rays = {"eye": 4 * pixels, "bounced": 2 * depth * pixels, "shadow": (depth + 1) * pixels}
    kernel = pixels * (1 + 0.1 * (3 * depth + 1)) / 1000 if ms is None else ms
    return {"scene": scene, "way": way, "width": width, "height": height, "samples": 2, "tiles": 1,
            "max_depth": depth, "triangles": 1234, "rays": rays, "mrays_per_s": 1.5, "compile_ms": 2,
            "kernel_ms": spread(kernel), "wall_ms": spread(2 * kernel), "pixels_that_differ": 0}


def result(*rows):
    rows = rows or [measured(w, 5, way) for w in WIDTHS for way in ("default", "single")]
    return {
        "format": "facet-bench-render", "version": 1, "date": "2026-01-31T23:59:59Z",
        "facet": {"version": "0.1.0", "commit": "0123456789abcdef0123456789abcdef01234567-modified"},
        "device": {"name": "Abacus $9000$", "platform": "Wood", "driver": "1.2.3"}, "cpu": "Some CPU",
        "settings": {"repeats": 3}, "results": list(rows)}


def of_depths():
    return result(*(measured(640, d, way) for d in reversed(DEPTHS)
                    for way in ("default", "single")))


def drawn(panel, number):
    """The points of a panel's line."""
    line = panel.containers[number].lines[0]
    return list(line.get_xdata()), list(line.get_ydata())


class PictureGrowthPlots(PlotsTest):
    def test_figures_are_those_that_the_file_can_fill(self):
        both = [measured(w, d, scene=scene) for scene in ("knot.json", "still life: a b.obj")
                for w in WIDTHS[:2] for d in DEPTHS[:2]]
        for name, file, names in (
                ("w", result(), ["knot-depth5-pixels"]),
                ("d", of_depths(), ["knot-640x320-depth"]),
                ("both", result(*both), [f"{scene}-{end}" for scene in ("knot", "still-life-a-b")
                                         for end in ("depth0-pixels", "depth1-pixels", "160x80-depth",
                                                     "320x160-depth")])):
            code, said = self.run_plots(self.put(f"{name}.json", file), out=name)
            self.assertEqual(code, 0, said)
            self.assertEqual(self.names(name), sorted(
                f"{name}-{figure}.{end}" for figure in names for end in ("png", "svg")))

    def test_scenes_of_one_stem_do_not_overwrite_each_other(self):
        self.run_plots(self.put("a.json", result(*(measured(w, 5, scene=scene) for w in WIDTHS
                                                   for scene in ("knot.json", "knot.obj")))))
        self.assertIn("knot.json", self.texts("a-knot-depth5-pixels.svg"))
        self.assertIn("knot.obj", self.texts("a-2-knot-depth5-pixels.svg"))

    def test_time_a_pixel_and_the_exponent_are_those_of_the_times(self):
        self.put("a.json", result())
        read = results.read_picture_growth(self.path("a.json"))
        time, each = figures.picture_growth([read], read.growths).axes
        pixels = [w * w // 2 for w in WIDTHS]
        places, values = drawn(time, 0)
        self.assertEqual(places, pixels)
        for value, count in zip(values, pixels):
            self.assertAlmostEqual(value, count * 2.6e-3)
        self.assertEqual(drawn(each, 1)[0], pixels)
        for value in drawn(each, 1)[1]:
            self.assertAlmostEqual(value, 2600)
        self.assertIn("default: exponent 1.000 \u00b1 0.000, at the end 1.000",
                      [text.get_text() for text in time.get_legend().get_texts()])

    def test_an_exponent_has_an_error_where_points_leave_the_line(self):
        def of(*times):
            file = result(*(measured(w, 5, ms=ms) for w, ms in zip(WIDTHS, times)))
            return results.exponent_of(
                results.read_picture_growth(self.put("a.json", file)).growths[0].shapes())

        slope, error = of(1, 2, 4)  # four times the pixels take twice the time
        self.assertAlmostEqual(slope, 0.5)
        self.assertAlmostEqual(error, 0)
        slope, error = of(1, 4, 8)
        self.assertAlmostEqual(slope, 0.75)
        self.assertAlmostEqual(error, 0.25 / 3 ** 0.5)
        self.assertEqual(of(1, 4)[1], None)

    def test_depth_has_rays_by_kind_and_time_a_ray(self):
        self.put("a.json", of_depths())
        read = results.read_picture_growth(self.path("a.json"))
        time, rays, each = figures.picture_growth([read], read.growths).axes
        self.assertEqual(drawn(time, 0)[0], list(DEPTHS))
        self.assertEqual([list(line.get_ydata()) for line in rays.lines],
                         [[0.2048 * k for k in kinds] for kinds in ((4, 4, 4), (0, 2, 8), (1, 2, 5))])
        for value, depth in zip(drawn(each, 0)[1], DEPTHS):
            self.assertAlmostEqual(value, 1000 * (1.1 + 0.3 * depth) / (5 + 3 * depth))

    def test_lines_have_least_and_most(self):
        self.put("a.json", of_depths())
        read = results.read_picture_growth(self.path("a.json"))
        bars = figures.picture_growth([read], read.growths).axes[0].containers[0].lines[2][0]
        (_, low), (_, high) = bars.get_segments()[0]
        self.assertAlmostEqual(low, 0.9 * 204.8 * 1.1)
        self.assertAlmostEqual(high, 1.2 * 204.8 * 1.1)

    def test_axes_have_units_and_the_plot_says_what_was_measured_and_when(self):
        large = result()
        large["results"][4]["tiles"] = 4
        self.run_plots(self.put("a.json", large), self.put("b.json", result()))
        text = self.texts("a-knot-depth5-pixels.svg")
        for part in ("kernel time of a picture (ms)", "kernel time of a pixel (ns)", "pixels",
                     "proportional to pixels", "default, until the picture is on the host", "single",
                     "knot.json", "depth 5, 4 eye rays a pixel, 1,234 triangles", "Abacus $9000$",
                     "driver 1.2.3", "2026-01-31T23:59:59Z", "0123456789ab-modified",
                     "medians of 3 pictures", "default: in several tiles, one after the other: "
                     "640\u00d7320 in 4"):
            self.assertIn(part, text)
        self.assertEqual(text.count("several tiles"), 1)
        self.run_plots(self.put("a.json", of_depths()))
        text = self.texts("a-knot-640x320-depth.svg")
        for part in ("depth (bounces)", "rays of a picture (million)", "kernel time of a ray (ns)",
                     "reflected and refracted rays", "640\u00d7320 pixels"):
            self.assertIn(part, text)

    def test_a_file_with_one_width_and_one_depth_is_refused(self):
        self.refused(["a.json: /results: found no scene that was measured at two or more widths",
                      "--width", "--depth"],
                     self.put("a.json", result(measured(160, 5), measured(160, 5, "single"),
                                               measured(320, 2, scene="room.json"))))
        self.refused(["a.json: /results: found no scene"],
                     self.put("a.json", result(measured(160, 5), measured(320, 2))))

    def test_two_times_at_one_place_are_refused(self):
        rows = result()["results"]
        self.refused(["a.json: /results: knot.json by the way single is there twice"],
                     self.put("a.json", result(*rows, rows[3])))

    def test_what_a_file_lacks_or_cannot_hold_is_refused_with_its_place(self):
        for change, part in (
                (lambda r: r.pop("rays"), '/results/3: lacks "rays"'),
                (lambda r: r["rays"].update(shadow=-1), "/results/3/rays/shadow: found -1"),
                (lambda r: r.update(max_depth=1.5), "/results/3/max_depth: found 1.5"),
                (lambda r: r.update(width=0), "/results/3/width: found 0; allowed: at least 1"),
                (lambda r: r["kernel_ms"].update(least=0),
                 "/results/3/kernel_ms: found a median of"),
                (lambda r: r["wall_ms"].update(most=0.1), "/results/3/wall_ms: found a median of")):
            wrong = result()
            change(wrong["results"][3])
            self.refused(["a.json: " + part], self.put("a.json", wrong))
        newer = result()
        newer["version"] = 2
        self.refused(["found version 2 of facet-bench-render"], self.put("a.json", newer))

    def test_two_devices_stand_side_by_side_even_if_one_is_far_faster(self):
        for of, scales in ((result, ("log", "log")), (of_depths, ("linear",) * 3)):
            other = of()
            other["device"]["name"] = "Slide rule"
            for row in other["results"]:
                for time in ("kernel_ms", "wall_ms"):
                    row[time] = spread(row[time]["median"] / 100)
            read = [results.read_picture_growth(self.put(name, file))
                    for name, file in (("a.json", of()), ("b.json", other))]
            figure = figures.picture_growth(read, [r.growths[0] for r in read])
            self.assertEqual([axes.get_yscale() for axes in figure.axes],
                             [scale for scale in scales for _ in read])
            for axes in figure.axes:  # nothing is cut off, and on linear axes nothing is flat
                low, high = axes.get_ylim()
                values = [y for line in axes.lines for y in line.get_ydata()]
                self.assertTrue(low <= min(values) and max(values) < high)
                if axes.get_yscale() == "linear":
                    self.assertLess(high, 2 * max(values))
            self.assertIn("Slide rule", figure.axes[1].get_title())

    def test_what_is_not_comparable_is_not_mixed(self):
        file = self.put("a.json", result())
        self.refused(["b.json: found other figures (knot.json along depth at 640x320) than in", "a.json",
                      "(knot.json along pixels at 5)"], file, self.put("b.json", of_depths()))
        other = result()
        other["results"][2]["rays"]["shadow"] += 1
        self.refused(["b.json: knot.json, 320x160 pixels at depth 5: found another picture", "a.json"],
                     file, self.put("b.json", other))

    def test_another_format_beside_it_is_refused(self):
        self.refused(["b.json: found the format facet-growth", "a.json has facet-bench-render"],
                     self.put("a.json", result()),
                     self.put("b.json", {"format": "facet-growth", "version": 1}))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
