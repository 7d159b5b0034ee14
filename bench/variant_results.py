"""Results of `facet accuracy --variants` (facet-variants.schema.json), as the figures need them."""

from dataclasses import dataclass, field

from measurement import Estimate, Origin, median_if_any, origin_of
from results_file import Node, ResultError, read_file, short_commit

FORMAT, VERSION = "facet-variants", 1

TIMES = "\N{MULTIPLICATION SIGN}"


@dataclass
class Variant:
    name: str
    family: str
    state: str
    traces_itself: bool = False  # its rays are not those of another variant
    pixels: Estimate | None = None  # million a second, of pictures; none without times
    rays: Estimate | None = None  # million a second, of eye and bounce rays
    wrong_per_million: float = 0
    errors_per_million: float = 0  # of these, neither ties nor silhouettes
    rmse: float = 0
    rmse_rest: float = 0  # without silhouettes
    flip: float = 0


@dataclass
class Result(Origin):
    scene: str
    triangles: int
    scene_hash: str
    picture: tuple  # width, height, max_depth, samples
    variants: list = field(default_factory=list)

    @property
    def title(self):
        _, _, depth, samples = self.picture
        return (f"{self.scene}, {self.triangles:,} triangles, {depth} bounces, "
                f"{samples}{TIMES}{samples} samples a pixel")

    def caption(self):
        """Where and when: for the foot of each figure."""
        width, height = self.picture[:2]
        return (f"{self.device}, driver {self.driver}; {width}{TIMES}{height} pixels; double "
                f"reference: {self.cpu}\n{self.date}, Facet {short_commit(self.commit)}; medians of "
                f"{self.repeats} and their {100 * self.level:g}% bootstrap intervals"
                + ("" if self.complete else "; interrupted, not complete"))


def _speed(work, times):
    """Millions a second, of that many in the times' sum; the slowest is the low end."""
    if not times or any(t is None or t.low <= 0 for t in times):
        return None
    median, fastest, slowest = (sum(getattr(t, end) for t in times) for end in ("value", "low", "high"))
    return Estimate(work / median * 1e-3, work / slowest * 1e-3, work / fastest * 1e-3)


def _variant(node, pixels):
    v = Variant(node["name"].get(str), node["family"].get(str), node["state"].get(str))
    v.traces_itself = node["hits_of"].get(str) == v.name
    picture = node.find("picture")
    if picture is None:  # refused, or interrupted before
        return v
    v.pixels = _speed(pixels, [median_if_any(picture["kernel"])])
    errors = picture["errors"]
    v.rmse = errors["linear"]["all"]["rmse"].get(float)
    v.rmse_rest = errors["linear"]["without_silhouettes"]["rmse"].get(float)
    v.flip = errors["displayed"]["flip_mean"].get(float)
    sets = [s for s in node["hits"].items() if s["count"].get(int) > 0]
    count = sum(s["count"].get(int) for s in sets)
    if count:
        v.rays = _speed(count, [median_if_any(s["kernel"]) for s in sets])
        v.wrong_per_million, v.errors_per_million = (
            1e6 * sum(s["errors"][key].get(int) for s in sets) / count for key in ("wrong", "errors"))
    return v


def read_variants(path):
    """Raises ResultError for another format or version, or where something is missing."""
    root = Node(path, read_file(path, {FORMAT: VERSION}))
    scene = root["scene"]
    picture = tuple(root["picture"][key].get(int)
                    for key in ("width", "height", "max_depth", "samples"))
    return Result(
        **origin_of(path, root),
        scene=scene["name"].get(str),
        triangles=scene["triangles"].get(int),
        scene_hash=scene["hash"].get(str),
        picture=picture,
        variants=[_variant(item, picture[0] * picture[1]) for item in root["variants"].items()])


def check_together(results):
    """Raises ResultError, naming both files, for results of another scene, depth or samples.
    Pictures may differ in size: devices differ in speed."""
    first = results[0]
    for other in results[1:]:
        for word, mine, found in (
                ("scene", first.scene_hash, other.scene_hash),
                ("depth and samples", first.picture[2:], other.picture[2:])):
            if found != mine:
                raise ResultError(
                    f"{other.path}: found another {word} ({found}) than in {first.path} ({mine}); "
                    f"one plot holds results of one {word}: plot them one by one")
