"""Figures of speed against error: what a faster variant costs, in three layers."""

import math

import plot_style as style
from matplotlib.ticker import FixedLocator, LogLocator, NullFormatter, NullLocator, ScalarFormatter
from plot_labels import place_labels
from plot_style import plt
from variant_results import check_together

# (family, colour, marker): what is not listed yet gets the last.
FAMILIES = {
    "exact": (style.BLUE, "o"),
    "arithmetic": (style.ORANGE, "^"),
    "moller-trumbore": (style.VERMILION, "s"),
    "plain edges": (style.PURPLE, "D"),
    "fewer bounces": (style.GREEN, "v"),
    "cut-off": (style.SKY, "P"),
}
OTHER = (style.GREY, "X")

# How long names begin in the plots.
SHORT = {"moller-trumbore": "MT", "plain-edges": "plain"}

# (name, title, speed, its unit, error, its unit, error with silhouettes or None, what that is)
LAYERS = (
    ("hits", "Hits", lambda v: v.rays if v.traces_itself else None,
     "speed of eye and bounce rays (Mrays/s)", lambda v: v.errors_per_million,
     "wrong hits per million rays, but for ties and silhouettes", lambda v: v.wrong_per_million,
     "with ties and silhouettes"),
    ("linear", "Linear picture", lambda v: v.pixels, "speed of pictures (Mpixels/s)",
     lambda v: v.rmse_rest, "RMSE without silhouettes (linear, 0 to 1)", lambda v: v.rmse,
     "with silhouettes"),
    ("displayed", "Displayed picture", lambda v: v.pixels, "speed of pictures (Mpixels/s)",
     lambda v: v.flip, "mean FLIP (0 to 1)", None, ""),
)


def short(name):
    for long, begins in SHORT.items():
        if name.startswith(long):
            return begins + name[len(long):]
    return name


class ErrorAxis:
    """Errors on a logarithmic axis, and below them, past a line, a place for 0."""

    def __init__(self, values):
        positive = [v for v in values if v > 0]
        self.has_zero = any(v == 0 for v in values)
        low = math.floor(math.log10(min(positive))) if positive else -1
        high = math.ceil(math.log10(max(positive))) if positive else 0
        self.low, self.high = low, max(high, low + 1)
        self.zero = 10 ** (low - 0.1 * (self.high - low) - 0.1)

    def place(self, value):
        return value if value > 0 else self.zero

    def draw(self, axes):
        axes.set_yscale("log")
        powers = [10.0 ** k for k in range(self.low, self.high + 1)]
        labels = [f"$10^{{{k}}}$" for k in range(self.low, self.high + 1)]
        if self.has_zero:
            powers.insert(0, self.zero)
            labels.insert(0, "0")
            axes.axhline(math.sqrt(self.zero * powers[1]), color=style.GREY, linewidth=0.8,
                         linestyle=(0, (1, 2)))
        axes.yaxis.set_major_locator(FixedLocator(powers))
        axes.set_yticklabels(labels)
        axes.yaxis.set_minor_locator(NullLocator())
        bottom = self.zero if self.has_zero else powers[0]
        room = (powers[-1] / bottom) ** 0.07
        axes.set_ylim(bottom / room, powers[-1] * room)


def frontier(points):
    """Of (speed, error): those that no other beats in one and equals in the other, by speed."""
    best, kept = math.inf, []
    for speed, error in sorted(set(points), key=lambda p: (-p[0], p[1])):
        if error < best:
            best = error
            kept.append((speed, error))
    return kept[::-1]


def _draw_frontier(axes, points, scale):
    """Steps: whatever lies above and to the left is beaten by a corner."""
    kept = frontier(points)
    x, y = [], []
    for k, (speed, error) in enumerate(kept):
        x.append(speed)
        y.append(scale.place(error))
        if k + 1 < len(kept):
            x.append(speed)
            y.append(scale.place(kept[k + 1][1]))
    axes.plot(x, y, color=style.BLACK, linewidth=1, linestyle="-", alpha=0.55, zorder=1)
    return [(*a, *b) for a, b in zip(zip(x, y), list(zip(x, y))[1:])]


def _speed_axis(axes, speeds, label):
    values = [s.value for s in speeds]
    if max(values) > 4 * min(values):
        axes.set_xscale("log")
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.margins(x=0.18)
    axes.set_xlabel(label)


