"""Sections of the hard cases and of facet_bench's rows: tables alone."""

from report_page import ends, note, number, table
from measurement import Estimate


def _failures(findings):
    """As `facet accuracy` counts them: a figure that is not met is one."""
    return sum(f["failed"].get(int) if f.find("failed") and f["failed"].get(int)
               else int(not f["met"].get(bool)) for f in findings if f["goal"].get(bool))


def _case(right, wrong):
    findings = right["findings"].items()
    checks = sum(f["tried"].get(int) if f.find("tried") else 1
                 for f in findings if f["goal"].get(bool))
    caught = ""
    if wrong:
        failed = _failures(wrong["findings"].items())
        caught = f"{wrong['mistake'].get(str)}: {failed:,}" + ("" if failed else " NOT CAUGHT")
    return (right["case"].get(int), right["name"].get(str), number(checks),
            number(_failures(findings)), "met" if right["met"].get(bool) else "NOT MET", caught)


def accuracy(root, _):
    runs = root["cases"].items() if root.find("cases") else []
    wrong = {r["case"].get(int): r for r in runs if r.find("mistake")}
    right = [r for r in runs if not r.find("mistake")]
    figures = [(r["case"].get(int), f["what"].get(str), number(f["measured"].get(float)),
                f["unit"].get(str) if f.find("unit") else "",
                f"{f['limit'].get(float):g}" if f.find("limit") else "")
               for r in right for f in r["findings"].items() if f.find("measured")]
    blocks = [table("Hard cases: what was checked against an exact oracle, and how often a mistake put "
                    "into the kernels was caught", ("#case", "what", "#checks", "#failures", "goal",
                                                    "failures with a mistake"),
                    [_case(r, wrong.get(r["case"].get(int))) for r in right])]
    if figures:
        blocks.append(table("Figures that the cases measured", ("#case", "what", "#measured", "unit",
                                                               "#at most"), figures))
    return blocks


def exactness(root, _):
    """What the strict kernel loses against the fastest inexact one, and each variant's rate."""
    groups = {}
    for r in root["results"].items():
        groups.setdefault((r["mesh"].get(str), r["rays"].get(str)), []).append(r)
    costs, rows = [], []
    for (mesh, rays), variants in groups.items():
        strict = _of_kind(variants, "strict")[0]
        rate_of = (lambda v: v["mrays_per_s"].get(float))
        chosen = strict["fastest_inexact"].get(str)
        fastest = [v for v in _of_kind(variants, "inexact") if v["variant"].get(str) == chosen]
        if not fastest:
            strict["fastest_inexact"].fail(f'found "{chosen}"; allowed: an inexact variant of its mesh '
                                           "and rays")
        low, high = strict["over_fastest_inexact_interval"].pair()
        over = strict["over_fastest_inexact"].get(float)
        costs.append((mesh, rays, number(rate_of(strict)), number(rate_of(fastest[0])), chosen,
                      f"{100 * (1 - over):.1f} [{100 * (1 - high):.1f}, {100 * (1 - low):.1f}]",
                      number(fastest[0]["other_hits"].get(int)),
                      number(fastest[0]["count"].get(int))))
        for v in variants:
            samples = [s.get(float) for s in v["mrays_per_s_all"].items()] or [rate_of(v)]
            rows.append((mesh, rays, v["variant"].get(str), v["kind"].get(str),
                         spread_of(rate_of(v), samples),
                         f"{100 * (rate_of(v) / rate_of(strict) - 1):+.1f}",
                         number(v["other_hits"].get(int))))
    return [table("What the strict kernel loses against the fastest of those that leave out all that "
                  "makes hits exact, compared within repeats, and for how many rays that one finds another hit",
                  ("mesh", "rays", "#strict, Mrays/s", "#fastest, Mrays/s", "the fastest", "#loss, %",
                   "#its other hits", "#of rays"), costs),
            table("Each variant: median (least\N{EN DASH}most), how much faster than the strict kernel "
                  "it is, and hits that are not the strict kernel's; \"one guard\" changes one of those "
                  "things alone", ("mesh", "rays", "variant", "kind", "#Mrays/s", "#faster, %",
                                   "#other hits"), rows)]


def _of_kind(variants, kind):
    some = [v for v in variants if v["kind"].get(str) == kind]
    if not some:
        variants[0].fail(f"no variant of its mesh and rays is of the kind {kind}")
    return some


def spread_of(value, samples):
    """A median, the least and the most."""
    return f"{number(value)} {ends(number(min(samples)), number(max(samples)))}"


def _rates(node, unit="mrays_per_s"):
    ends = [node[f"{unit}{end}"].get(float) for end in ("", "_least", "_most")]
    return spread_of(ends[0], ends[1:])


