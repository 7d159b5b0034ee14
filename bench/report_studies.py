"""Sections of the studies: work-groups, variants, growth."""

from growth_results import read_growth
from report_page import gallery, image, note, number, spread, stem, table
from result_kinds import KINDS
from sweep_results import TITLES, read_sweep

TIMES = "\N{MULTIPLICATION SIGN}"

# The end of a plot's name, and what it shows: in place of the picture for those who do not see it.
PLOTS = {
    "blocks": "kernel time, and speed-up over the serial reference, against the work-items of a group",
    "shapes": "kernel time of each work-group, by its width and height",
    "hits": "speed of tracing rays against wrong hits, for each variant",
    "linear": "speed of pictures against the error of linear values, for each variant",
    "displayed": "speed of pictures against the visible difference, for each variant",
    "growth": "time of a ray and time to build against triangles, on logarithmic axes",
    "pixels": "time of a picture and of each pixel against pixels, on logarithmic axes",
    "depth": "time of a picture, its rays by kind and the time of each ray against bounces",
}


def plots(root, folder):
    """The plots of one file, if its kind has any."""
    kind = KINDS.get(root["format"].get(str))
    if kind is None:
        return ""
    figures = []
    for path in kind.draw([kind.read(root.path)], folder, stem(root.path)):
        if path.endswith(".svg"):
            name = stem(path)
            shows = PLOTS.get(name.rsplit("-", 1)[-1], "the figures of the tables")
            figures.append(image(path, f"Plot {name}: {shows}. The tables of this section hold "
                                       "figures.", name))
    return gallery(figures)


def _times(shape):
    return shape.replace("x", TIMES)


def _winners(experiment):
    return sorted((s for s in experiment.shapes if s.is_best and s.kernel_ms),
                  key=lambda s: s.kernel_ms.value)


def _row_of_times(experiment):
    by_name = {s.name: s for s in experiment.shapes}
    best = _winners(experiment)
    fastest, one, driver = best[0] if best else None, by_name.get("1x1"), by_name.get("driver")
    of = (lambda s, what: getattr(s, what) if s else None)
    return (TITLES.get(experiment.name, experiment.name), _times(fastest.name) if fastest else "",
            spread(of(fastest, "kernel_ms")), spread(of(one, "kernel_ms")),
            spread(of(driver, "kernel_ms")), spread(experiment.serial_ms),
            spread(of(fastest, "speed_up")), spread(of(one, "speed_up")))


def _row_of_winners(experiment):
    best, doubts = _winners(experiment), []
    for standing, words in (("different", "ANOTHER PICTURE"), ("refused", "refused by the device"),
                            ("unfinished", "interrupted")):
        names = [_times(s.name) for s in experiment.shapes if s.standing == standing]
        if names:
            doubts.append(f"{len(names)} {words}: {', '.join(names)}")
    return (TITLES.get(experiment.name, experiment.name),
            f"{experiment.scene}, {experiment.triangles:,} triangles, "
            f"{experiment.picture[0]}{TIMES}{experiment.picture[1]} pixels",
            f"{len(best)} of {sum(1 for s in experiment.shapes if s.kernel_ms)}",
            ", ".join(_times(s.name) for s in best), "; ".join(doubts))


def sweep(root, folder):
    result = read_sweep(root.path)
    experiments = result.experiments.values()
    return [table(f"Kernel times, medians of {result.repeats} with their {100 * result.level:g}% "
                  "intervals; a speed-up is the serial reference's time over the kernel's",
                  ("experiment", "fastest", "#its time, ms", f"#1{TIMES}1, ms",
                   "#the driver's choice, ms", "#serial, ms", "#speed-up of the fastest",
                   f"#speed-up at 1{TIMES}1"), [_row_of_times(e) for e in experiments]),
            table("Winners: all shapes whose intervals overlap that of the fastest, which comes first",
                  ("experiment", "scene", "#how many", "~winners", "not counted"),
                  [_row_of_winners(e) for e in experiments]),
            plots(root, folder)]