def _panel(axes, drawn, layer, scale):
    _, _, speed_of, speed_label, error_of, _, more_of, _ = layer
    speeds = [speed_of(v) for v in drawn]
    scale.draw(axes)
    lines = _draw_frontier(axes, [(s.value, error_of(v)) for v, s in zip(drawn, speeds)], scale)
    for v, s in zip(drawn, speeds):
        colour, marker = FAMILIES.get(v.family, OTHER)
        is_strict = v.name == "strict"
        y = scale.place(error_of(v))
        if more_of and more_of(v) > error_of(v):
            axes.plot([s.value, s.value], [y, scale.place(more_of(v))], color=colour, linewidth=0.8,
                      linestyle=":", zorder=2)
            axes.plot([s.value], [scale.place(more_of(v))], color=colour, marker="_", markersize=6,
                      zorder=2)
            lines.append((s.value, y, s.value, scale.place(more_of(v))))
        lines.append((s.low, y, s.high, y))
        axes.errorbar([s.value], [y], xerr=[[max(0, s.value - s.low)], [max(0, s.high - s.value)]],
                      color=colour, linestyle="none", elinewidth=0.8, capsize=1.5, zorder=3)
        axes.plot([s.value], [y], linestyle="none", marker="*" if is_strict else marker,
                  markersize=12 if is_strict else 6, color=colour, markeredgecolor="white",
                  markeredgewidth=0.5, zorder=4.5 if is_strict else 4)
    _speed_axis(axes, speeds, speed_label)
    return [(short(v.name), s.value, scale.place(error_of(v)), v.name == "strict")
            for v, s in zip(drawn, speeds)], lines


def layer_figure(results, layer):
    """A column for each result; None where nothing was timed."""
    _, title, speed_of, _, error_of, error_label, more_of, more_label = layer
    drawn = [[v for v in r.variants if speed_of(v)] for r in results]
    if not any(drawn):
        return None
    values = [f(v) for some in drawn for v in some for f in (error_of, more_of) if f]
    scale = ErrorAxis(values)
    figure, grid = plt.subplots(1, len(results), figsize=(7.4 * len(results), 5.6), sharey="all",
                                squeeze=False, gridspec_kw={"wspace": 0.06})
    labels = []
    for axes, result, some in zip(grid[0], results, drawn):
        if some:
            labels.append((axes, *_panel(axes, some, layer, scale)))
        axes.annotate(_foot(result), (0, 0), xycoords="axes fraction",
                      xytext=(-40, -38), textcoords="offset points", va="top", fontsize=7,
                      color=style.GREY)
        if len(results) > 1:
            axes.set_title(f"{result.device}, {result.date}")
    grid[0][0].set_ylabel(error_label)
    _legend(figure, grid[0][0], [v for some in drawn for v in some], more_label if more_of else "")
    figure.suptitle(f"{title}: speed against error\n{results[0].title}",
                    y=1.1 if len(results) > 1 else 1.06, fontsize=10)
    for axes, points, lines in labels:
        place_labels(axes, points, lines)
    return figure


def _foot(result):
    text = result.caption()
    refused = [v.name for v in result.variants if v.state == "refused"]
    untimed = [v.name for v in result.variants if v.state == "unfinished" and not v.pixels]
    if refused:
        text += f"\nrefused by the device: {', '.join(refused)}"
    if untimed:
        text += f"\nnot timed: {', '.join(untimed)}"
    return text


def _legend(figure, axes, drawn, more_label):
    seen = {v.family for v in drawn}
    for family in [f for f in FAMILIES if f in seen] + sorted(seen - set(FAMILIES)):
        colour, marker = FAMILIES.get(family, OTHER)
        axes.plot([], [], linestyle="none", marker=marker, color=colour,
                  label=f"{family} (MT)" if family == "moller-trumbore" else family)
    axes.plot([], [], linestyle="none", marker="*", markersize=10, color=FAMILIES["exact"][0],
              label="strict")
    axes.plot([], [], color=style.BLACK, alpha=0.55, linewidth=1, label="frontier")
    if more_label:
        axes.plot([], [], color=style.GREY, marker="_", linestyle=":", label=more_label)
    handles, words = axes.get_legend_handles_labels()
    figure.legend(handles, words, loc="lower center", ncol=5,
                  bbox_to_anchor=(0.5, 0.93 if axes.get_title() else 0.89),
                  frameon=False, columnspacing=1.2, handletextpad=0.4)


def draw(results, folder, name):
    """All figures of these results; returns the paths of the files. Raises ResultError, before any
    is written, if they cannot stand in one plot."""
    check_together(results)
    paths = []
    for layer in LAYERS:
        if figure := layer_figure(results, layer):
            paths += style.save(figure, folder, f"{name}-{layer[0]}")
    return paths
