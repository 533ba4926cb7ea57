"""One line on stderr that says how a solve goes."""
from __future__ import annotations

import sys
from typing import Callable, Union

from rollgait.v1 import solve_pb2

# What `progress` may be: True for a line on stderr where that is a terminal, False for none, or who takes every event.
Progress = Union[bool, Callable[[solve_pb2.SolveEvent], None]]


class _Line:
    def __init__(self, label: str):
        self._label = label
        self._shown = False

    def __call__(self, event: solve_pb2.SolveEvent) -> None:
        kind = event.WhichOneof("event")
        if kind == "iteration":
            i = event.iteration
            text = (f"{self._label}mesh {i.mesh + 1}, iteration {i.index}: objective {i.objective:.6g}, "
                    f"infeasibility {i.primal_infeasibility:.1e}, {i.elapsed_s:.1f} s")
        elif kind == "state_change":
            text = self._label + solve_pb2.SolveState.Name(event.state_change.state)[len("SOLVE_STATE_"):].lower()
        elif kind == "finished" and self._shown:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()
            return
        else:
            return
        sys.stderr.write("\r\x1b[K" + text[:200])
        sys.stderr.flush()
        self._shown = True


def observer(progress: Progress, label: str = "") -> Callable[[solve_pb2.SolveEvent], None]:
    if callable(progress):
        return progress
    return _Line(label) if progress and sys.stderr.isatty() else lambda event: None
