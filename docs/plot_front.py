#!/usr/bin/env python3
"""Draws legs from the front while one swings past the other, from files that `rollgait solve --output FILE.json` wrote.

    docs/plot_front.py TITLE=FILE.json … > picture.svg

One panel a file: the bodies of SolveResult.model (ellipsoids) at the instant at which the swinging shank passes the standing one.
Kinematics are its own: joints of the model, positions at the nodes. Standard library only.
"""
import json
import math
import sys

from plot_ball import apply, product, rotation, turn, vector

WIDTH, HEIGHT, PAD, SCALE = 190, 330, 26, 290  # SCALE: px a metre
COLORS = {"left": "#1b6ca8", "right": "#c8553d"}


def poses(model, positions):
    """World pose of every link: (rotation, origin)."""
    links = []
    for joint, position in zip(model["joints"], positions):
        parent = joint.get("parent", 0)
        attitude, place = links[parent] if parent >= 0 else (rotation(dict(w=1)), [0.0, 0.0, 0.0])
        place = [p + o for p, o in zip(place, apply(attitude, vector(joint.get("originM", {}))))]
        attitude = product(attitude, rotation(joint["orientation"]))
        axis = vector(joint["axis"])
        if joint["type"] == "TYPE_PRISMATIC":
            place = [p + position * a for p, a in zip(place, apply(attitude, axis))]
        else:
            attitude = product(attitude, turn(axis, position))
        links.append((attitude, place))
    return links


def body_pose(links, body):
    attitude, place = links[body.get("joint", 0)]
    center = [p + o for p, o in zip(place, apply(attitude, vector(body.get("centerM", {}))))]
    return product(attitude, rotation(body["orientation"])), center


def outline(attitude, center, semi_axes):
    """The outline of an ellipsoid seen along x, as points (y, z): its image is an ellipse with the matrix P = (R B Rᵀ)_yz."""
    p = [[sum(attitude[i][k] * attitude[j][k] * semi_axes[k] ** 2 for k in range(3)) for j in (1, 2)] for i in (1, 2)]
    points = []
    for step in range(48):
        u = (math.cos(math.tau * step / 48), math.sin(math.tau * step / 48))
        pu = [p[0][0] * u[0] + p[0][1] * u[1], p[1][0] * u[0] + p[1][1] * u[1]]
        length = math.sqrt(u[0] * pu[0] + u[1] * pu[1])  # support function
        points.append((center[1] + pu[0] / length, center[2] + pu[1] / length))
    return points


def passing(result):
    """Node positions where the two shanks are closest along x."""
    model = result["model"]
    shanks = [body for body in model["bodies"] if body["name"].endswith("shank")]
    best = None
    for phase in result["trajectory"]["phases"]:
        matrix = phase["nodePositions"]
        n = matrix["columns"]
        for k in range(matrix["rows"]):
            row = matrix["values"][k * n:(k + 1) * n]
            links = poses(model, row)
            x = [body_pose(links, shank)[1][0] for shank in shanks]
            if best is None or abs(x[0] - x[1]) < best[0]:
                best = (abs(x[0] - x[1]), links)
    return best[1]


def panel(index, title, solve):
    result = solve["result"]
    links = passing(result)
    bodies = [body for body in result["model"]["bodies"] if "arm" not in body["name"] and "hand" not in body["name"]]
    placed = [(body, *body_pose(links, body)) for body in bodies]
    middle = sum(center[1] for _, _, center in placed) / len(placed)
    shapes = []
    for body, attitude, center in sorted(placed, key=lambda entry: -entry[2][0]):  # the farthest forward is behind, seen from the back
        points = outline(attitude, center, vector(body["surface"]["ellipsoid"]["semiAxesM"]))
        text = " ".join(f"{WIDTH / 2 - SCALE * (y - middle):.1f},{HEIGHT - PAD - SCALE * z:.1f}" for y, z in points)
        color = COLORS[body["name"].split("_")[0]]
        shapes.append(f'<polygon points="{text}" fill="{color}" fill-opacity="0.35" stroke="{color}"/>')
    ground = f'<line x1="6" x2="{WIDTH - 6}" y1="{HEIGHT - PAD}" y2="{HEIGHT - PAD}" stroke="#888"/>'
    label = f'<text x="{WIDTH / 2}" y="{HEIGHT - 8}" text-anchor="middle">{title}</text>'
    return f'<g transform="translate({index * WIDTH},0)">{ground}{"".join(shapes)}{label}</g>'


def main():
    files = [argument.split("=", 1) for argument in sys.argv[1:]]
    if not files or any(len(pair) != 2 for pair in files):
        sys.exit(__doc__)
    panels = []
    for index, (title, name) in enumerate(files):
        with open(name, encoding="utf-8") as file:
            panels.append(panel(index, title, json.load(file)))
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH * len(files)} {HEIGHT}" font-family="sans-serif" '
          f'font-size="14"><rect width="100%" height="100%" fill="#fff"/>{"".join(panels)}</svg>')


if __name__ == "__main__":
    main()
