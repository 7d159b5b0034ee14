"""How Facet's figures look: legible in print, with colours and markers that the colour-blind can
tell apart, and the same bytes for the same data."""

import os

import matplotlib
from whole_file import whole_file

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the backend is chosen)

# Okabe and Ito, "Color universal design", 2008.
BLACK, ORANGE, SKY, GREEN, YELLOW, BLUE, VERMILION, PURPLE = (
    "#000000", "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7")
GREY = "#767676"

# Perceptually uniform, and monotone in grey.
HEAT = "cividis"

plt.rcParams.update({
    "figure.dpi": 100,
    "savefig.dpi": 200,
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#d8d8d8",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.3,
    "lines.markersize": 5,
    "errorbar.capsize": 2,
    "legend.fontsize": 8,
    "svg.fonttype": "none",
    "svg.hashsalt": "facet",
})


def plain(text):
    """Text of a file as it is: a $ in a name begins no formula."""
    return text.replace("$", r"\$")


def save(figure, folder, name):
    """Writes NAME.png and NAME.svg, whole or not at all; returns their paths."""
    paths = []
    for extension in ("png", "svg"):
        path = os.path.join(folder, f"{name}.{extension}")
        with whole_file(path) as partial:
            figure.savefig(partial, format=extension, bbox_inches="tight", pad_inches=0.1,
                           metadata={"Date": None} if extension == "svg" else None)
        paths.append(path)
    plt.close(figure)
    return paths
