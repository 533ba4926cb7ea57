"""Optimal walking gaits from a Rollgait server.

    import rollgait
    gait = rollgait.solve(model="human29", preset="human", slope_deg=5)
    gait.angles_deg("knee_r")          # over the trajectory's nodes
    gait.stride()["knee_r"]            # 101 samples of a whole stride, both legs
    gait.plot("gait.png")

`solve` and `sweep` open a connection for one call. `Client` keeps one; `AsyncClient` is the same for asyncio. Server, token
and certificates come from the arguments or from the same environment variables as those of the command line client.
Numbers are in SI units and radians unless a name ends in `_deg`.
"""
from rollgait._version import __version__
from rollgait.client import Client, solve, sweep
from rollgait.aio import AsyncClient
from rollgait.connection import Connection
from rollgait.errors import (InvalidRequest, NotAllowed, NotFound, RollgaitError, ServerBusy, ServerUnavailable,
                             SolveFailed, Violation)
from rollgait.gait import Criterion, Gait, Stride
from rollgait.spec import make_spec

__all__ = [
    "AsyncClient", "Client", "Connection", "Criterion", "Gait", "InvalidRequest", "NotAllowed", "NotFound",
    "RollgaitError", "ServerBusy", "ServerUnavailable", "SolveFailed", "Stride", "Violation", "__version__",
    "make_spec", "solve", "sweep",
]
