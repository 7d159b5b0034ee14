#!/usr/bin/env python3
"""Whether a second run of a sweep agrees with the first, by the sweeps' own intervals.

    bench/agreement.py FIRST.json SECOND.json

Two results of `facet sweep`, of the same scenes, pictures and kernels on the same device. An estimate
agrees if its two intervals overlap: said of the serial reference, of the shape 1x1 and of the first
run's fastest, and counted over all shapes. Exit codes: 0 done, 3 files that cannot be compared.
"""

import sys

from results_file import ResultError
from sweep_results import read_sweep, together


def overlap(a, b):
    return a.low <= b.high and b.low <= a.high


def line(what, unit, digits, a, b):
    def text(e):
        return f"{e.value:.{digits}f} [{e.low:.{digits}f}, {e.high:.{digits}f}]"
    return (f"  {what:<16} {unit:<9} {text(a):<28} {text(b):<28} {b.value / a.value - 1:+6.1%}  "
            f"{'agrees' if overlap(a, b) else 'does not agree'}")


def compare(first, second):
    """Lines of text on one experiment of two runs."""
    there = {s.name: s for s in second.drawn()}
    both = [(s, there[s.name]) for s in first.drawn() if s.name in there]
    lines = [first.title]
    if first.serial_ms and second.serial_ms:
        lines.append(line("serial", "ms", 2, first.serial_ms, second.serial_ms))
    fastest = min(both, key=lambda pair: pair[0].kernel_ms.value)
    for a, b in [pair for pair in both if pair[0].name == "1x1"] + [fastest]:
        lines.append(line(a.name, "ms", 4, a.kernel_ms, b.kernel_ms))
        if a.speed_up and b.speed_up:
            lines.append(line("", "speed-up", 1, a.speed_up, b.speed_up))
    times = sum(overlap(a.kernel_ms, b.kernel_ms) for a, b in both)
    ratios = [(a.speed_up, b.speed_up) for a, b in both if a.speed_up and b.speed_up]
    change = sorted(abs(b.kernel_ms.value / a.kernel_ms.value - 1) for a, b in both)
    lines.append(f"  of {len(both)} shapes, {times} agree in time and "
                 f"{sum(overlap(*pair) for pair in ratios)} in speed-up; times differ by "
                 f"{change[len(change) // 2]:.1%} in the median, {change[-1]:.1%} at most")
    best = [{s.name for s in e.shapes if s.is_best} for e in (first, second)]
    lines.append(f"  best: {len(best[0])} shapes, then {len(best[1])}; in both: "
                 f"{', '.join(sorted(best[0] & best[1])) or 'none'}")
    return lines


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        results = [read_sweep(path) for path in arguments]
        if results[0].device != results[1].device:
            raise ResultError(f"{arguments[1]}: was measured on {results[1].device}, and {arguments[0]} "
                              f"on {results[0].device}; a second run is one on the same device")
        for name in results[0].experiments:
            print("\n".join(compare(*together(results, name))))
    except ResultError as error:
        print(f"agreement.py: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
