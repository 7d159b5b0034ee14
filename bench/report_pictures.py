"""The section of whole pictures by several ways: a table, and plots where a file holds several widths
or depths."""

from picture_growth_results import growths_of
from report_benches import spread_of
from report_page import number, table
from report_studies import plots


def _row(r):
    rays = [r["rays"][kind].get(int) for kind in ("eye", "bounced", "shadow")]
    kernel, wall = (r[key] for key in ("kernel_ms", "wall_ms"))
    return (r["scene"].get(str), f"{r['width'].get(int)}\N{MULTIPLICATION SIGN}"
            f"{r['height'].get(int)}", r["max_depth"].get(int), r["way"].get(str),
            spread_of(kernel["median"].get(float), [s.get(float) for s in kernel["all"].items()]),
            number(wall["median"].get(float)), " / ".join(number(n) for n in rays),
            number(r["mrays_per_s"].get(float)), number(r["compile_ms"].get(float)),
            number(r["pixels_that_differ"].get(int)))


def render(root, folder):
    blocks = [table("Whole pictures by several ways that took turns, median (least\N{EN DASH}most); "
                    "rays: eye / reflected and refracted / shadow",
                    ("scene", "pixels", "#depth", "way", "#kernel, ms",
                     "#until it is on the host, ms", "#rays", "#Mrays/s", "#compiling, ms",
                     "#pixels that differ from the first way's"),
                    [_row(r) for r in root["results"].items()])]
    return blocks + ([plots(root, folder)] if growths_of(root) else [])
