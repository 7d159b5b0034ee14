"""Figures of how the time of whole pictures grows: with pixels, where a guide shows what linear is,
and with depth, where the rays of each kind show what a bounce adds."""

import os
import re
import textwrap

import plot_style as style
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter
from measurement import Estimate
from picture_growth_results import exponent_of, together
from plot_style import plt

TIMES = "\N{MULTIPLICATION SIGN}"

# way: (colour, marker, line)
WAYS = {
    "default": (style.BLUE, "o", "-"),
    "single": (style.VERMILION, "s", "--"),
    "all-features": (style.PURPLE, "d", ":"),
    "narrow": (style.ORANGE, "v", "-."),
    "image": (style.BLACK, "x", "--"),
}
OTHER = (style.GREY, "+", "-")
RAYS = {
    "eye": (style.BLUE, "o", "-"),
    "bounced": (style.GREEN, "v", "-."),
    "shadow": (style.ORANGE, "D", "--"),
}
RAY_TITLES = {"eye": "eye", "bounced": "reflected and refracted", "shadow": "shadow"}


def _estimates(axes, places, estimates, label, look):
    colour, marker, line = look
    middle = [e.value for e in estimates]
    axes.errorbar(places, middle,
                  yerr=[[e.value - e.low for e in estimates], [e.high - e.value for e in estimates]],
                  color=colour, marker=marker, linestyle=line, elinewidth=0.8, label=label)


def _ratio(estimate, count):
    """Nanoseconds for each of so many."""
    return Estimate(*(1e6 * ms / count for ms in (estimate.value, estimate.low, estimate.high)))


def _place(growth, p):
    return p.pixels if growth.along == "pixels" else p.depth


def _title(growth, way, points):
    if growth.along == "depth":
        return way
    slope, error = exponent_of(points)
    if error is None:
        return f"{way}: exponent {slope:.3f}"
    last, _ = exponent_of(points[-2:])  # what a picture costs whatever its size weighs least there
    return f"{way}: exponent {slope:.3f} \N{PLUS-MINUS SIGN} {error:.3f}, at the end {last:.3f}"


def _times(axes, growth):
    for way, points in growth.ways.items():
        _estimates(axes, [_place(growth, p) for p in points], [p.kernel_ms for p in points],
                   style.plain(_title(growth, way, points)), WAYS.get(way, OTHER))
    way, points = next(iter(growth.ways.items()))
    axes.plot([_place(growth, p) for p in points], [p.wall_ms.value for p in points],
              color=style.SKY, linewidth=1, linestyle=":", marker=".",
              label=style.plain(f"{way}, until the picture is on the host"))
    axes.set_ylabel("kernel time of a picture (ms)")


def _times_by_pixels(axes, growth):
    _times(axes, growth)
    points = growth.shapes()
    last = points[-1]
    axes.plot([p.pixels for p in points],
              [last.kernel_ms.value * p.pixels / last.pixels for p in points],
              color=style.GREY, linewidth=0.9, label="a guide: proportional to pixels", zorder=1)


def _each(axes, growth, count, label):
    for way, points in growth.ways.items():
        _estimates(axes, [_place(growth, p) for p in points],
                   [_ratio(p.kernel_ms, count(p)) for p in points], style.plain(way),
                   WAYS.get(way, OTHER))
    axes.set_ylabel(label)


def _each_pixel(axes, growth):
    _each(axes, growth, lambda p: p.pixels, "kernel time of a pixel (ns)")


def _each_ray(axes, growth):
    _each(axes, growth, lambda p: p.all_rays(), "kernel time of a ray (ns)")


def _rays(axes, growth):
    points = growth.shapes()
    for kind, (colour, marker, line) in RAYS.items():
        axes.plot([p.depth for p in points], [p.rays[kind] / 1e6 for p in points], color=colour,
                  marker=marker, linestyle=line, label=f"{RAY_TITLES[kind]} rays")
    axes.set_ylabel("rays of a picture (million)")


def _by_factors(axes, _):
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    axes.set_ylim(bottom=low * (low / high) ** 0.35)  # the legend's room: lines rise to the right
    axes.yaxis.set_major_locator(LogLocator(numticks=16))
    axes.yaxis.set_minor_formatter(NullFormatter())


def _from_0(axes, _):
    axes.set_ylim(bottom=0)


def _from_0_or_by_factors(axes, growths):
    """By factors where a pixel of small pictures, or of another device, costs many times as much."""
    values = [p.kernel_ms.value / p.pixels for g in growths for points in g.ways.values()
              for p in points]
    if max(values) <= 8 * min(values):
        return _from_0(axes, growths)
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda y, _: f"{y:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())


