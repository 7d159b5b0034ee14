"""Figures of growth: time a ray, and time to build, against triangles."""

import math
import textwrap

import plot_style as style
from growth_results import together
from matplotlib.ticker import LogLocator, NullFormatter
from plot_style import plt

TIMES = "\N{MULTIPLICATION SIGN}"

# way: (colour, marker, line)
WAYS = {
    "tree": (style.BLUE, "o", "-"),
    "no-tree": (style.VERMILION, "s", "--"),
    "serial": (style.BLACK, "^", ":"),
}
RAYS = {
    "eye": (style.BLUE, "o", "-"),
    "shadow": (style.ORANGE, "D", "--"),
    "bounce": (style.GREEN, "v", "-."),
}


def _line(axes, points, label, look):
    """points: (triangles, Estimate)."""
    if not points:
        return
    colour, marker, line = look
    middle = [e.value for _, e in points]
    axes.errorbar([n for n, _ in points], middle,
                  yerr=[[e.value - e.low for _, e in points], [e.high - e.value for _, e in points]],
                  color=colour, marker=marker, linestyle=line, elinewidth=0.8, label=label)


def _guide(axes, points):
    """How time would grow with log n from the first point on."""
    if len(points) < 2:
        return
    (first, estimate), last = points[0], points[-1][0]
    sizes = [first * (last / first) ** (k / 32) for k in range(33)]
    axes.plot(sizes, [estimate.value * math.log(n) / math.log(first) for n in sizes],
              color=style.GREY, linewidth=0.9, label="a guide: proportional to log n")


def _eye(axes, series):
    for s in series:
        _line(axes, [(p.triangles, p.ray_ns["eye"]) for p in s.points if "eye" in p.ray_ns],
              s.title, WAYS[s.way])
    for s in series:
        if s.way == "tree":
            _guide(axes, [(p.triangles, p.ray_ns["eye"]) for p in s.points if "eye" in p.ray_ns])
    axes.set_ylabel("time of an eye ray (ns)")


def _kinds(axes, series):
    for s in series:
        if s.way != "tree":
            continue
        for rays, look in RAYS.items():
            _line(axes, [(p.triangles, p.ray_ns[rays]) for p in s.points if rays in p.ray_ns],
                  f"{rays} rays, {s.title}", look)
    axes.set_ylabel("time of a ray (ns)")


def _build(axes, series):
    for s in series:
        if s.way == "no-tree":
            continue
        _line(axes, [(p.triangles, p.build_ms) for p in s.points],
              "the device's tree" if s.way == "tree" else "the serial reference's tree",
              WAYS[s.way])
    axes.set_ylabel("time to build (ms)")


PANELS = (_eye, _kinds, _build)


def _scales(axes):
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(numticks=16))
        axis.set_minor_formatter(NullFormatter())
    axes.grid(True, which="minor", linewidth=0.3)


def _foot(result, series):
    """The caption, why series end before others, and what makes them doubtful."""
    lines = [result.caption()]
    for s in series:
        if s.ended:
            lines += textwrap.wrap(f"{s.title}: {s.ended}", 92)
        if s.differing_hits():
            lines.append(f"{s.title}: {s.differing_hits():,} HITS DIFFER from those with the tree")
    return "\n".join(lines)


def growth(results, family):
    """A column for each result: eye rays by each way, kinds of rays with a tree, building."""
    figure, grid = plt.subplots(len(PANELS), len(results), sharex="all", sharey="row", squeeze=False,
                                figsize=(6.4 * len(results), 3.4 * len(PANELS)),
                                gridspec_kw={"hspace": 0.08, "wspace": 0.06})
    for column, result in enumerate(results):
        series = result.families[family]
        for row, panel in enumerate(PANELS):
            axes = grid[row][column]
            axes.set_xscale("log")
            axes.set_yscale("log")
            panel(axes, series)
            _scales(axes)
            if axes.get_legend_handles_labels()[0]:
                axes.legend(loc="best")
            if column > 0:
                axes.set_ylabel("")
        if len(results) > 1:
            grid[0][column].set_title(style.plain(f"{result.device}, {result.date}"))
        grid[-1][column].set_xlabel("triangles")
        grid[-1][column].annotate(
            style.plain(_foot(result, series)), (0, 0), xycoords="axes fraction", xytext=(-40, -34),
            textcoords="offset points", va="top", fontsize=7, color=style.GREY)
    figure.align_ylabels(grid[:, 0])
    width, height = results[0].picture
    figure.suptitle(style.plain(f"Growth with triangles: {family}\n{width}{TIMES}{height} eye rays, "
                                "and the shadow and bounce rays of their hits"), y=0.945)
    return figure


def draw(results, folder, name):
    """All figures of these results; returns the paths of the files. Raises ResultError, before any
    is written, if they cannot stand in one plot."""
    paths = []
    for family in together(results):
        paths += style.save(growth(results, family), folder, f"{name}-{family}-growth")
    return paths
