#!/usr/bin/env python3
"""Walks of the human down, on the level and up: what each costs, and a picture of each.

   three_slopes.py [--model human29] [--preset human] [--out DIR]

Needs a server (ROLLGAIT_SERVER, default 127.0.0.1:50051).
"""
import argparse
import pathlib

import rollgait

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--model", default="human29")
parser.add_argument("--preset", default="human")
parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
options = parser.parse_args()

gaits = rollgait.sweep([-10, 0, 10], options.model, preset=options.preset, speed_m_s=1.3)
print("slope  objective  step, m  double support, %  verdict")
for slope, gait in gaits.items():
    double = 100 * gait.solve.result.gait_events.double_support_fraction
    print(f"{slope:4g}°  {gait.objective:9.5f}  {gait.step_length_m:7.3f}  {double:17.1f}  {gait.verdict}")
    gait.plot(options.out / f"gait_{slope:+d}.png")
    gait.stride().to_csv(options.out / f"gait_{slope:+d}.csv")
