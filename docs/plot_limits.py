#!/usr/bin/env python3
"""Draws the pictures of docs/explanation/numerical_limits.md from what bench/numerical_limits, dynamics_limits and
long_rolling print.

    numerical_limits > limits.csv && python3 docs/plot_limits.py limits.csv docs/images

Several files may be given; what they hold is drawn.
"""
import csv
import math
import sys

# name: (title, x axis, logarithmic x)
PLOTS = {
    "axis_ratio": ("Ellipsoid: relative error against axis ratio", "largest / smallest semi-axis", True),
    "pairs": ("Two ellipsoids in touch: error against axis ratio", "largest / smallest semi-axis", True),
    "size": ("Ellipsoid: relative error against size", "largest semi-axis (m)", True),
    "gap": ("Gap: absolute error against distance from the origin", "distance of the body from the plane's point (m)", True),
    "speed": ("Velocity over the surface: relative error against spin", "spin about the normal / other turning", True),
    "exponent": ("Superellipsoid: relative error against exponent", "exponent", False),
}
PLOTS.update({
    "body_ratio": ("Rolling ellipsoid: error against shape", "largest / smallest semi-axis", True),
    "body_speed": ("Rolling ellipsoid: error against angular speed", "angular speed (rad/s)", True),
    "mass_ratio": ("Two links: error against mass of the second over the first", "mass ratio", True),
    "feet_in_line": ("Three feet, one off the line of the others", "distance from the line (m)", True),
    "feet_off_balance": ("Three feet, one off the line of the others, weight beside it", "distance from the line (m)", True),
    "long_energy": ("Long runs, tolerance 1e-12: energy drift (relative)", "revolutions", True),
    "long_gap": ("Long runs, tolerance 1e-12: gap (m)", "revolutions", True),
})
DRAWN = {"long_energy": "1e-12", "long_gap": "1e-12"}  # only series whose name holds this
COLOURS = ["#1b6ca8", "#c1440e", "#2e8b57", "#7a4f9a", "#b8860b", "#555555"]
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 360, 70, 20, 36, 50


def draw(title, label, logarithmic, series):
    xs = [x for points in series.values() for x, _ in points]
    ys = [y for points in series.values() for _, y in points]
    place = (lambda x: math.log10(x)) if logarithmic else (lambda x: x)
    x_low, x_high = place(min(xs)), place(max(xs))
    y_low, y_high = math.floor(math.log10(min(ys))), math.ceil(math.log10(max(ys)))
    y_high = max(y_high, y_low + 2)
    to_x = lambda x: LEFT + (place(x) - x_low) / (x_high - x_low) * (WIDTH - LEFT - RIGHT)
    to_y = lambda y: HEIGHT - BOTTOM - (math.log10(y) - y_low) / (y_high - y_low) * (HEIGHT - TOP - BOTTOM)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" '
           f'font-size="12"><rect width="100%" height="100%" fill="white"/>',
           f'<text x="{LEFT}" y="20" font-size="14">{title}</text>']
    for power in range(y_low, y_high + 1, max(1, (y_high - y_low) // 8)):
        y = to_y(10.0 ** power)
        out.append(f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>'
                   f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">1e{power}</text>')
    decades = range(math.ceil(x_low - 1e-9), math.floor(x_high + 1e-9) + 1)
    ticks = [10.0 ** k for k in decades] if logarithmic else sorted(set(xs))
    ticks = ticks[::max(1, len(ticks) // 7)]
    for x in ticks:
        text = f"1e{round(math.log10(x))}" if logarithmic else f"{x:g}"
        out.append(f'<text x="{to_x(x):.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{text}</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 10}" text-anchor="middle">{label}</text>')
    # The legend stands on the side where fewer points are behind it.
    behind = [0, 0]
    for x, y in (point for points in series.values() for point in points):
        if to_y(y) < TOP + 16 * (len(series) + 1):
            behind[to_x(x) > (LEFT + WIDTH - RIGHT) / 2] += 1
    legend_x, anchor = (LEFT + 10, "start") if behind[0] <= behind[1] else (WIDTH - RIGHT - 10, "end")
    for index, (name, points) in enumerate(series.items()):
        colour = COLOURS[index % len(COLOURS)]
        path = " ".join(f"{to_x(x):.1f},{to_y(y):.1f}" for x, y in points)
        text = name.replace("<", "&lt;")
        out.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>'
                   f'<text x="{legend_x}" y="{TOP + 14 + 16 * index}" text-anchor="{anchor}" '
                   f'fill="{colour}">{text}</text>')
    out.append("</svg>")
    return "\n".join(out) + "\n"


def main():
    data = {}
    for path in sys.argv[1:-1]:
        with open(path, newline="") as file:
            for row in csv.DictReader(file):
                series = data.setdefault(row["plot"], {}).setdefault(row["series"], [])
                series.append((float(row["x"]), max(float(row["y"]), 1e-18)))
    for name, (title, label, logarithmic) in PLOTS.items():
        shown = {key: points for key, points in data.get(name, {}).items() if DRAWN.get(name, "") in key}
        if not shown:
            continue
        with open(f"{sys.argv[-1]}/limits_{name}.svg", "w") as file:
            file.write(draw(title, label, logarithmic, shown))


main()
