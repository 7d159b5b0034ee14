"""Results of `facet sweep` (facet-sweep.schema.json), as the figures need them."""

from dataclasses import dataclass, field

from measurement import Estimate, Origin, median_if_any, origin_of
from results_file import Node, ResultError, read_file, short_commit

FORMAT, VERSION = "facet-sweep", 1

TITLES = {"no-tree": "Without a tree", "tree": "With a tree", "large": "A larger scene"}


@dataclass
class Shape:
    name: str
    width: int  # work-items; 0 for the driver's choice
    height: int
    standing: str
    kernel_ms: Estimate | None = None  # none without samples
    speed_up: Estimate | None = None  # by kernel time; none without the serial reference
    is_best: bool = False

    @property
    def items(self):
        return self.width * self.height


@dataclass
class Experiment:
    name: str
    scene: str
    triangles: int
    scene_hash: str
    text_hash: str
    tree: str
    picture: tuple  # width, height, max_depth, samples
    serial_ms: Estimate | None
    shapes: list = field(default_factory=list)

    @property
    def title(self):
        width, height = self.picture[:2]
        return (f"{TITLES.get(self.name, self.name)}: {self.scene}, {self.triangles:,} triangles, "
                f"{width}\N{MULTIPLICATION SIGN}{height} pixels")

    def drawn(self):
        """Shapes with times that count: not the driver's, not refused, not with another picture."""
        return [s for s in self.shapes
                if s.width and s.kernel_ms and s.standing in ("measured", "unfinished")]

    def driver(self):
        of = [s for s in self.shapes if not s.width and s.kernel_ms and s.standing != "different"]
        return of[0] if of else None


@dataclass
class Result(Origin):
    experiments: dict  # by name

    def caption(self):
        """Where and when: for the foot of each figure."""
        return (f"{self.device}, driver {self.driver}; serial: {self.cpu}, one thread\n{self.date}, "
                f"Facet {short_commit(self.commit)}; medians of {self.repeats} and their "
                f"{100 * self.level:g}% bootstrap intervals"
                + ("" if self.complete else "; interrupted, not complete"))


def _shape(node, best):
    name = node["shape"].get(str)
    width, height = 0, 0
    if name != "driver":
        try:
            width, height = (int(side) for side in name.split("x"))
        except ValueError:
            node["shape"].fail(f'found "{name}"; allowed: WIDTHxHEIGHT, or "driver"')
    shape = Shape(name, width, height, node["standing"].get(str), is_best=name in best)
    if kernel := node.find("kernel"):
        shape.kernel_ms = median_if_any(kernel)
    if ratio := node.find("speed_up") and node["speed_up"].find("kernel"):
        shape.speed_up = Estimate(ratio["value"].get(float), *ratio["interval"].pair())
    return shape


def _experiment(node):
    scene, picture = node["scene"], node["picture"]
    best = {item.get(str) for item in node["best"].items()}
    return Experiment(
        name=node["name"].get(str),
        scene=scene["name"].get(str),
        triangles=scene["triangles"].get(int),
        scene_hash=scene["hash"].get(str),
        text_hash=node["kernel"]["text_hash"].get(str),
        tree=node["tree"]["kind"].get(str),
        picture=tuple(picture[key].get(int) for key in ("width", "height", "max_depth", "samples")),
        serial_ms=median_if_any(node["serial"]["wall"]),
        shapes=[_shape(item, best) for item in node["shapes"].items()])


def read_sweep(path):
    """Raises ResultError for another format or version, or where something is missing."""
    root = Node(path, read_file(path, {FORMAT: VERSION}))
    experiments = [_experiment(item) for item in root["experiments"].items()]
    return Result(
        **origin_of(path, root),
        experiments={e.name: e for e in experiments})


# What two experiments must share to stand in one plot, and what it is called.
COMPARABLE = {
    "scene_hash": "scene",
    "picture": "picture (width, height, depth, samples)",
    "tree": "tree",
    "text_hash": "kernel text",
}


def together(results, name):
    """The experiment of that name in each result, to be drawn in one plot. Raises ResultError,
    naming both files, if they are not of one scene, picture, tree and kernel text; options may
    differ, for they depend on the device."""
    first = results[0]
    for other in results:
        if name not in other.experiments:
            raise ResultError(f"{other.path}: has no experiment {name}, and {first.path} has; plot "
                              "them one by one, or measure it")
        for attribute, word in COMPARABLE.items():
            mine = getattr(first.experiments[name], attribute)
            found = getattr(other.experiments[name], attribute)
            if found != mine:
                raise ResultError(
                    f"{other.path}: experiment {name}: found another {word} ({found}) than in "
                    f"{first.path} ({mine}); one plot holds results of one {word}: plot them one "
                    "by one")
    return [r.experiments[name] for r in results]
