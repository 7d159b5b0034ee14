"""Results of `facet_bench growth` (facet-growth.schema.json), as figures and tables need them."""

from dataclasses import dataclass

from measurement import Estimate, Origin, median_of, origin_of
from results_file import Node, ResultError, read_file, short_commit

FORMAT, VERSION = "facet-growth", 1

TITLES = {"tree": "with the device's tree", "no-tree": "without a tree",
          "serial": "serial reference, one thread"}


@dataclass
class Point:
    mesh: str
    triangles: int
    scene_hash: str
    build_ms: Estimate
    device_bytes: int
    ray_ns: dict  # "eye", "shadow", "bounce" -> Estimate of nanoseconds a ray
    differing_hits: int | None  # none if it was not compared


@dataclass
class Series:
    way: str
    points: list
    ended: str  # where and why it ends; empty if it holds all that were asked for

    @property
    def title(self):
        return TITLES.get(self.way, self.way)

    def differing_hits(self):
        return sum(p.differing_hits or 0 for p in self.points)


@dataclass
class Result(Origin):
    picture: tuple  # width, height
    builds: int
    text_hash: str
    families: dict  # name -> list of Series

    def caption(self):
        """Where and when: for the foot of each figure."""
        return (f"{self.device}, driver {self.driver}; serial: {self.cpu}, one thread\n{self.date}, "
                f"Facet {short_commit(self.commit)}"
                + ("" if self.complete else "; interrupted, not complete")
                + f"\nmedians of {self.repeats} passes and of {self.builds} builds, and their "
                f"{100 * self.level:g}% bootstrap intervals")


def _nanoseconds(figure):
    """Of a ray."""
    of_all = median_of(figure["time"])
    count = figure["count"].get(int)
    if count < 1:
        figure["count"].fail(f"found {count}; allowed: at least 1")
    return Estimate(*(1e6 * ms / count for ms in (of_all.value, of_all.low, of_all.high)))


def _point(node):
    figures = node["figures"].items()
    triangles = node["triangles"].get(int)
    if triangles < 1:
        node["triangles"].fail(f"found {triangles}; allowed: at least 1")
    compared = [d.get(int) for f in figures if (d := f.find("differing_hits"))]
    return Point(
        mesh=node["mesh"].get(str),
        triangles=triangles,
        scene_hash=node["scene_hash"].get(str),
        build_ms=median_of(node["build"]),
        device_bytes=node["device_bytes"].get(int),
        ray_ns={f["rays"].get(str): _nanoseconds(f) for f in figures},
        differing_hits=sum(compared) if compared else None)


def _series(node):
    ended = node.find("ended")
    return Series(node["way"].get(str), [_point(p) for p in node["points"].items()],
                  f"ends before {ended['triangles'].get(int):,} triangles: {ended['reason'].get(str)}"
                  if ended else "")


def read_growth(path):
    """Raises ResultError for another format or version, or where something is missing."""
    root = Node(path, read_file(path, {FORMAT: VERSION}))
    settings = root["settings"]
    return Result(
        **origin_of(path, root),
        picture=tuple(settings["picture"][side].get(int) for side in ("width", "height")),
        builds=settings["builds"].get(int),
        text_hash=root["kernel"]["text_hash"].get(str),
        families={f["family"].get(str): [_series(s) for s in f["series"].items()]
                  for f in root["families"].items()})


# What two results must share to stand in one plot, and what it is called.
COMPARABLE = {
    "picture": "picture (width, height)",
    "text_hash": "kernel text",
}


def together(results):
    """The families of these results, to be drawn in one plot each. Raises ResultError, naming both
    files, if they are not of the same families, picture, kernel text and meshes; how far each goes
    may differ, for it depends on the device."""
    first = results[0]
    hashes = {}
    for other in results:
        if sorted(other.families) != sorted(first.families):
            raise ResultError(f"{other.path}: found other families of meshes "
                              f"({', '.join(other.families)}) than in {first.path} "
                              f"({', '.join(first.families)}); one plot holds results of the same "
                              "families: plot them one by one")
        for attribute, word in COMPARABLE.items():
            mine, found = getattr(first, attribute), getattr(other, attribute)
            if found != mine:
                raise ResultError(f"{other.path}: found another {word} ({found}) than in "
                                  f"{first.path} ({mine}); one plot holds results of one {word}: "
                                  "plot them one by one")
        for point in (p for family in other.families.values() for s in family for p in s.points):
            path, known = hashes.setdefault(point.mesh, (other.path, point.scene_hash))
            if known != point.scene_hash:
                raise ResultError(f"{other.path}: {point.mesh}: found another scene "
                                  f"({point.scene_hash}) than in {path} ({known}); one plot holds "
                                  "results of one scene: plot them one by one")
    return list(first.families)
