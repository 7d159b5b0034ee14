"""Results of `facet_bench render` with several widths or depths: how the time of whole pictures grows
with pixels at one depth, and with depth at one size."""

import math
from dataclasses import dataclass

from measurement import Estimate
from results_file import Node, ResultError, read_file, short_commit

FORMAT, VERSION = "facet-bench-render", 1

KINDS = ("eye", "bounced", "shadow")


@dataclass
class Point:
    width: int
    height: int
    depth: int  # bounces
    samples: int  # a pixel has samples x samples eye rays
    triangles: int
    tiles: int | None  # none in files that do not say it
    rays: dict  # one of KINDS -> how many the picture takes
    kernel_ms: Estimate
    wall_ms: Estimate  # until the picture is on the host

    @property
    def pixels(self):
        return self.width * self.height

    def all_rays(self):
        return sum(self.rays.values())


@dataclass
class Growth:
    """What is drawn in one figure: the points of each way, from few pixels or bounces to many."""

    scene: str
    along: str  # "pixels" or "depth"
    fixed: tuple  # what all points share: (depth,) along pixels, (width, height) along depth
    ways: dict  # name -> list of Point

    @property
    def key(self):
        return self.scene, self.along, self.fixed

    def shapes(self):
        """The points of the way that was measured first: rays are the same for every way."""
        return next(iter(self.ways.values()))


@dataclass
class Result:
    path: str
    device: str
    driver: str
    date: str
    commit: str
    repeats: int
    growths: list

    def caption(self):
        """Where and when: for the foot of each figure."""
        return (f"{self.device}, driver {self.driver}\n{self.date}, Facet {short_commit(self.commit)}\n"
                f"medians of {self.repeats} pictures, bars from the least to the most")


def _spread(node):
    """The median, the least and the most of the samples."""
    ends = [node[key].get(float) for key in ("median", "least", "most")]
    if not 0 < ends[1] <= ends[0] <= ends[2]:
        node.fail(f"found a median of {ends[0]:g} from {ends[1]:g} to {ends[2]:g}; allowed: times above 0, "
                  "the median between the least and the most")
    return Estimate(*ends)


def _count(node, least):
    value = node.get(int)
    if value < least:
        node.fail(f"found {value}; allowed: at least {least}")
    return value


def _point(node):
    tiles = node.find("tiles")
    return Point(
        **{key: _count(node[key], 1) for key in ("width", "height", "samples")},
        depth=_count(node["max_depth"], 0),
        triangles=node["triangles"].get(int),
        tiles=_count(tiles, 1) if tiles else None,
        rays={kind: _count(node["rays"][kind], 1 if kind == "eye" else 0) for kind in KINDS},
        kernel_ms=_spread(node["kernel_ms"]),
        wall_ms=_spread(node["wall_ms"]))


def _measurements(root):
    """scene -> way -> points."""
    scenes = {}
    for node in root["results"].items():
        ways = scenes.setdefault(node["scene"].get(str), {})
        ways.setdefault(node["way"].get(str), []).append(_point(node))
    return scenes


# along: (what points of one figure share, what they are ordered by)
AXES = {
    "pixels": (lambda p: (p.depth,), lambda p: p.pixels),
    "depth": (lambda p: (p.width, p.height), lambda p: p.depth),
}


def growths_of(root):
    """Every figure that the file can fill: none if it has one width and one depth of each scene.
    Raises ResultError if a figure would have two points at one place."""
    found = []
    for scene, ways in _measurements(root).items():
        for along, (fixed_of, place_of) in AXES.items():
            for fixed in sorted({fixed_of(p) for points in ways.values() for p in points}):
                lines = {}
                for way, points in ways.items():
                    some = sorted((p for p in points if fixed_of(p) == fixed), key=place_of)
                    places = {place_of(p) for p in some}
                    if len(places) > 1:
                        if len(places) < len(some):
                            root["results"].fail(
                                f"{scene} by the way {way} is there twice at one width and depth; "
                                "allowed: once, for a line needs one time at each place. Measure scenes "
                                "of one name into a file each")
                        lines[way] = some
                if lines:
                    found.append(Growth(scene, along, fixed, lines))
    return found


def read_picture_growth(path):
    """Raises ResultError for another format or version, where something is missing, and for a file
    that holds no scene at two widths or depths."""
    root = Node(path, read_file(path, {FORMAT: VERSION}))
    growths = growths_of(root)
    if not growths:
        root["results"].fail("found no scene that was measured at two or more widths of one depth, or "
                             "depths of one width; measure several with `facet_bench render --width` "
                             "or `--depth`")
    device = root["device"]
    return Result(
        path=path,
        device=device["name"].get(str),
        driver=device["driver"].get(str),
        date=root["date"].get(str),
        commit=root["facet"]["commit"].get(str),
        repeats=_count(root["settings"]["repeats"], 1),
        growths=growths)


def together(results):
    """Figures of these results: for each the Growth of each result. Raises ResultError, naming both
    files, if they do not fill the same figures, or if their pictures are not the same: of one size
    and depth, they then have other triangles, samples or rays."""
    first = results[0]
    of_first = {g.key: g for g in first.growths}
    for other in results[1:]:
        growths = {g.key: g for g in other.growths}
        if growths.keys() != of_first.keys():
            raise ResultError(f"{other.path}: found other figures ({_names(growths)}) than in "
                              f"{first.path} ({_names(of_first)}); one plot holds results of the same "
                              "scenes, widths and depths: plot them one by one")
        for key, growth in growths.items():
            shapes = {(p.width, p.height, p.depth): p for p in of_first[key].shapes()}
            for p in growth.shapes():
                known = shapes.get((p.width, p.height, p.depth))
                if known and _content(p) != _content(known):
                    raise ResultError(
                        f"{other.path}: {growth.scene}, {p.width}x{p.height} pixels at depth {p.depth}: "
                        f"found another picture ({_content(p)}) than in {first.path} "
                        f"({_content(known)}); one plot holds results of one scene: plot them one by one")
    return [[next(g for g in r.growths if g.key == key) for r in results] for key in of_first]


def _names(growths):
    return ", ".join(f"{scene} along {along} at {'x'.join(map(str, fixed))}"
                     for scene, along, fixed in sorted(growths))


def _content(p):
    return (f"{p.triangles:,} triangles, {p.samples} samples, rays "
            + "/".join(f"{p.rays[kind]:,}" for kind in KINDS))


def exponent_of(points):
    """Of a power of pixels that the kernel's time follows, by least squares on logarithms, and its
    standard error, which two points do not have: None."""
    xs = [math.log(p.pixels) for p in points]
    ys = [math.log(p.kernel_ms.value) for p in points]
    count, x, y = len(xs), sum(xs) / len(xs), sum(ys) / len(ys)
    square = sum((a - x) ** 2 for a in xs)
    slope = sum((a - x) * (b - y) for a, b in zip(xs, ys)) / square
    if count < 3:
        return slope, None
    rest = sum((b - y - slope * (a - x)) ** 2 for a, b in zip(xs, ys))
    return slope, math.sqrt(rest / (count - 2) / square)
