"""What all studies' results hold alike: measured times, and where a result comes from."""

from dataclasses import dataclass


@dataclass
class Estimate:
    """A median, or a ratio of medians, and the ends of its interval."""

    value: float
    low: float
    high: float


def median_of(times):
    """In milliseconds."""
    summary = times["summary"]
    return Estimate(summary["median_ms"].get(float), *summary["interval_ms"].pair())


def median_if_any(times):
    """The same; None without samples."""
    return median_of(times) if times.find("summary") else None


@dataclass
class Origin:
    """Of a result: its file, what it was measured on, and how often."""

    path: str
    device: str
    driver: str
    cpu: str
    date: str
    commit: str
    complete: bool
    repeats: int
    level: float  # of intervals


def origin_of(path, root):
    """The members of Origin, by name. Raises ResultError where one is missing."""
    device, settings = root["device"], root["settings"]
    return {
        "path": path,
        "device": device["name"].get(str),
        "driver": device["driver"].get(str),
        "cpu": root["cpu"].get(str),
        "date": root["date"].get(str),
        "commit": root["facet"]["commit"].get(str),
        "complete": root["complete"].get(bool),
        "repeats": settings["repeats"].get(int),
        "level": settings["bootstrap"]["level"].get(float)}
