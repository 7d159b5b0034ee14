#!/usr/bin/env python3
"""A report: results and pictures as one HTML file, which needs no network, no script and no other
file.

    bench/report.py RESULT.json... [--pictures PICTURE.png...] [--title TITLE] --out REPORT.html

Takes what `facet sweep`, `facet accuracy`, `facet info --tree` and the rows of facet_bench write, in any order. Needs
Python 3.10 and matplotlib (Debian: python3-matplotlib). Exit codes are those of facet: 0 done, 2
usage, 3 a file that cannot be told of, 6 output.
"""

import argparse
import os
import sys
import tempfile

import report_benches
import report_pictures
import report_studies
from report_origin import label, origins
from report_page import heading, image, page
from results_file import Node, ResultError, read_file
from whole_file import whole_file

# format: (version, anchor, title, blocks of a file). Sections stand in this order.
SECTIONS = {
    "facet-sweep": (1, "work-groups", "Which work-group is fastest", report_studies.sweep),
    "facet-variants": (1, "variants", "Speed against error", report_studies.variants),
    "facet-growth": (1, "growth", "Growth with triangles", report_studies.growth),
    "facet-accuracy": (1, "hard-cases", "Hard cases", report_benches.accuracy),
    "facet-bench-exactness": (1, "exactness", "What exactness costs", report_benches.exactness),
    "facet-bench-trace": (1, "tracing", "Tracing, beside a peer", report_benches.trace),
    "facet-bench-build": (1, "building", "Building trees, beside a peer", report_benches.build),
    "facet-trees": (1, "trees", "How good trees are", report_benches.trees),
    "facet-bench-pictures": (1, "whole-pictures", "Whole pictures", report_benches.pictures),
    "facet-bench-render": (1, "pictures-by-way", "Whole pictures, by several ways", report_pictures.render),
    "facet-bench-sort": (1, "sorting", "Sorting, beside peers", report_benches.sort),
    "facet-bench-fold": (1, "folding", "Folding", report_benches.fold),
    "facet-bench-move": (1, "moving", "Scenes that move", report_benches.move),
    "facet-bench-reference": (1, "reference", "The serial reference, beside a peer",
                              report_benches.reference),
}


def report(results, pictures, title):
    """The page. Raises ResultError for a file of another format or version, or that lacks something,
    and for a picture that is none."""
    versions = {name: row[0] for name, row in SECTIONS.items()}
    roots = [Node(path, read_file(path, versions)) for path in results]
    sections = [("origins", "What was measured, and on what", [origins(roots)])]
    if pictures:
        sections.append(("pictures", "Pictures", [
            image(path, f"Picture {os.path.basename(path)}", os.path.basename(path))
            for path in pictures]))
    for name, (_, anchor, heading_of, blocks_of) in SECTIONS.items():
        blocks = []
        for root in roots:
            if root["format"].get(str) == name:
                with tempfile.TemporaryDirectory() as folder:
                    blocks += [heading(label(root)), *blocks_of(root, folder)]
        if blocks:
            sections.append((anchor, heading_of, blocks))
    return page(title, sections)


def main(arguments):
    parser = argparse.ArgumentParser(
        description="Makes one HTML file of results and pictures, readable offline.")
    parser.add_argument("results", nargs="+", metavar="RESULT.json",
                        help="of facet sweep, facet accuracy, facet info --tree and facet_bench")
    parser.add_argument("--pictures", nargs="+", default=[], metavar="PICTURE.png",
                        help="PNG or SVG, shown in this order")
    parser.add_argument("--title", default="Facet: results", help="(default: Facet: results)")
    parser.add_argument("--out", required=True, metavar="REPORT.html", help="where the report goes")
    options = parser.parse_args(arguments)
    for path in options.results + options.pictures:
        if os.path.realpath(path) == os.path.realpath(options.out):
            parser.error(f"--out {options.out} is {path}, which would be lost; name another file")
    try:
        content = report(options.results, options.pictures, options.title)
    except ResultError as error:
        print(f"report.py: {error}", file=sys.stderr)
        return 3
    except ImportError as error:
        print(f"report.py: {error}; install Debian's python3-matplotlib", file=sys.stderr)
        return 2
    try:
        with whole_file(options.out) as partial, open(partial, "w", encoding="utf-8") as file:
            file.write(content)
    except OSError as error:
        print(f"report.py: {options.out}: cannot be written: {error.strerror}", file=sys.stderr)
        return 6
    print(options.out)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