def _beside_peer(ours):
    def section(root, _):
        rows = []
        for r in root["results"].items():
            what = (r["mesh"].get(str), r["rays"].get(str), number(r["count"].get(int)), _rates(r[ours]))
            # Ways to ask the peer; files of before asked it in one, and that is in the row itself.
            ways = r["peers"].items() if r.find("peers") else [r] if r.find("embree") else []
            for way in ways:
                name = way["way"].get(str) if way.find("way") else "single"
                rows.append((*what, name, _rates(way["embree"]), _ratio(way["ratio"]),
                             number(way["hit_or_miss_differs"].get(int))))
            if not ways:
                rows.append((*what, *["\N{EN DASH}"] * 4))
        name = root["peer"]["name"].get(str) if root.find("peer") else "no peer"
        blocks = [table(f"Mrays/s, median (least\N{EN DASH}most); peer: {name}",
                        ("mesh", "rays", "#count", "#Facet, Mrays/s", "asked for", "#peer, Mrays/s",
                         "#ratio", "#hit in one, miss in the other"), rows)]
        builds = [(b["mesh"].get(str), number(b["triangles"].get(int)), *_build(b))
                  for b in root["builds"].items()]
        return blocks + [table("Building", ("mesh", "#triangles", "#build, ms", "#peer's, ms",
                                            "#depth"), builds)]
    return section


def _build(b):
    if b.find("build_ms"):
        return number(b["build_ms"].get(float)), "\N{EN DASH}", number(b["depth"].get(int))
    peer = b.find("embree_s")
    return (number(1e3 * b["reference_s"].get(float)),
            number(1e3 * peer.get(float)) if peer else "\N{EN DASH}", "\N{EN DASH}")


trace = _beside_peer("facet")
reference = _beside_peer("reference")


def _ratio(node):
    median, least, most = (f"{node[key].get(float):.2f}" for key in ("median", "least", "most"))
    return f"{median} {ends(least, most)}"


def build(root, _):
    rows = []
    for r in root["results"].items():
        rates, ratios = r["build"], r.find("ratios")
        against = [_ratio(ratios[peer]) if ratios and ratios.find(peer) else "\N{EN DASH}"
                   for peer in ("embree-low", "embree-medium")]
        seconds = _median(rates["seconds"])
        rows.append((r["mesh"].get(str), number(r["triangles"].get(int)), r["builder"].get(str),
                     number(1e3 * seconds.value), _rates(rates, "mtriangles_per_s"),
                     *against, *(number(r[key].get(float)) if r.find(key) else "\N{EN DASH}"
                                 for key in ("compile_ms", "depth")),
                     *_costs(r.find("quality"))))
    peer = root["peer"]["name"].get(str) if root.find("peer") else "no peer"
    blocks = [table(f"Building trees, median (least\N{EN DASH}most); peer: {peer}; compiling is not in "
                    "the time", ("mesh", "#triangles", "builder", "#ms", "#Mtriangles/s",
                                 "#ratio to low quality", "#to medium", "#compiling, ms", "#depth",
                                 "#SAH cost as traced", "#of the binary tree"), rows)]
    return blocks + [note(f"{r['mesh'].get(str)} was refused: {r['reason'].get(str)}")
                     for r in root["refused"].items()]


def _costs(quality):
    if quality is None:
        return ("\N{EN DASH}", "\N{EN DASH}")
    return tuple(f"{quality[key].get(float):.2f}" for key in ("sah_cost", "binary_sah_cost"))


def trees(root, _):
    meshes = root["scene"]["meshes"].items()
    rows = []
    for maker in root["builders"].items():
        for mesh, tree in zip(meshes, maker["meshes"].items()):
            overlap, binary = tree["end_point_overlap"], tree["binary"]
            rows.append((mesh["name"].get(str), number(mesh["triangles"].get(int)),
                         maker["builder"].get(str), maker["layout"].get(str),
                         f"{binary['sah_cost'].get(float):.2f}", _over(binary),
                         f"{tree['sah_cost'].get(float):.2f}", _over(tree),
                         f"{overlap['value'].get(float):.3f}"
                         + (f" \N{PLUS-MINUS SIGN} {overlap['standard_error'].get(float):.3f}"
                            if overlap["sampled"].get(bool) else ""),
                         tree["depth"].get(int), f"{tree['primitives_a_leaf'].get(float):.2f}",
                         f"{tree['bytes_a_primitive'].get(float):.0f}"))
    return [table(f"Trees of {root['scene']['name'].get(str)}: SAH cost of the binary tree and of the nodes as "
                  "traced, each also by that of the full sweep's tree, and end-point overlap",
                  ("mesh", "#triangles", "builder", "layout", "#binary cost", "#by the sweep's",
                   "#as traced", "#by the sweep's, as traced", "#overlap", "#depth",
                   "#triangles a leaf", "#bytes a triangle"), rows)]


