#!/usr/bin/env python3
"""The report: what it holds, that it needs nothing else, and what is refused. Usage: report_test.py
[FACET FACET_BENCH]; with the programs, and a device, their own files are told of, too. Exit code 77
without matplotlib."""

import base64
import collections
import html.parser
import json
import os
import re
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from plots_helper import FilesTest  # noqa: E402
import growth_plots_test  # noqa: E402
import picture_growth_test  # noqa: E402
import report  # noqa: E402

PROGRAMS = [word for word in sys.argv[1:3] if word]
SOURCES = os.path.join(os.path.dirname(__file__), "..", "..")

PNG = base64.b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5E"
                       "rkJggg==")
EVIL = "<script>alert('1')</script>\" onload=\"x & y"


def origin(kind, **more):
    return {"format": kind, "version": 1, "date": "2026-01-31T23:59:59Z",
            "facet": {"version": "0.1.0", "commit": "0123456789abcdef0123456789abcdef01234567"},
            "device": {"name": "Abacus 9000", "platform": "Wood", "driver": "1.2.3"},
            "cpu": "Some CPU", "settings": {"repeats": 2}, **more}


def accuracy():
    findings = [{"what": "leaks", "goal": True, "met": True, "tried": 1000, "failed": 0},
                {"what": "worst", "goal": True, "met": True, "measured": 2.5, "limit": 8, "unit": "ulp"},
                {"what": "aside", "goal": False, "met": True, "tried": 77, "failed": 0}]
    wrong = [{**findings[0], "met": False, "failed": 41}, {**findings[1], "met": False}]
    return {"format": "facet-accuracy", "version": 1, "facet": "0.1.0", "device": "Abacus 9000",
            "platform": "Wood", "driver": "1.2.3", "rays": 1000, "seed": 7, "complete": True,
            "cases": [{"case": 2, "name": "closed mesh", "met": True, "findings": findings},
                      {"case": 2, "name": "closed mesh", "mistake": "open", "met": False,
                       "findings": wrong}]}


def exactness():
    rates = {"strict": ("strict", 90.0, 0), "bare": ("inexact", 100.0, 12),
             "bare, fast": ("inexact", 95.0, 13), "less the pad": ("one guard", 91.0, 1)}
    return origin("facet-bench-exactness", results=[
        {"mesh": "terrain:9", "rays": "primary", "count": 5000, "variant": name, "kind": kind,
         "mrays_per_s": rate, "mrays_per_s_all": [rate - 1, rate + 1], "other_hits": other,
         "fastest_inexact": "bare", "over_fastest_inexact": rate / 100,
         "over_fastest_inexact_interval": [rate / 100 - 0.02, rate / 100 + 0.01]}
        for name, (kind, rate, other) in rates.items()])


def variants():
    times = {"samples_ms": [2], "summary": {"median_ms": 2, "interval_ms": [1.9, 2.1]}}
    rmse = {"rmse": 0.0125}
    measured = {
        "name": "bare", "family": "arithmetic", "about": "nothing padded", "state": "measured",
        "hits_of": "bare", "hits": [
            {"rays": rays, "count": 1000, "kernel": times, "mrays_per_s": 0.5, "errors": {
                "wrong": 9, "errors": 3, "wrong_per_million": 9000, "errors_per_million": 3000}}
            for rays in ("eye", "bounce")],
        "picture": {"kernel": times, "mrays_per_s": 0.7, "mpixels_per_s": 0.25, "errors": {
            "linear": {"all": rmse, "without_silhouettes": {"rmse": 0}},
            "displayed": {"off": 17, "flip_mean": 0.003}}}}
    refused = {"name": "images", "family": "exact", "about": "in images", "state": "refused",
               "hits_of": "images", "reason": "has no images"}
    return origin("facet-variants", complete=True, variants=[measured, refused],
                  settings={"repeats": 2, "bootstrap": {"level": 0.95}},
                  scene={"name": "made up", "hash": "fnv1a64:00", "triangles": 1234},
                  picture={"width": 64, "height": 32, "max_depth": 2, "samples": 1})


