#!/usr/bin/env python3
"""Plots results: one command from JSON files to PNG and SVG.

    bench/plots.py RESULT.json... [--out FOLDER] [--name NAME]

Results of `facet sweep` and of `facet accuracy --variants` alike. Several files of one scene, of one
of the two, are drawn side by side in each plot. Needs Python 3.10 and matplotlib (Debian:
python3-matplotlib). Exit codes are those of facet: 0 done, 2 usage, 3 a file that cannot be plotted, 6
output.
"""

import argparse
import importlib
import os
import sys

import sweep_results
import variant_results
from results_file import ResultError, format_of

# How each format is read, and the module that draws it: what that needs is not needed to refuse a
# file.
FORMATS = {
    sweep_results.FORMAT: (sweep_results.read_sweep, "sweep_figures"),
    variant_results.FORMAT: (variant_results.read_variants, "frontier_figures"),
}


def read_all(paths):
    """The files' content, and the module that draws it. Raises ResultError for what is no result,
    and for files of two formats."""
    formats = [format_of(path, FORMATS) for path in paths]
    for path, found in zip(paths, formats):
        if found != formats[0]:
            raise ResultError(f"{path}: found the format {found}, and {paths[0]} is {formats[0]}; "
                              "plots hold one format: plot them one by one")
    read, figures = FORMATS[formats[0]]
    return [read(path) for path in paths], importlib.import_module(figures)


def main(arguments):
    parser = argparse.ArgumentParser(
        description="Plots results of `facet sweep` and of `facet accuracy --variants`, from JSON to "
        "PNG and SVG.")
    parser.add_argument("results", nargs="+", metavar="RESULT.json",
                        help="files of one scene are drawn side by side")
    parser.add_argument("--out", default=".", metavar="FOLDER", help="where the plots go (default: .)")
    parser.add_argument("--name", help="how their names begin (default: the first file's name)")
    options = parser.parse_args(arguments)
    name = options.name or os.path.splitext(os.path.basename(options.results[0]))[0]
    try:
        results, figures = read_all(options.results)
        os.makedirs(options.out, exist_ok=True)
        paths = figures.draw(results, options.out, name)
    except ResultError as error:
        print(f"plots.py: {error}", file=sys.stderr)
        return 3
    except ImportError as error:
        print(f"plots.py: {error}; install Debian's python3-matplotlib", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"plots.py: {error.filename}: cannot be written: {error.strerror}", file=sys.stderr)
        return 6
    for path in paths:
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