def _over(node):
    ratio = node.find("sah_cost_over_sweep")
    return f"{ratio.get(float):.3f}" if ratio else "\N{EN DASH}"


def _off(node):
    off, unexplained = node["off"].get(int), node["unexplained"].get(int)
    return f"{off:,}" + (f", {unexplained:,} UNEXPLAINED" if unexplained else "")


def _median(node):
    samples = sorted(s.get(float) for s in node.items())
    if not samples:
        node.fail("holds no sample")
    middle = len(samples) // 2
    value = samples[middle] if len(samples) % 2 else (samples[middle - 1] + samples[middle]) / 2
    return Estimate(value, samples[0], samples[-1])


def pictures(root, _):
    rows = []
    for r in root["results"].items():
        device, serial = _median(r["device_s"]), _median(r["serial_s"])
        rows.append((r["scene"].get(str), f"{r['width'].get(int)}\N{MULTIPLICATION SIGN}"
                     f"{r['height'].get(int)}", number(r["triangles"].get(int)),
                     number(device.value), number(serial.value), _ratio(r["speed_up"]),
                     number(r["against_float"]["pixels"].get(int)), _off(r["against_float"]),
                     _off(r["against_double"])))
    return [table("Whole pictures: seconds, and how much faster than the serial float reference on one "
                  "thread; pixels that are off by more than 1/255",
                  ("scene", "pixels", "#triangles", "#device, s", "#serial, s", "#speed-up",
                   "#pixels in all", "#off, against float", "#off, against double"), rows),
            note("Pixels that are off are at edges, if nothing else is said: a ray moved by a little "
                 "meets other surfaces.")]


def sort(root, _):
    def peer(r, name):
        found = r.find(name)
        return (_rates(found, "mkeys_per_s"), _ratio(found["ratio"])) if found else ("\N{EN DASH}",) * 2

    rows = [(number(r["count"].get(int)), str(r["key_bits"].get(int)), str(r["bits"].get(int)),
             _rates(r["device"], "mkeys_per_s"), _rates(r["wall"], "mkeys_per_s"), *peer(r, "tbb"),
             *peer(r, "std")) for r in root["results"].items()]
    name = root["peer"]["name"].get(str) if root.find("peer") else "TBB, left out"
    return [table("Mkeys/s with 32-bit values, median (least\N{EN DASH}most), by the device's events and by the "
                  f"host's clock; how many times as fast it is by the host's clock as {name}, and as "
                  "std::sort", ("#keys", "#bits of a key", "#sorted by", "#device", "#host's clock", "#TBB",
                                "#ratio", "#std::sort", "#ratio to it"), rows)]


def fold(root, _):
    def time(step):
        return f"{number(step['median'].get(float))} {ends(step['least'].get(float), step['most'].get(float))}"

    steps = ("tree", "plan", "emit", "blocks")
    rows = [(r["mesh"].get(str), *(number(r[key].get(int)) for key in ("triangles", "nodes", "blocks", "depth")),
             *(time(r["ms"][step]) for step in steps), number(sum(r["ms"][step]["first"].get(float) for step in steps)))
            for r in root["results"].items()]
    return [table("From a binary tree to the wide layout: milliseconds by the host's clock, median "
                  "(least\N{EN DASH}most)",
                  ("mesh", "#triangles", "#nodes", "#blocks", "#depth", "#cutting", "#planning",
                   "#nodes written", "#blocks written", "#first run, in all"), rows)]


def move(root, _):
    def sides(*nodes):
        return [f"{number(n['median'].get(float))} {ends(*(number(n[e].get(float)) for e in ('least', 'most')))}"
                for n in nodes]

    def share(r, rays):
        return _ratio(r[rays]["ratio"]) if r.find(rays) else "\N{EN DASH}"

    waves = [(r["mesh"].get(str), number(r["triangles"].get(int)), f"{r['amplitude'].get(float):g}",
              *sides(r["move"]["ms"], r["anew"]["ms"], r["move"]["build_ms"], r["anew"]["build_ms"]),
              *(f"{r['sah_cost'][side].get(float):.2f}" for side in ("moved", "anew")),
              share(r, "primary"), share(r, "bounce")) for r in root["results"].items()]
    placed = [(number(r["instances"].get(int)), *sides(r["move"]["ms"], r["anew"]["ms"]),
               number(r["times_as_fast"].get(float))) for r in root["instances"].items()]
    return [table("Vertices that follow waves, against the scene made anew: milliseconds by the host's clock, median "
                  "(least\N{EN DASH}most); rates of the moved tree as shares of the new one's",
                  ("mesh", "#triangles", "#amplitude", "#moving", "#made anew", "#corners and boxes",
                   "#building", "#SAH cost, moved", "#anew", "#eye rays", "#bounce rays"), waves),
            table("Instances that move: milliseconds, likewise",
                  ("#instances", "#moving", "#made anew", "#times as fast"), placed)]
