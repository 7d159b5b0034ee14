"""Names beside points, so that none covers another name or a point."""

import math

import plot_style as style

# Where a name may stand, seen from its point: directions in degrees, distances in points. The first
# that is free is taken.
_ANGLES = (20, 160, -20, -160, 90, -90, 50, 130, -50, -130, 0, 180, 70, 110, -70, -110)
_DISTANCES = (7, 11, 16, 22, 29, 37, 46, 56, 68, 82, 98)
_LEADER_FROM = 12  # farther away a line joins name and point


def _overlap(a, b):
    width = min(a[2], b[2]) - max(a[0], b[0])
    height = min(a[3], b[3]) - max(a[1], b[1])
    return width * height if width > 0 and height > 0 else 0


def _box(x, y, angle, width, height):
    """Of a text whose nearest side or corner is at (x, y), in that direction of its point."""
    along = math.cos(math.radians(angle))
    left = x if along > 0.3 else x - width if along < -0.3 else x - width / 2
    up = math.sin(math.radians(angle))
    bottom = y if up > 0.6 else y - height if up < -0.6 else y - height / 2
    return left, bottom, left + width, bottom + height


def place_labels(axes, points, lines=(), size=7.5):
    """points: (name, x, y, is_bold); lines that names keep off if they can: (x0, y0, x1, y1), along
    an axis; all in the data's units. To be called when the limits of the axes are final."""
    figure = axes.figure
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    pixel = figure.dpi / 72  # of a point
    frame = axes.get_window_extent(renderer)
    places = [axes.transData.transform((x, y)) for _, x, y, _ in points]
    taken = [(x - 4 * pixel, y - 4 * pixel, x + 4 * pixel, y + 4 * pixel) for x, y in places]
    for x0, y0, x1, y1 in lines:
        (a, b), (c, d) = axes.transData.transform(((x0, y0), (x1, y1)))
        taken.append((min(a, c) - pixel, min(b, d) - pixel, max(a, c) + pixel, max(b, d) + pixel))
    # Where points crowd, names are placed last: the others have fewer places to give way to.
    crowd = [sum(math.dist(a, b) < 60 * pixel for b in places) for a in places]
    for k in sorted(range(len(points)), key=lambda i: (not points[i][3], crowd[i], -places[i][0])):
        name, _, _, is_bold = points[k]
        text = axes.text(0, 0, name, fontsize=size, fontweight="bold" if is_bold else "normal")
        extent = text.get_window_extent(renderer)
        text.remove()
        x, y = places[k]
        best = None
        for distance in _DISTANCES:
            for angle in _ANGLES:
                dx = distance * pixel * math.cos(math.radians(angle))
                dy = distance * pixel * math.sin(math.radians(angle))
                box = _box(x + dx, y + dy, angle, extent.width, extent.height)
                outside = (max(0, frame.x0 - box[0]) + max(0, box[2] - frame.x1)
                           + max(0, frame.y0 - box[1]) + max(0, box[3] - frame.y1))
                cost = sum(_overlap(box, other) for other in taken) + 50 * outside
                if best is None or cost < best[0]:
                    best = (cost, distance, angle, box)
            if best[0] == 0:
                break
        _, distance, angle, box = best
        margin = 2 * pixel
        taken.append((box[0] - margin, box[1] - margin, box[2] + margin, box[3] + margin))
        _write(axes, name, (x, y), box, distance > _LEADER_FROM, size, is_bold)


def _write(axes, name, point, box, has_leader, size, is_bold):
    to_data = axes.transData.inverted().transform
    centre = ((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
    axes.annotate(name, to_data(point), xytext=to_data(centre), ha="center", va="center",
                  fontsize=size, fontweight="bold" if is_bold else "normal", zorder=5,
                  bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.6},
                  arrowprops={"arrowstyle": "-", "color": style.GREY, "linewidth": 0.5,
                              "shrinkA": 0, "shrinkB": 3} if has_leader else None)
