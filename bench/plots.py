#!/usr/bin/env python3
"""Plots results: one command from JSON files to PNG and SVG.

    bench/plots.py RESULT.json... [--out FOLDER] [--name NAME]

Several files of one scene are drawn side by side in each plot of time against block size. Needs
Python 3.10 and matplotlib (Debian: python3-matplotlib). Exit codes are those of facet: 0 done, 2
usage, 3 a file that cannot be plotted, 6 output.
"""

import argparse
import os
import sys

from results_file import ResultError
from sweep_results import read_sweep


def main(arguments):
    parser = argparse.ArgumentParser(
        description="Plots results of `facet sweep`, from JSON to PNG and SVG.")
    parser.add_argument("results", nargs="+", metavar="RESULT.json",
                        help="files of one scene are drawn side by side")
    parser.add_argument("--out", default=".", metavar="FOLDER", help="where the plots go (default: .)")
    parser.add_argument("--name", help="how their names begin (default: the first file's name)")
    options = parser.parse_args(arguments)
    name = options.name or os.path.splitext(os.path.basename(options.results[0]))[0]
    try:
        results = [read_sweep(path) for path in options.results]
        import sweep_figures  # what it needs is not needed to refuse a file
        os.makedirs(options.out, exist_ok=True)
        paths = sweep_figures.draw(results, options.out, name)
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
