"""Figures of a sweep: time and speed-up against the size of a work-group, and a map of shapes."""

import math

import plot_style as style
from matplotlib.patches import Rectangle
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator
from plot_style import plt
from sweep_results import together

TIMES = "\N{MULTIPLICATION SIGN}"

# (name, which shapes, colour, marker, line): a 1x1 group begins squares, rows and columns.
KINDS = (
    (f"squares N{TIMES}N", lambda s: s.width == s.height, style.BLUE, "s", "-"),
    (f"rows N{TIMES}1", lambda s: s.height == 1, style.ORANGE, ">", "-"),
    (f"columns 1{TIMES}N", lambda s: s.width == 1, style.GREEN, "^", "-"),
    ("other rectangles", lambda s: 1 not in (s.width, s.height) and s.width != s.height,
     style.PURPLE, "d", "none"),
)


def _place(shape):
    """Where a shape stands along the axis of sizes: those of one size side by side, from columns on
    the left to rows on the right."""
    slant = math.log2(shape.width / shape.height) / max(1, math.log2(shape.items))
    return shape.items * 2 ** (0.32 * slant)


def _points(axes, shapes, value, label, colour, marker, line):
    """Filled where a shape is among the best, hollow where it is not."""
    shapes = sorted((s for s in shapes if value(s)), key=lambda s: s.items)
    if not shapes:
        return
    places, middle = [_place(s) for s in shapes], [value(s).value for s in shapes]
    axes.errorbar(places, middle,
                  yerr=[[m - value(s).low for m, s in zip(middle, shapes)],
                        [value(s).high - m for m, s in zip(middle, shapes)]],
                  color=colour, linestyle=line, linewidth=1, elinewidth=0.7, zorder=2)
    for is_best, face in ((True, colour), (False, "white")):
        some = [(p, m) for p, m, s in zip(places, middle, shapes) if s.is_best == is_best]
        axes.plot([p for p, _ in some], [m for _, m in some], linestyle="none", marker=marker,
                  color=colour, markerfacecolor=face, zorder=3)
    axes.plot([], [], color=colour, marker=marker, linestyle=line, label=label)


def _level(axes, estimate, label, colour, line):
    """A horizontal line with its interval as a band."""
    if estimate:
        axes.axhline(estimate.value, color=colour, linestyle=line, label=label)
        axes.axhspan(estimate.low, estimate.high, color=colour, alpha=0.15, linewidth=0)


def _panel(axes, experiment, value, unit):
    shapes = experiment.drawn()
    for label, belongs, colour, marker, line in KINDS:
        _points(axes, filter(belongs, shapes), value, label, colour, marker, line)
    if driver := experiment.driver():
        _level(axes, value(driver), "the driver's choice", style.VERMILION, "--")
    axes.set_xscale("log", base=2)
    axes.xaxis.set_major_locator(LogLocator(base=2, numticks=32))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.tick_params(axis="x", labelsize=7.5)
    axes.set_ylabel(unit)
    _scale(axes, [value(s) for s in shapes if value(s)])


def _scale(axes, estimates):
    """From 0 where values lie together; by factors where they lie apart."""
    values = [e.value for e in estimates if e.value > 0]
    if values and max(values) > 4 * min(values):
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_minor_locator(NullLocator())
        axes.yaxis.set_major_formatter(FuncFormatter(lambda y, _: f"{y:g}"))
    else:
        axes.set_ylim(bottom=0)


def _left_out(experiment):
    counts = {}
    for s in experiment.shapes:
        if s.standing in ("refused", "different"):
            counts.setdefault(s.standing, []).append(s.name)
    words = {"refused": "refused by the device", "different": "with another picture"}
    return "; ".join(f"{len(names)} {words[kind]} ({names[0].replace('x', TIMES)}"
                     f"{', ...' if len(names) > 1 else ''})" for kind, names in counts.items())


def _captions(axes, result, experiment):
    text = result.caption()
    if left_out := _left_out(experiment):
        text += f"\nnot drawn: {left_out}"
    axes.annotate(style.plain(text), (0, 0), xycoords="axes fraction", xytext=(-40, -38),
                  textcoords="offset points", va="top", fontsize=7, color=style.GREY)


