"""What the tests of plots and of the report share. Exits with 77, skipped, without matplotlib."""

import contextlib
import io
import json
import os
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "bench"))
try:
    import matplotlib  # noqa: F401
except ImportError:
    print("SKIPPED: no matplotlib (Debian package python3-matplotlib)")
    sys.exit(77)
import plot_style  # noqa: E402
import plots  # noqa: E402

plot_style.plt.rcParams["savefig.dpi"] = 40  # what is drawn does not depend on it


def estimate(ms):
    return {"samples_ms": [ms], "summary": {
        "median_ms": ms, "interval_ms": [0.9 * ms, 1.2 * ms], "mean_ms": ms, "deviation_ms": 0,
        "least_ms": ms, "most_ms": ms}}


class FilesTest(unittest.TestCase):
    """Files in a folder of the test's own, and a command that works there."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def put(self, name, content):
        mode, encoding = ("wb", None) if isinstance(content, bytes) else ("w", "utf-8")
        with open(self.path(name), mode, encoding=encoding) as file:
            file.write(content if isinstance(content, (str, bytes)) else json.dumps(content))
        return self.path(name)

    def names(self, folder="."):
        return sorted(os.listdir(self.path(folder)))

    def said_by(self, main, *arguments):
        """Its exit code, and what it wrote on stderr."""
        said = io.StringIO()
        with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
            code = main(list(arguments))
        return code, said.getvalue()


class PlotsTest(FilesTest):
    def run_plots(self, *files, out="plots"):
        return self.said_by(plots.main, *files, "--out", self.path(out))

    def refused(self, parts, *files):
        code, said = self.run_plots(*files)
        self.assertEqual(code, 3, said)
        for part in parts:
            self.assertIn(part, said)
        self.assertFalse(os.path.exists(self.path("plots")) and self.names("plots"))

    def labels(self, name):
        tree = ElementTree.parse(self.path(os.path.join("plots", name)))
        return ["".join(node.itertext()) for node in tree.iter() if node.tag.endswith("}text")]

    def texts(self, name):
        return "\n".join(self.labels(name))
