"""Which results there are to plot: a row for each format."""

import importlib
from dataclasses import dataclass
from typing import Callable

import growth_results
import picture_growth_results
import sweep_results
import variant_results
from results_file import ResultError, read_file


@dataclass(frozen=True)
class Kind:
    format: str
    version: int
    read: Callable  # path -> result
    figures: str  # a module with draw(results, folder, name) -> paths; imported to draw, not to read

    def draw(self, results, folder, name):
        return importlib.import_module(self.figures).draw(results, folder, name)


KINDS = {kind.format: kind for kind in (
    Kind(sweep_results.FORMAT, sweep_results.VERSION, sweep_results.read_sweep, "sweep_figures"),
    Kind(growth_results.FORMAT, growth_results.VERSION, growth_results.read_growth,
         "growth_figures"),
    Kind(variant_results.FORMAT, variant_results.VERSION, variant_results.read_variants,
         "frontier_figures"),
    Kind(picture_growth_results.FORMAT, picture_growth_results.VERSION,
         picture_growth_results.read_picture_growth, "picture_growth_figures"),
)}


def kind_of(path):
    """Raises ResultError if the file is of no kind, or of another version of it."""
    return KINDS[read_file(path, {kind.format: kind.version for kind in KINDS.values()})["format"]]


def one_kind_of(paths):
    """The kind of all files; raises ResultError, naming two of them, if they are of several."""
    first = kind_of(paths[0])
    for path in paths[1:]:
        if (other := kind_of(path)) is not first:
            raise ResultError(f"{path}: found the format {other.format}, and {paths[0]} has "
                              f"{first.format}; one plot holds results of one format: plot them one "
                              "by one")
    return first
