"""Files of results: which format and version they say they are, before anything else is read."""

import json


class ResultError(Exception):
    """What was found, where, what is allowed, and what to do."""


def read_file(path, formats):
    """The content of a JSON file whose "format" is a key of `formats` and whose "version" is the
    value there. Raises ResultError for anything else."""
    try:
        with open(path, encoding="utf-8") as file:
            content = json.load(file)
    except OSError as error:
        raise ResultError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ResultError(f"{path}: is not UTF-8, so no JSON") from error
    except json.JSONDecodeError as error:
        raise ResultError(f"{path}: line {error.lineno}, column {error.colno}: is not JSON: "
                          f"{error.msg}") from error
    found = content.get("format") if isinstance(content, dict) else None
    if found not in formats:
        allowed = ", ".join(json.dumps(name) for name in sorted(formats))
        older = "; what an older Facet wrote without a format is to be measured again"
        raise ResultError(f"{path}: found the format {json.dumps(found)}; allowed: {allowed}"
                          f"{older if found is None else ''}")
    version = content.get("version")
    if version != formats[found]:
        raise ResultError(f"{path}: found version {json.dumps(version)} of {found}; allowed: "
                          f"{formats[found]}. Measure again, or plot with the Facet that wrote it")
    return content


def short_commit(commit):
    """As much of a commit as names it, and whether files differed from it."""
    return commit[:12] + ("-modified" if commit.endswith("-modified") else "")


class Node:
    """A value of a file, and where it stands: what is missing or of another type is named."""

    def __init__(self, path, value, place=""):
        self.path, self.value, self.place = path, value, place

    def fail(self, what):
        raise ResultError(f"{self.path}: {self.place or '/'}: {what}")

    def __getitem__(self, key):
        if not isinstance(self.value, dict) or key not in self.value:
            self.fail(f"lacks {json.dumps(key)}")
        return Node(self.path, self.value[key], f"{self.place}/{key}")

    def find(self, key):
        """A member that may be missing, or null: then None."""
        if not isinstance(self.value, dict) or self.value.get(key) is None:
            return None
        return self[key]

    def get(self, kind):
        """The value itself, which must be of that type; an int is a float, too."""
        fits = isinstance(self.value, kind) or (kind is float and isinstance(self.value, int))
        if not fits or (kind is not bool and isinstance(self.value, bool)):
            self.fail(f"found {json.dumps(self.value)[:60]}; allowed: {kind.__name__}")
        return self.value

    def items(self):
        return [Node(self.path, item, f"{self.place}/{i}") for i, item in enumerate(self.get(list))]

    def pair(self):
        ends = [node.get(float) for node in self.items()]
        if len(ends) != 2:
            self.fail(f"found {len(ends)} numbers; allowed: 2")
        return tuple(ends)
