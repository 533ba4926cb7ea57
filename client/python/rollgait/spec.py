"""From keyword arguments to the message rollgait.v1.SolveSpec."""
from __future__ import annotations

import difflib
import math
from typing import Any, Mapping, Optional

from google.protobuf import json_format

from rollgait.v1 import solve_spec_pb2 as pb

_PRESETS = {"torque": pb.PRESET_TORQUE, "transport": pb.PRESET_TRANSPORT, "human": pb.PRESET_HUMAN}
_LEVELS = {"draft": pb.Accuracy.LEVEL_DRAFT, "standard": pb.Accuracy.LEVEL_STANDARD, "fine": pb.Accuracy.LEVEL_FINE}
_SCHEMES = {name[len("SCHEME_"):].lower().replace("_", "-"): number
            for name, number in pb.Discretization.Scheme.items() if number}
_SOLVERS = {"interior-point": pb.NLP_SOLVER_INTERIOR_POINT, "ipopt": pb.NLP_SOLVER_IPOPT}
_CYCLES = {"half": pb.CYCLE_HALF, "full": pb.CYCLE_FULL}


def _choose(what: str, value: str, table: Mapping[str, int]) -> int:
    if value in table:
        return table[value]
    close = difflib.get_close_matches(value, table, 1)
    hint = f" Did you mean {close[0]!r}?" if close else ""
    raise ValueError(f"{what}={value!r}: must be one of {', '.join(table)}.{hint}")


def make_spec(model: str = "human29", *, preset: Optional[str] = None, slope_deg: Optional[float] = None,
              speed_m_s: Optional[float] = None, step_length_m: Optional[float] = None,
              step_duration_s: Optional[float] = None, stature_m: Optional[float] = None,
              body_mass_kg: Optional[float] = None, sex: Optional[str] = None, gravity_m_s2: Optional[float] = None,
              accuracy: Optional[str] = None, bounds: Optional[Mapping[str, float]] = None,
              estimate_errors: bool = False, max_error: Optional[Mapping[str, float]] = None,
              scheme: Optional[str] = None, intervals: Optional[int] = None, cycle: Optional[str] = None,
              friction: Optional[float] = None, starts: Optional[int] = None, warm_start: Optional[str] = None,
              max_iterations: Optional[int] = None, time_limit_s: Optional[float] = None,
              solver: Optional[str] = None, spec: Optional[Mapping[str, Any]] = None) -> pb.SolveSpec:
    """The request for a gait. What is left out has the default of the server.

    model       a name from `Client.models()`: "human29", "planar" …
    preset      "human", "torque" or "transport"
    slope_deg   positive uphill; speed_m_s along the slope
    accuracy    "draft", "standard" or "fine"; `bounds` replaces bounds of the level by the names of rollgait.v1.Accuracy,
                for example {"max_slip_m_s": 5e-4}
    estimate_errors  `Gait.errors` tells how far angles, torques and the objective are from those on ever finer meshes
    max_error   refine until the estimates are within these, by the names of rollgait.v1.MaxError: {"angle_rad": 0.01}
    intervals   of the first mesh in a single-support phase
    warm_start  "solves/ID" or "nearest"
    solver      "interior-point" or "ipopt"
    spec        any further field of rollgait.v1.SolveSpec, as in its JSON: {"groundContact": {"swingClearanceM": 0.03}}

    Raises ValueError for words that mean nothing; numbers are checked by the server, which names field, value and limit.
    """
    message = pb.SolveSpec()
    if spec:
        json_format.ParseDict(dict(spec), message)
    message.model.name = model
    if preset is not None:
        message.preset = _choose("preset", preset, _PRESETS)
    if slope_deg is not None:
        message.slope_rad = math.radians(slope_deg)
    if sex is not None:
        message.model.sex = _choose("sex", sex, {"female": 1, "male": 2})
    if accuracy is not None:
        message.accuracy.level = _choose("accuracy", accuracy, _LEVELS)
    if scheme is not None:
        message.discretization.scheme = _choose("scheme", scheme, _SCHEMES)
    if solver is not None:
        message.nlp_solver = _choose("solver", solver, _SOLVERS)
    if cycle is not None:
        message.cycle = _choose("cycle", cycle, _CYCLES)
    for name, bound in (bounds or {}).items():
        fields = [f.name for f in pb.Accuracy.DESCRIPTOR.fields if f.name.startswith("max_") and f.cpp_type == f.CPPTYPE_DOUBLE]
        if name not in fields:
            close = difflib.get_close_matches(name, fields, 1)
            raise ValueError(f"bounds: there is no {name!r}." + (f" Did you mean {close[0]!r}?" if close else ""))
        setattr(message.accuracy, name, bound)
    message.accuracy.estimate_errors = estimate_errors
    for name, most in (max_error or {}).items():
        known = [f.name for f in pb.MaxError.DESCRIPTOR.fields]
        if name not in known:
            raise ValueError(f"max_error: there is no {name!r}; must be one of {', '.join(known)}.")
        setattr(message.accuracy.max_error, name, most)
    for owner, name, value in (
            (message.motion, "speed_m_s", speed_m_s), (message.motion, "step_length_m", step_length_m),
            (message.motion, "step_duration_s", step_duration_s), (message.model, "stature_m", stature_m),
            (message.model, "body_mass_kg", body_mass_kg), (message, "gravity_m_s2", gravity_m_s2),
            (message.discretization, "single_support_intervals", intervals),
            (message.ground_contact, "friction_coefficient", friction), (message, "starts", starts),
            (message, "warm_start", warm_start), (message.solver_limits, "max_iterations", max_iterations),
            (message.solver_limits, "max_wall_time_s", time_limit_s)):
        if value is not None:
            setattr(owner, name, value)
    return message
