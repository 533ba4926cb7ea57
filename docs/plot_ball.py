#!/usr/bin/env python3
"""Draws where a rolling body touches the ground, from files that `rollgait solve --output FILE.json` wrote.

    docs/plot_ball.py TITLE=FILE.json … > picture.svg

Its kinematics are its own: joints of SolveResult.model, positions at the collocation points. Standard library only.
"""
import json
import math
import sys

SIZE, PAD, COLORS = 250, 34, ("#1b6ca8", "#c8553d", "#3a7d44", "#7b4fa3")


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def apply(a, v):
    return [sum(a[i][k] * v[k] for k in range(3)) for i in range(3)]


def vector(message):
    return [message.get(key, 0) for key in "xyz"]


def rotation(q):
    w, x, y, z = (q.get(key, 0) for key in "wxyz")
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def turn(axis, angle):
    half = angle / 2
    s = math.sin(half)
    return rotation(dict(w=math.cos(half), x=s * axis[0], y=s * axis[1], z=s * axis[2]))


def contact_point(model, positions):
    attitude, place = rotation(dict(w=1)), [0.0, 0.0, 0.0]
    for joint, position in zip(model["joints"], positions):
        attitude = product(attitude, rotation(joint["orientation"]))
        axis = vector(joint["axis"])
        if joint["type"] == "TYPE_PRISMATIC":
            place = [p + position * a for p, a in zip(place, apply(attitude, axis))]
        else:
            attitude = product(attitude, turn(axis, position))
    surface = model["contacts"][0]
    attitude = product(attitude, rotation(surface["orientation"]))
    axes = vector(surface["surface"]["ellipsoid"]["semiAxesM"])
    down = [axes[k] * attitude[2][k] for k in range(3)]
    length = math.sqrt(sum(d * d for d in down))
    offset = apply(attitude, [axes[k] * down[k] / length for k in range(3)])
    return place[0] - offset[0], place[1] - offset[1]


def path(solve):
    phase = solve["result"]["trajectory"]["phases"][0]
    points = []
    for name in ("nodePositions", "pointPositions"):
        matrix = phase[name]
        n = matrix["columns"]
        times = phase["nodeTimesS" if name == "nodePositions" else "pointTimesS"]
        rows = [matrix["values"][k * n:(k + 1) * n] for k in range(matrix["rows"])]
        points += [(time, contact_point(solve["result"]["model"], row)) for time, row in zip(times, rows)]
    return [place for _, place in sorted(points)]


def panel(index, title, solve):
    points = path(solve)
    low = [min(p[i] for p in points) for i in (0, 1)]
    high = [max(p[i] for p in points) for i in (0, 1)]
    reach = max(high[0] - low[0], high[1] - low[1], 1e-6)
    scale = SIZE / reach
    left = index * (SIZE + 2 * PAD) + PAD

    def at(p):
        return (left + SIZE / 2 + (p[0] - (low[0] + high[0]) / 2) * scale,
                PAD + SIZE / 2 - (p[1] - (low[1] + high[1]) / 2) * scale)

    color = COLORS[index % len(COLORS)]
    line = " ".join("%.1f,%.1f" % at(p) for p in points)
    start, end = at(points[0]), at(points[-1])
    rule = 10 ** math.floor(math.log10(reach / 2))
    base = SIZE + 2 * PAD + 8
    return [
        f'<polyline points="{line}" fill="none" stroke="{color}" stroke-width="2"/>',
        f'<circle cx="{start[0]:.1f}" cy="{start[1]:.1f}" r="5" fill="white" stroke="{color}" stroke-width="2"/>',
        f'<circle cx="{end[0]:.1f}" cy="{end[1]:.1f}" r="3" fill="{color}"/>',
        f'<line x1="{left}" x2="{left + rule * scale:.1f}" y1="{base}" y2="{base}" stroke="black"/>',
        f'<text x="{left}" y="{base + 16}">{rule:g} m</text>',
        f'<text x="{left}" y="18" font-weight="bold">{title}</text>']


def main():
    cases = [argument.partition("=") for argument in sys.argv[1:]]
    if not cases or not all(file for _, _, file in cases):
        sys.exit(__doc__)
    body = []
    for index, (title, _, file) in enumerate(cases):
        with open(file, encoding="utf-8") as handle:
            body += panel(index, title, json.load(handle))
    width, height = len(cases) * (SIZE + 2 * PAD), SIZE + 2 * PAD + 34
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" '
          f'font-family="sans-serif" font-size="13"><rect width="100%" height="100%" fill="white"/>')
    print("\n".join(body) + "\n</svg>")


if __name__ == "__main__":
    main()