def blocks(results, name):
    """Kernel time, and speed-up over the serial reference, against work-items of a group: a column
    for each result."""
    experiments = together(results, name)
    figure, grid = plt.subplots(2, len(results), figsize=(6.4 * len(results), 7.2), sharex="all",
                                squeeze=False, gridspec_kw={"hspace": 0.08, "wspace": 0.22})
    for column, (result, experiment) in enumerate(zip(results, experiments)):
        time, ratio = grid[0][column], grid[1][column]
        _panel(time, experiment, lambda s: s.kernel_ms, "kernel time (ms)")
        _level(time, experiment.serial_ms, "serial reference", style.BLACK, ":")
        _panel(ratio, experiment, lambda s: s.speed_up, "speed-up (serial time / kernel time)")
        ratio.axhline(1, color=style.BLACK, linestyle=":")
        ratio.set_xlabel("work-items of a group")
        if len(results) > 1:
            time.set_title(style.plain(f"{result.device}, {result.date}"))
        _captions(ratio, result, experiment)
    grid[0][0].plot([], [], linestyle="none", marker="o", color=style.GREY,
                    label="filled: among the best, whose intervals overlap")
    handles, labels = grid[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=3 if len(results) == 1 else 4,
                  bbox_to_anchor=(0.5, 0.91), frameon=False)
    figure.suptitle(style.plain(experiments[0].title), y=1.03)
    return figure


def shapes_map(result, name):
    """Each shape's kernel time: width across, height up; None unless there are two of each."""
    experiment = result.experiments[name]
    cells = {(s.width, s.height): s for s in experiment.shapes if s.width}
    widths = sorted({w for w, _ in cells})
    heights = sorted({h for _, h in cells})
    drawn = experiment.drawn()
    if len(widths) < 2 or len(heights) < 2 or not drawn:
        return None
    least = min(s.kernel_ms.value for s in drawn)
    share = [[math.nan] * len(widths) for _ in heights]
    for s in drawn:
        share[heights.index(s.height)][widths.index(s.width)] = least / s.kernel_ms.value

    figure, axes = plt.subplots(figsize=(1.9 + 0.52 * len(widths), 1.9 + 0.42 * len(heights)))
    lowest = min(v for row in share for v in row if not math.isnan(v))
    image = axes.imshow(share, origin="lower", aspect="auto", cmap=style.HEAT,
                        vmin=min(0.5, lowest) if lowest > 0.2 else 0, vmax=1)
    for (width, height), s in cells.items():
        _cell(axes, s, widths.index(width), heights.index(height), s in drawn, image, least)
    axes.set_xticks(range(len(widths)), [str(w) for w in widths])
    axes.set_yticks(range(len(heights)), [str(h) for h in heights])
    axes.set_xlabel("width of a group (work-items)")
    axes.set_ylabel("height of a group (work-items)")
    axes.grid(False)
    axes.set_title(f"{style.plain(experiment.title)}\n"
                   "kernel time in ms; framed: best, intervals overlap; hatched: not measured")
    bar = figure.colorbar(image, ax=axes, pad=0.02)
    bar.set_label("speed, as a share of the fastest shape's")
    _captions(axes, result, experiment)
    return figure


def _cell(axes, shape, x, y, is_drawn, image, least):
    if not is_drawn:
        axes.add_patch(Rectangle((x - 0.5, y - 0.5), 1, 1, fill=False, hatch="////",
                                 edgecolor="#b0b0b0", linewidth=0))
        return
    red, green, blue, _ = image.cmap(image.norm(least / shape.kernel_ms.value))
    is_dark = 0.299 * red + 0.587 * green + 0.114 * blue < 0.5
    axes.text(x, y, f"{shape.kernel_ms.value:.3g}", ha="center", va="center", fontsize=6.5,
              color="white" if is_dark else "black")
    if shape.is_best:
        axes.add_patch(Rectangle((x - 0.46, y - 0.46), 0.92, 0.92, fill=False, linewidth=1.4,
                                 edgecolor=style.VERMILION))


def draw(results, folder, name):
    """All figures of these results; returns the paths of the files. Raises ResultError, before any
    is written, if they cannot stand in one plot."""
    for experiment in results[0].experiments:
        together(results, experiment)
    paths = []
    for experiment in results[0].experiments:
        paths += style.save(blocks(results, experiment), folder, f"{name}-{experiment}-blocks")
        for k, result in enumerate(results):
            figure = shapes_map(result, experiment)
            suffix = f"-{k + 1}" if len(results) > 1 else ""
            if figure:
                paths += style.save(figure, folder, f"{name}-{experiment}-shapes{suffix}")
    return paths
