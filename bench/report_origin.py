"""Where results come from: what every file says of itself, whatever it holds."""

from report_page import stem, table
from results_file import short_commit

UNKNOWN = "not recorded"

COLUMNS = ("file", "format", "device", "platform, driver", "CPU", "measured", "Facet", "~options")


def _words(value):
    """A setting in few words; long lists are counted."""
    if isinstance(value, dict):
        return ", ".join(f"{key} {_words(v)}" for key, v in value.items())
    if isinstance(value, list):
        return " ".join(_words(v) for v in value) if len(value) <= 9 else f"{len(value)} values"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _text(node, key):
    found = node.find(key) if node else None
    return found.get(str) if found else UNKNOWN


def _options(root):
    settings = dict(root["settings"].get(dict)) if root.find("settings") else {}
    for key in ("rays", "seed"):  # facet-accuracy has them beside the cases
        if found := root.find(key):
            settings[key] = found.get(int)
    if found := root.find("peer"):
        settings["peer"] = found.get(dict)
    parts = [f"{key.replace('_', ' ')}: {_words(value)}" for key, value in settings.items()]
    # Of a sweep's experiments, each as the compiler got them.
    for flags in dict.fromkeys(e["kernel"]["options"].get(str) for e in
                               (root["experiments"].items() if root.find("experiments") else [])):
        parts.append(f"compiled with {flags.strip()}")
    if root.find("complete") and not root["complete"].get(bool):
        parts.append("INTERRUPTED: not complete")
    return "; ".join(parts)


def _row(root):
    device = root.find("device")
    if device and isinstance(device.value, str):  # facet-accuracy names it alone
        name, facts = device.value, root
    else:
        name, facts = (_text(device, "name"), device) if device else ("none takes part", None)
    facet = root.find("facet")
    if facet and isinstance(facet.value, dict):
        built = f"{_text(facet, 'version')}, commit {short_commit(_text(facet, 'commit'))}"
    else:
        built = f"{_text(root, 'facet')}, commit {UNKNOWN}"
    where = f"{_text(facts, 'platform')}, {_text(facts, 'driver')}" if facts else "\N{EN DASH}"
    return (stem(root.path), f"{_text(root, 'format')} {root['version'].get(int)}", name, where,
            _text(root, "cpu"), _text(root, "date"), built, _options(root))


def origins(roots):
    """A table with a row for each file."""
    return table("Each file of results: device and driver as they report themselves, the date in UTC, "
                 "and the options that it was measured with", COLUMNS, [_row(r) for r in roots])


def label(root):
    """A heading for what is of one file."""
    row = _row(root)
    return f"{row[2]} ({row[0]})" if root.find("device") else f"{row[4]} ({row[0]})"