def build():
    ratio = {"median": 0.5, "least": 0.4, "most": 0.6}
    return origin("facet-bench-build", peer=None, refused=[{"mesh": "soup:99", "reason": "too large"}], results=[
        {"mesh": "terrain:9", "triangles": 162, "builder": "levels", "layout": "wide", "compile_ms": 12.0,
         "depth": 7, "build": {"mtriangles_per_s": 0.08, "mtriangles_per_s_least": 0.07,
                               "mtriangles_per_s_most": 0.09, "seconds": [0.002, 0.001, 0.003]},
         "ratios": {"embree-low": ratio}, "quality": {"sah_cost": 20.5, "binary_sah_cost": 27.25}}])


def trees():
    tree = {"sah_cost": 22, "sah_cost_over_sweep": None, "depth": 6, "primitives_a_leaf": 5.19,
            "bytes_a_primitive": 108.1, "binary": {"sah_cost": 31, "sah_cost_over_sweep": 1.17},
            "end_point_overlap": {"value": 1.048, "standard_error": 0.02, "sampled": True}}
    return origin("facet-trees", scene={"name": "hills", "meshes": [{"name": "hill", "triangles": 162}]},
                  builders=[{"builder": "levels", "layout": "wide", "meshes": [tree]}])


class Page(html.parser.HTMLParser):
    """What a browser would see: elements, their text, and whether they close as they opened."""

    VOID = {"meta", "img", "br", "link", "input"}

    def __init__(self, content):
        super().__init__()
        self.elements, self.open, self.words, self.faults = [], [], [], []
        self.feed(content)
        self.close()
        self.faults += [f"{tag} stays open" for tag in self.open]

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"{tag} closes another")

    def handle_data(self, data):
        self.words.append(data)

    def text(self):
        return " ".join(self.words).replace("\N{WORD JOINER}", "")

    def all(self, tag):
        return [attributes for name, attributes in self.elements if name == tag]


