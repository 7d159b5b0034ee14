#!/usr/bin/env python3
"""Plots results: one command from JSON files to PNG and SVG.

    bench/plots.py RESULT.json... [--out FOLDER] [--name NAME]

Results of `facet sweep`, `facet accuracy --variants`, `facet_bench growth`, and `facet_bench render` with
several widths or depths can be plotted (result_kinds.py); several files of one format and one scene
are drawn side by side. Needs Python 3.10 and matplotlib (Debian: python3-matplotlib). Exit codes are
those of facet: 0 done, 2 usage, 3 a file that cannot be plotted, 6 output.
"""

import argparse
import os
import sys

from result_kinds import one_kind_of
from results_file import ResultError


def main(arguments):
    parser = argparse.ArgumentParser(
        description="Plots results of `facet sweep`, `facet accuracy --variants`, and `facet_bench` "
                    "growth and render, from JSON to PNG and SVG.")
    parser.add_argument("results", nargs="+", metavar="RESULT.json",
                        help="files of one format and scene are drawn side by side")
    parser.add_argument("--out", default=".", metavar="FOLDER", help="where the plots go (default: .)")
    parser.add_argument("--name", help="how their names begin (default: the first file's name)")
    options = parser.parse_args(arguments)
    name = options.name or os.path.splitext(os.path.basename(options.results[0]))[0]
    try:
        kind = one_kind_of(options.results)
        results = [kind.read(path) for path in options.results]
        os.makedirs(options.out, exist_ok=True)
        paths = kind.draw(results, options.out, name)
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
