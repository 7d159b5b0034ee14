"""The report's HTML: one page with everything in it, which asks nothing of the network. Whatever
comes from a file passes through `text`."""

import base64
import html
import os
import re

from results_file import ResultError

# Colours are light or dark as the reader's system is; print is dark on white. Plots and pictures
# stand on white in either.
STYLE = """
:root { color-scheme: light dark; --ink: #1a1a1a; --paper: #ffffff; --faint: #5c5c5c; --line: #c9c9c9;
  --band: #f3f3f3; --link: #0058a3; }
@media (prefers-color-scheme: dark) { :root { --ink: #e8e8e8; --paper: #16181a; --faint: #a9a9a9;
  --line: #484848; --band: #212427; --link: #7cc0ff; } }
body { margin: 0 auto; padding: 1rem 1.5rem 3rem; max-width: 70rem; color: var(--ink);
  background: var(--paper); font: 1rem/1.5 system-ui, sans-serif; }
h1 { font-size: 1.8rem; }
h2 { font-size: 1.4rem; margin-top: 2.5rem; border-bottom: 2px solid var(--line); }
h3 { font-size: 1.1rem; margin-top: 2rem; }
a { color: var(--link); }
p.note, figcaption { color: var(--faint); font-size: 0.9rem; }
.wide { overflow-x: auto; margin: 1rem 0; }
table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: var(--faint); padding-bottom: 0.3rem; }
th, td { padding: 0.2rem 0.6rem; border-bottom: 1px solid var(--line); text-align: left;
  vertical-align: top; }
thead th { border-bottom: 2px solid var(--line); vertical-align: bottom; }
tbody th { font-weight: 600; }
tbody tr:nth-child(even) { background: var(--band); }
td.number, th.number { text-align: right; }
th.prose { min-width: 13rem; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(28rem, 100%), 1fr));
  gap: 1rem; align-items: start; }
figure { margin: 1.2rem 0; }
figure img { display: block; max-width: 100%; height: auto; background: #ffffff; }
@media print {
  :root { --ink: #000000; --paper: #ffffff; --faint: #404040; --line: #909090; --band: #ffffff;
    --link: #000000; }
  body { max-width: none; padding: 0; font-size: 9.5pt; }
  nav { display: none; } .wide { overflow: visible; } table { font-size: 7.5pt; }
  thead { display: table-header-group; } tr, figure { break-inside: avoid; }
  h2, h3, caption { break-after: avoid; } figure img { max-height: 24cm; }
}
"""

# A browser is told to load nothing: no script, no font, no address, and pictures from the page alone.
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


def text(value):
    """As it reads, with no meaning in HTML; what no page may hold becomes U+FFFD."""
    plain = str(value).encode("utf-8", "replace").decode("utf-8")
    return html.escape(re.sub(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]", "\ufffd", plain), quote=True)


def number(value):
    """With three or more significant digits and no exponent that a reader need think of."""
    if value is None:
        return "\N{EN DASH}"
    if isinstance(value, int) or abs(value) >= 1000:
        return f"{value:,.0f}"
    return f"{value:.3g}" if value == 0 or abs(value) >= 1e-4 else f"{value:.2e}"


def spread(estimate, show=number):
    """A median and its interval."""
    if estimate is None:
        return "\N{EN DASH}"
    return f"{show(estimate.value)} {ends(show(estimate.low), show(estimate.high))}"


def ends(low, high):
    """In brackets, never broken across lines."""
    return f"({low}\N{WORD JOINER}\N{EN DASH}\N{WORD JOINER}{high})"


def heading(title, anchor=None):
    return f"<h2 id=\"{text(anchor)}\">{text(title)}</h2>" if anchor else f"<h3>{text(title)}</h3>"


def note(words):
    return f"<p class=\"note\">{text(words)}</p>"


KINDS_OF_COLUMNS = {"#": " class=\"number\"", "~": " class=\"prose\""}


def table(caption, columns, rows):
    """Columns whose names begin with # hold numbers, to the right, and those with ~ prose; the first
    cell of a row is its head."""
    kinds = [KINDS_OF_COLUMNS.get(c[0], "") for c in columns]
    head = "".join(f"<th scope=\"col\"{kind}>{text(c.lstrip('#~'))}</th>"
                   for c, kind in zip(columns, kinds))
    body = []
    for row in rows:
        cells = [f"<th scope=\"row\"{kinds[0]}>{text(row[0])}</th>"]
        cells += [f"<td{kind}>{text(cell)}</td>" for cell, kind in zip(row[1:], kinds[1:])]
        body.append("<tr>" + "".join(cells) + "</tr>")
    return (f"<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"{text(caption)}\">"
            f"<table><caption>{text(caption)}</caption><thead><tr>{head}</tr></thead>\n<tbody>"
            + "\n".join(body) + "</tbody></table></div>")


# How a file begins, and its type.
SIGNATURES = {b"\x89PNG\r\n\x1a\n": "image/png", b"<?xml": "image/svg+xml"}


def image(path, alternative, caption):
    """A PNG or SVG file, within the page. Raises ResultError if it is neither, or cannot be read."""
    try:
        with open(path, "rb") as file:
            content = file.read()
    except OSError as error:
        raise ResultError(f"{path}: cannot be read: {error.strerror}") from error
    kind = next((k for start, k in SIGNATURES.items() if content.startswith(start)), None)
    if kind is None:
        raise ResultError(f"{path}: is no picture that a report can hold; allowed: PNG, SVG")
    data = base64.b64encode(content).decode("ascii")
    return (f"<figure><img alt=\"{text(alternative)}\" src=\"data:{kind};base64,{data}\">"
            f"<figcaption>{text(caption)}</figcaption></figure>")


def gallery(figures):
    """Side by side where there is room."""
    return f"<div class=\"plots\">{''.join(figures)}</div>" if figures else ""


def page(title, sections):
    """sections: (anchor, title, blocks of HTML)."""
    contents = "".join(f"<li><a href=\"#{text(anchor)}\">{text(name)}</a></li>"
                       for anchor, name, _ in sections)
    body = "\n".join(f"<section aria-labelledby=\"{text(anchor)}\">\n{heading(name, anchor)}\n"
                     + "\n".join(blocks) + "\n</section>" for anchor, name, blocks in sections)
    return (f"<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
            f"<meta http-equiv=\"Content-Security-Policy\" content=\"{text(POLICY)}\">\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
            f"<title>{text(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
            f"<header><h1>{text(title)}</h1></header>\n<nav aria-label=\"Contents\"><ul>{contents}"
            f"</ul></nav>\n<main>\n{body}\n</main>\n</body>\n</html>\n")


def stem(path):
    return os.path.splitext(os.path.basename(path))[0]