# What is drawn, and the scale, which is set when all columns are drawn.
PANELS = {
    "pixels": ((_times_by_pixels, _by_factors), (_each_pixel, _from_0_or_by_factors)),
    "depth": ((_times, _from_0), (_rays, _from_0), (_each_ray, _from_0)),
}
AXIS_TITLES = {"pixels": "pixels", "depth": "depth (bounces)"}


def _foot(result, growth):
    """The caption, and which pictures had no room for all rays at once."""
    lines = [result.caption()]
    if growth.along == "pixels":
        lines.append("exponents are of pixels, \N{PLUS-MINUS SIGN} their standard errors; at the end: "
                     "of the two largest pictures alone")
    for way, points in growth.ways.items():
        parts = [f"{p.width}{TIMES}{p.height} in {p.tiles}" for p in points if (p.tiles or 1) > 1]
        if parts:
            lines += textwrap.wrap(f"{way}: in several tiles, one after the other: {', '.join(parts)}", 92)
    return "\n".join(lines)


def _heading(growth):
    p = growth.shapes()[0]
    eye_rays = p.samples * p.samples
    if growth.along == "pixels":
        what = f"Growth with pixels: {growth.scene}\ndepth {p.depth}"
    else:
        what = f"Growth with depth: {growth.scene}\n{p.width}{TIMES}{p.height} pixels"
    return (f"{what}, {eye_rays} eye ray{'s' if eye_rays > 1 else ''} a pixel, "
            f"{p.triangles:,} triangles")


def picture_growth(results, growths):
    """A column for each result, and in each the panels of what it grows along."""
    along = growths[0].along
    panels = PANELS[along]
    is_shared = along == "pixels"  # on linear axes a GPU's times would be 0 beside a CPU's
    figure, grid = plt.subplots(len(panels), len(results), sharex="all", squeeze=False,
                                sharey="row" if is_shared else "none",
                                figsize=(6.4 * len(results), 3.2 * len(panels)),
                                gridspec_kw={"hspace": 0.08, "wspace": 0.06 if is_shared else 0.13})
    for column, (result, growth) in enumerate(zip(results, growths)):
        for row, (panel, _) in enumerate(panels):
            axes = grid[row][column]
            if along == "pixels":
                axes.set_xscale("log")
                axes.grid(True, which="minor", linewidth=0.3)
            else:
                axes.xaxis.set_major_locator(MaxNLocator(integer=True))
            panel(axes, growth)
            if column > 0:
                axes.set_ylabel("")
        if len(results) > 1:
            grid[0][column].set_title(style.plain(f"{result.device}, {result.date}"))
        grid[-1][column].set_xlabel(AXIS_TITLES[along])
        grid[-1][column].annotate(
            style.plain(_foot(result, growth)), (0, 0), xycoords="axes fraction", xytext=(-40, -34),
            textcoords="offset points", va="top", fontsize=7, color=style.GREY)
    for row, (_, scale) in enumerate(panels):
        for axes in grid[row][:1] if is_shared else grid[row]:
            scale(axes, growths)
        for axes in grid[row]:
            axes.legend(loc="best")
    figure.align_ylabels(grid[:, 0])
    height = figure.get_size_inches()[1]
    figure.suptitle(style.plain(_heading(growths[0])), va="bottom",
                    y=grid[0][0].get_position().y1 + (0.35 if len(results) > 1 else 0.12) / height)
    return figure


def _file_name(growth):
    """Of the scene's name what file systems and Markdown take; then what all points share."""
    scene = re.sub(r"[^A-Za-z0-9]+", "-", os.path.splitext(growth.scene)[0]).strip("-")
    fixed = "x".join(map(str, growth.fixed))
    return f"{scene}-depth{fixed}-pixels" if growth.along == "pixels" else f"{scene}-{fixed}-depth"


def draw(results, folder, name):
    """All figures of these results; returns the paths of the files. Raises ResultError, before any
    is written, if they cannot stand in one plot."""
    paths, taken = [], {}
    for growths in together(results):
        stem = _file_name(growths[0])
        taken[stem] = taken.get(stem, 0) + 1  # two scenes may be called a.json and a.obj
        again = f"{taken[stem]}-" if taken[stem] > 1 else ""
        paths += style.save(picture_growth(results, growths), folder, f"{name}-{again}{stem}")
    return paths