# way, rays: the columns of growth.
RATES = (("tree", "eye"), ("tree", "shadow"), ("tree", "bounce"), ("no-tree", "eye"),
         ("serial", "eye"))


def _row_of_growth(mesh, points):
    """points: those of that mesh, by way."""
    some = next(iter(points.values()))
    compared = [p.differing_hits for p in points.values() if p.differing_hits is not None]
    tree, serial = points.get("tree"), points.get("serial")
    return (mesh, number(some.triangles),
            *(spread(points[way].ray_ns.get(rays) if way in points else None) for way, rays in RATES),
            spread(tree.build_ms if tree else None), number(serial.build_ms.value if serial else None),
            number(tree.device_bytes / 2**20 if tree else None),
            number(sum(compared) if compared else None))


def growth(root, folder):
    result = read_growth(root.path)
    blocks = []
    for name, all_series in result.families.items():
        by_mesh = {}
        for s in all_series:
            for p in s.points:
                by_mesh.setdefault(p.mesh, {})[s.way] = p
        rows = sorted(by_mesh.items(), key=lambda item: next(iter(item[1].values())).triangles)
        blocks.append(table(
            f"Growth of {name}: nanoseconds a ray, with the device's tree, without, and by the serial "
            f"reference on one thread; medians with their {100 * result.level:g}% intervals",
            ("mesh", "#triangles", "#tree: eye ray, ns", "#shadow ray, ns", "#bounce ray, ns",
             "#no tree: eye ray, ns", "#serial: eye ray, ns", "#build, ms", "#serial's, ms",
             "#on the device, MiB", "#hits that differ"),
            [_row_of_growth(mesh, points) for mesh, points in rows]))
        blocks += [note(f"{s.title}: {s.ended}.") for s in all_series if s.ended]
    return [*blocks, plots(root, folder)]


def _number(node, key, kind=float):
    found = node.find(key)
    return number(found.get(kind) if found else None)


def _row_of_hits(node):
    cells = []
    for one in node["hits"].items() if node.find("hits") else []:
        errors = one["errors"]
        cells += [_number(one, "mrays_per_s"), _number(errors, "wrong_per_million"),
                  _number(errors, "errors_per_million")]
    return (node["name"].get(str), node["state"].get(str), *(cells or [""] * 6))


def _row_of_picture(node):
    about = node["about"].get(str)
    picture = node.find("picture")
    if picture is None:
        reason = node.find("reason")
        return (node["name"].get(str), *[""] * 5,
                f"{about}; {node['state'].get(str)}: {reason.get(str)}" if reason else about)
    linear, displayed = picture["errors"]["linear"], picture["errors"]["displayed"]
    return (node["name"].get(str), _number(picture, "mpixels_per_s"), _number(linear["all"], "rmse"),
            _number(linear["without_silhouettes"], "rmse"), _number(displayed, "off", int),
            _number(displayed, "flip_mean"), about)


def variants(root, folder):
    """As facet-variants.schema.json has them."""
    scene, rows = root["scene"], root["variants"].items()
    what = f"{scene['name'].get(str)}, {scene['triangles'].get(int):,} triangles"
    kinds = ("wrong hits per million", "but for ties and silhouettes")
    return [table(f"{what}: hits, against those of the double reference",
                  ("variant", "state", "#eye rays, Mrays/s", *(f"#{k}" for k in kinds),
                   "#bounce rays, Mrays/s", *(f"#{k}" for k in kinds)),
                  [_row_of_hits(v) for v in rows]),
            table(f"{what}: pictures, against that of the double reference",
                  ("variant", "#Mpixels/s", "#linear RMSE", "#RMSE without silhouettes",
                   "#pixels off, displayed", "#mean FLIP", "~what it is"),
                  [_row_of_picture(v) for v in rows]),
            plots(root, folder)]