class Report(FilesTest):
    def make(self, *arguments, out="report.html"):
        code, said = self.said_by(report.main, *arguments, "--out", self.path(out))
        self.assertEqual(code, 0, said)
        with open(self.path(out), encoding="utf-8") as file:
            return Page(file.read())

    def refused(self, parts, *files):
        before = self.put("report.html", "what was there")
        code, said = self.said_by(report.main, *files, "--out", before)
        self.assertEqual(code, 3, said)
        for part in parts:
            self.assertIn(part, said)
        with open(before, encoding="utf-8") as file:
            self.assertEqual(file.read(), "what was there")

    def test_it_needs_nothing_but_itself(self):
        page = self.make(self.put("g.json", growth_plots_test.result()), "--pictures",
                         self.put("p.png", PNG))
        tags = {tag for tag, _ in page.elements}
        self.assertFalse(tags & {"script", "link", "iframe", "object", "embed", "base", "svg"}, tags)
        for _, attributes in page.elements:
            for name in ("src", "href", "srcset", "action", "data", "poster", "background"):
                self.assertRegex(attributes.get(name, "#"), r"^(#|data:image/(png|svg\+xml);base64,)")
            self.assertFalse([name for name in attributes if name.startswith("on")])
        with open(self.path("report.html"), encoding="utf-8") as file:
            styles = re.findall(r"<style>(.*?)</style>", file.read(), re.S)
        self.assertFalse([s for s in styles if "url(" in s or "@import" in s])
        policy = [m["content"] for m in page.all("meta") if "http-equiv" in m]
        self.assertEqual(policy, ["default-src 'none'; img-src data:; style-src 'unsafe-inline'"])
        pictures = [base64.b64decode(i["src"].split(",")[1]) for i in page.all("img")]
        self.assertEqual(pictures[0], PNG)
        self.assertIn(b"time to build (ms)", pictures[1])

    def test_it_is_whole_and_can_be_read_without_seeing(self):
        page = self.make(self.put("e.json", exactness()), self.put("a.json", accuracy()),
                         self.put("g.json", growth_plots_test.result()))
        self.assertEqual(page.faults, [])
        self.assertEqual(page.all("html"), [{"lang": "en"}])
        self.assertTrue(all(len(i["alt"]) > 10 for i in page.all("img")))
        self.assertEqual(len(page.all("img")), 1)
        self.assertEqual(len(page.all("caption")), len(page.all("table")))
        self.assertTrue(all(h.get("scope") in ("col", "row") for h in page.all("th")))
        names = [a["id"] for _, a in page.elements if "id" in a]
        self.assertEqual(len(names), len(set(names)))
        self.assertEqual(sorted(a["href"] for a in page.all("a")), sorted("#" + n for n in names))
        self.assertEqual(names, ["origins", "growth", "hard-cases", "exactness"])

    def test_each_section_holds_the_figures_of_its_files(self):
        page = self.make(self.put("a.json", accuracy()), self.put("e.json", exactness()),
                         self.put("g.json", growth_plots_test.result()))
        text = page.text()
        for part in ("Abacus 9000", "Wood, 1.2.3", "2026-01-31T23:59:59Z", "not recorded",
                     "commit 0123456789ab", "rays: 1000; seed: 7",
                     "closed mesh 1,001 0 met open: 42", "worst 2.5 ulp 8",
                     "terrain:9 primary 90 100 bare 10.0 [9.0, 12.0] 12 5,000", "bare inexact 100 (99\N{EN DASH}101) +11.1 12",
                     "soup:10000 10,000 3,000 (2,700\N{EN DASH}3,600)",
                     "without a tree: ends before 1,000 triangles: it would take about 99 s."):
            self.assertIn(part, re.sub(r"\s+", " ", text))

    def test_builds_and_trees_have_their_figures_and_what_was_refused(self):
        text = re.sub(r"\s+", " ", self.make(self.put("b.json", build()),
                                             self.put("t.json", trees())).text())
        for part in ("terrain:9 162 levels 2 0.08 (0.07\N{EN DASH}0.09) 0.50 (0.40\N{EN DASH}0.60) \N{EN DASH} 12 7 "
                     "20.50 27.25", "soup:99 was refused: too large",
                     "hill 162 levels wide 31.00 1.170 22.00 \N{EN DASH} 1.048 \N{PLUS-MINUS SIGN} 0.020 6 5.19 108"):
            self.assertIn(part, text)

    def test_pictures_of_several_widths_have_a_plot_beside_their_table(self):
        page = self.make(self.put("r.json", picture_growth_test.result()))
        self.assertIn("knot.json 160\u00d780 5 default 33.3 (30\N{EN DASH}39.9) 66.6 "
                      "51,200 / 128,000 / 76,800 1.5 2 0", re.sub(r"\s+", " ", page.text()))
        self.assertEqual(len(page.all("img")), 1)
        self.assertIn("Plot r-knot-depth5-pixels: time of a picture and of each pixel",
                      page.all("img")[0]["alt"])
        one = picture_growth_test.result(picture_growth_test.measured(160, 5))
        page = self.make(self.put("r.json", one))
        self.assertEqual((len(page.all("img")), len(page.all("table"))), (0, 2))

    def test_variants_have_their_speed_and_errors_or_why_they_have_none(self):
        text = re.sub(r"\s+", " ", self.make(self.put("v.json", variants())).text())
        for part in ("made up, 1,234 triangles: hits",
                     "bare measured 0.5 9,000 3,000 0.5 9,000 3,000", "images refused",
                     "bare 0.25 0.0125 0 17 0.003 nothing padded", "in images; refused: has no images"):
            self.assertIn(part, text)

    def test_what_comes_from_a_file_is_text(self):
        evil = exactness()
        evil["device"]["name"] = evil["results"][0]["variant"] = EVIL
        evil["cpu"] = "a\u0000b\ud800c"
        evil["settings"] = {EVIL: [EVIL]}
        grown = growth_plots_test.result()
        grown["device"]["name"] = "$\\frac{" + EVIL
        page = self.make(self.put("<b>&.json", evil), self.put("g.json", grown), "--title", EVIL)
        self.assertEqual(page.faults, [])
        self.assertEqual(page.all("script") + page.all("b"), [])
        self.assertFalse([a for _, a in page.elements if "onload" in a])
        text = page.text()
        self.assertGreaterEqual(text.count("<script>alert('1')</script>"), 4)
        self.assertIn("<b>&", text)
        self.assertIn("a\ufffdb", text)

    def test_the_same_files_give_the_same_bytes(self):
        file = self.put("g.json", growth_plots_test.result())
        self.make(file)
        self.make(file, out="again.html")
        with open(self.path("report.html"), "rb") as one, open(self.path("again.html"), "rb") as two:
            self.assertEqual(one.read(), two.read())
        self.assertEqual(self.names(), ["again.html", "g.json", "report.html"])

    def test_a_file_that_is_not_known_is_named(self):
        known = self.put("a.json", accuracy())
        self.refused(["b.json", "found the format null", "measured again", '"facet-sweep"'], known,
                     self.put("b.json", {"row": "exactness", "results": []}))
        self.refused(['found the format "npy"'], self.put("b.json", {"format": "npy"}))
        self.refused(["found version 2 of facet-accuracy"],
                     self.put("b.json", {**accuracy(), "version": 2}))
        self.refused(["none.json: cannot be read"], known, self.path("none.json"))
        self.refused(["line 1, column 2"], self.put("b.json", "{"))

    def test_what_a_file_lacks_is_named_with_its_place(self):
        lacking = accuracy()
        del lacking["cases"][0]["findings"][1]["met"]
        self.refused(['/cases/0/findings/1: lacks "met"'], self.put("a.json", lacking))
        wrong = exactness()
        wrong["results"][2]["mrays_per_s"] = "fast"
        self.refused(["/results/2/mrays_per_s", '"fast"'], self.put("e.json", wrong))
        bare = exactness()
        bare["results"] = bare["results"][1:]
        self.refused(["is of the kind strict"], self.put("e.json", bare))

    def test_a_picture_that_is_none_is_named(self):
        file = self.put("a.json", accuracy())
        self.refused(["p.png: is no picture", "PNG, SVG"], file, "--pictures",
                     self.put("p.png", b"GIF89a"))
        self.refused(["none.png: cannot be read"], file, "--pictures", self.path("none.png"))

    def test_an_output_that_cannot_be_is_told_of_and_no_input_is_lost(self):
        file = self.put("a.json", accuracy())
        code, said = self.said_by(report.main, file, "--out", self.path("none/report.html"))
        self.assertEqual(code, 6)
        self.assertIn("none/report.html: cannot be written", said)
        with self.assertRaises(SystemExit) as stopped:
            self.said_by(report.main, file, "--out", file)
        self.assertEqual(stopped.exception.code, 2)
        self.assertEqual(self.names(), ["a.json"])

    @unittest.skipUnless(len(PROGRAMS) == 2 and subprocess.run(
        [PROGRAMS[0], "devices"], capture_output=True).returncode == 0, "no programs or no device")
    def test_what_the_programs_write_is_told_of(self):
        facet, bench = PROGRAMS
        knot = os.path.join(SOURCES, "scenes", "knot.json")
        commands = {
            "sweep": [facet, "sweep", "icosphere:1", "--shapes", "1x1,2x2",
                      "--width", "16", "--repeats", "2", "--experiments", "tree", "-q"],
            "accuracy": [facet, "accuracy", "--cases", "5", "--rays", "1e3", "--mistakes", "-q"],
            "trace": [bench, "trace", "--mesh", "terrain:2", "--repeat", "1"],
            "build": [bench, "build", "--mesh", "terrain:2", "--repeat", "2", "--quality"],
            "trees": [facet, "info", "terrain:3", "--tree", "levels,sweep", "--samples", "9", "-q"],
            "reference": [bench, "reference", "--terrain", "2", "--soup", "0", "--repeat", "1"],
            "pictures": [bench, "pictures", knot, "--width", "32", "--repeat", "1"],
            "sort": [bench, "sort", "--count", "100", "--repeat", "2"],
            "fold": [bench, "fold", "--mesh", "terrain:1", "terrain:20", "--repeat", "2"],
            "move": [bench, "move", "--mesh", "soup:40", "--instances", "3", "--repeat", "2"],
            "growth": [bench, "growth", "--triangles", "10", "20", "--width", "64", "--repeat", "2"],
            "render": [bench, "render", knot, "--width", "32", "64", "--depth", "0", "2", "--way", "default",
                       "--repeat", "2"],
        }
        files = []
        for name, command in commands.items():
            files.append(self.path(f"{name}.json"))
            subprocess.run([*command, "--json", files[-1]], check=True, capture_output=True)
        page = self.make(*files)
        self.assertEqual(page.faults, [])
        self.assertEqual(len(page.all("section")), 1 + len(commands))
        self.assertEqual(len(page.all("img")), 2 + 2 + 4)  # of sweep, growth and render
        with open(files[0], encoding="utf-8") as file:
            device = json.load(file)["device"]["name"]
        count = collections.Counter(re.findall(re.escape(device), page.text()))
        self.assertGreaterEqual(count[device], 2 * (len(commands) - 1))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
