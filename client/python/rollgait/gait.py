"""A solved gait as numpy arrays."""
from __future__ import annotations

import csv
import dataclasses
import math
import os
from typing import Dict, Iterator, List, Optional, Union

import numpy as np

from rollgait.v1 import accuracy_pb2, gait_events_pb2, solve_pb2, solve_spec_pb2

_LARGEST_FILE = 256 << 20  # bytes


def _matrix(message) -> np.ndarray:
    return np.array(message.values, dtype=float).reshape(message.rows, message.columns)


@dataclasses.dataclass(frozen=True)
class Criterion:
    """One line of the verdict: the largest measure, its bound (None: not judged), both in `unit`, and where it was found."""
    name: str
    value: float
    bound: Optional[float]
    unit: str
    meaning: str
    where: str
    time_s: float
    exceeded: bool


class Stride:
    """A whole stride from right heel strike on, as a table: columns by name, rows at equal shares of the cycle.

    Columns: "percent", "time_s"; every joint's position under its name ("knee_r"), velocity ("knee_r.velocity") and, where it
    is actuated, effort ("knee_r.effort"); forces of the ground on each foot in N ("right.force_x" …). SI units, radians.
    """

    def __init__(self, columns: Dict[str, np.ndarray]):
        self._columns = columns

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"no column {name!r}; there are {', '.join(self._columns)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns["percent"])

    @property
    def columns(self) -> List[str]:
        return list(self._columns)

    def to_csv(self, path: Union[str, os.PathLike]) -> None:
        """One row for each instant, with a head line. Numbers are written so that they read back as they are."""
        with open(path, "w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(self._columns)
            writer.writerows(zip(*[[repr(float(v)) for v in column] for column in self._columns.values()]))

    def to_pandas(self):
        """The table as a pandas.DataFrame."""
        import pandas
        return pandas.DataFrame(self._columns)


class Gait:
    """What a solve found. `solve` is the whole message rollgait.v1.Solve; everything here is read from it."""

    def __init__(self, solve: solve_pb2.Solve):
        self.solve = solve
        self.name: str = solve.name
        result = solve.result
        self.message: str = result.message
        self.termination: str = solve_pb2.Termination.Name(result.termination)[len("TERMINATION_"):].lower()
        self.objective: float = result.objective
        self.costs: Dict[str, float] = {cost.name: cost.contribution for cost in result.costs}
        self.speed_m_s: float = result.speed_m_s
        self.step_length_m: float = result.step_length_m
        self.slope_rad: float = solve.spec.slope_rad
        self.iterations: int = sum(mesh.iterations for mesh in result.meshes)
        trajectory = result.trajectory
        self.joints: List[str] = list(trajectory.joint_names)
        self.actuated_joints: List[str] = list(trajectory.actuated_joint_names)
        self.duration_s: float = trajectory.duration_s
        self.displacement_m: float = trajectory.displacement_m
        phases = trajectory.phases
        # Nodes that end one phase and begin the next are given once for each: velocities may jump there.
        self.times_s = np.concatenate([np.array(p.node_times_s) for p in phases])
        self.positions = np.vstack([_matrix(p.node_positions) for p in phases])
        self.velocities = np.vstack([_matrix(p.node_velocities) for p in phases])
        self.point_times_s = np.concatenate([np.array(p.point_times_s) for p in phases])
        self.point_positions = np.vstack([_matrix(p.point_positions) for p in phases])
        self.point_velocities = np.vstack([_matrix(p.point_velocities) for p in phases])
        self.accelerations = np.vstack([_matrix(p.point_accelerations) for p in phases])
        self.efforts = np.vstack([_matrix(p.point_efforts) for p in phases])

    @classmethod
    def from_json(cls, path: Union[str, os.PathLike]) -> "Gait":
        """The gait in a file of `to_json`, `rollgait solve --output` or `rollgait sweep --output`. ValueError: the file holds none."""
        from google.protobuf import json_format
        size = os.path.getsize(path)
        if size > _LARGEST_FILE:
            raise ValueError(f"{os.fspath(path)}: size {size} bytes, must be at most {_LARGEST_FILE}")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        try:
            solve = json_format.Parse(text, solve_pb2.Solve())
        except json_format.ParseError as error:
            raise ValueError(f"{os.fspath(path)} holds no solve: {error}") from None
        if not solve.result.trajectory.phases:
            raise ValueError(f"{os.fspath(path)}: the solve {solve.name} has no trajectory")
        return cls(solve)

    def __repr__(self) -> str:
        return (f"<Gait {self.name}: {self.termination}, {self.verdict}, objective {self.objective:.6g}, "
                f"{self.speed_m_s:.3g} m/s, step {self.step_length_m:.3g} m>")

    @property
    def verdict(self) -> str:
        """"within", "exceeded" or "not judged"."""
        name = accuracy_pb2.Verdict.Name(self.solve.result.accuracy.verdict)[len("VERDICT_"):].lower().replace("_", " ")
        return "not judged" if name == "unspecified" else name

    @property
    def is_within(self) -> bool:
        """Whether every bound of the request is kept at every instant."""
        return self.verdict == "within"

    @property
    def criteria(self) -> Dict[str, Criterion]:
        return {c.criterion: Criterion(c.criterion, c.value, c.bound if c.HasField("bound") else None, c.unit, c.meaning,
                                       c.where, c.time_s, c.exceeded)
                for c in self.solve.result.accuracy.criteria}

    @property
    def errors(self) -> Dict[str, "solve_pb2.QuantityError"]:
        """Estimated errors by quantity ("joint angle" in rad, "joint torque" in N m …); empty unless they were asked for. The
        errors of objective and durations are in `solve.result.errors`."""
        return {e.quantity: e for e in self.solve.result.errors.quantities}

    def _column(self, joint: str, names: List[str]) -> int:
        if joint not in names:
            raise KeyError(f"no joint {joint!r}; there are {', '.join(names)}")
        return names.index(joint)

    def angles(self, joint: str) -> np.ndarray:
        """Positions of a joint at `times_s`, rad or m."""
        return self.positions[:, self._column(joint, self.joints)]

    def angles_deg(self, joint: str) -> np.ndarray:
        return np.degrees(self.angles(joint))

    def torques(self, joint: str) -> np.ndarray:
        """Efforts of an actuated joint at `point_times_s`, N m or N."""
        return self.efforts[:, self._column(joint, self.actuated_joints)]

    @property
    def events(self) -> List[str]:
        """Of the gait cycle in order, for example "right heel strike 0.0 %"."""
        kinds, feet = gait_events_pb2.GaitEvent.Kind, gait_events_pb2.Foot
        return [f"{feet.Name(e.foot)[5:].lower()} {kinds.Name(e.kind)[5:].lower().replace('_', ' ')} {e.percent:.1f} %"
                for e in self.solve.result.gait_events.events]

    def _mirror(self):
        """For each joint of the trajectory, the joint that it takes its mirror image from, and the sign."""
        joints = list(self.solve.result.model.joints)
        index = {joint.name: i for i, joint in enumerate(joints)}
        place = {name: i for i, name in enumerate(self.joints)}
        source = [place[joints[joints[index[name]].mirror_joint].name] for name in self.joints]
        # The sign stands with the joint whose value is taken.
        sign = np.array([joints[joints[index[name]].mirror_joint].mirror_sign for name in self.joints])
        return source, sign

    def stride(self, samples: int = 101) -> Stride:
        """Both legs over a whole stride. A half cycle is completed by its mirror image, as the request imposed it.

        Positions and velocities are cubic Hermite interpolants between nodes, efforts linear between points. Raises ValueError
        for a motion without gait events (a rolling body).
        """
        events = self.solve.result.gait_events
        if not events.feet:
            raise ValueError("this motion has no gait cycle: it is not a walk of a model with legs")
        times, positions, velocities = self.times_s, self.positions, self.velocities
        point_times, efforts = self.point_times_s, self.efforts
        period = self.duration_s
        if self.solve.result.trajectory.cycle != solve_spec_pb2.CYCLE_FULL:
            source, sign = self._mirror()
            actuated = [self.joints.index(name) for name in self.actuated_joints]
            place = {joint: i for i, joint in enumerate(actuated)}
            shift = np.array([self.displacement_m if name == "base_x" else 0.0 for name in self.joints])
            times = np.concatenate([times, times + period])
            positions = np.vstack([positions, positions[:, source] * sign + shift])
            velocities = np.vstack([velocities, velocities[:, source] * sign])
            point_times = np.concatenate([point_times, point_times + period])
            efforts = np.vstack([efforts, efforts[:, [place[source[j]] for j in actuated]] * sign[actuated]])
            period *= 2
        percent = np.linspace(0, 100, samples)
        at = events.start_s + percent / 100 * period
        turns = np.floor(at / period)
        local = at - turns * period
        columns: Dict[str, np.ndarray] = {"percent": percent, "time_s": percent / 100 * period}
        moved, rates = _hermite(times, positions, velocities, local)
        for j, name in enumerate(self.joints):
            columns[name] = moved[:, j]
            columns[name + ".velocity"] = rates[:, j]
        if "base_x" in columns:  # the walk goes on
            columns["base_x"] = columns["base_x"] + turns * events.displacement_m
        around = np.concatenate([[point_times[-1] - period], point_times, [point_times[0] + period]])
        for a, name in enumerate(self.actuated_joints):
            values = np.concatenate([[efforts[-1, a]], efforts[:, a], [efforts[0, a]]])
            columns[name + ".effort"] = np.interp(local, around, values)
        for foot in events.feet:
            side = gait_events_pb2.Foot.Name(foot.foot)[5:].lower()
            force = _matrix(foot.force_n)
            grid = np.linspace(0, 100, len(force))
            for axis, label in enumerate("xyz"):
                columns[f"{side}.force_{label}"] = np.interp(percent, grid, force[:, axis])
        return Stride(columns)

    def plot(self, path: Optional[Union[str, os.PathLike]] = None, joints=("hip", "knee", "ankle")):
        """Angles, torques per mass and vertical forces over the cycle. Returns matplotlib's figure; saves it to `path`."""
        from rollgait.plotting import plot
        return plot(self, path, joints)

    def to_json(self, path: Union[str, os.PathLike]) -> None:
        """The whole solve as `rollgait get --json` writes it: `rollgait report FILE.json` makes the page of it."""
        from google.protobuf import json_format
        with open(path, "w") as file:
            file.write(json_format.MessageToJson(self.solve))


def _hermite(times: np.ndarray, values: np.ndarray, slopes: np.ndarray, at: np.ndarray):
    """Values and slopes of cubic Hermite interpolants at instants within the first and last of `times` (ascending)."""
    right = np.clip(np.searchsorted(times, at, side="right"), 1, len(times) - 1)
    left = right - 1
    step = (times[right] - times[left])[:, None]
    step[step == 0] = math.inf  # two nodes at one instant: the left one
    s = (at - times[left])[:, None] / step
    width = np.where(np.isinf(step), 0, step)
    a, b, da, db = values[left], values[right], slopes[left] * width, slopes[right] * width
    value = (1 + 2 * s) * (1 - s) ** 2 * a + s * (1 - s) ** 2 * da + s * s * (3 - 2 * s) * b + s * s * (s - 1) * db
    rate = (6 * s * (s - 1) * (a - b) + (1 - s) * (1 - 3 * s) * da + s * (3 * s - 2) * db) / step
    return value, np.where(np.isinf(step), slopes[left], rate)
