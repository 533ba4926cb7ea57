"""The service for programs that wait."""
from __future__ import annotations

import time
from typing import Dict, Iterable, Iterator, List, Optional

import grpc

from rollgait import errors
from rollgait.connection import Connection
from rollgait.gait import Gait
from rollgait.progress import Progress, observer
from rollgait.spec import make_spec
from rollgait.v1 import gait_service_pb2 as calls
from rollgait.v1 import gait_service_pb2_grpc, model_pb2, solve_pb2, solve_spec_pb2

TIMEOUT_S = 30.0  # for the answer of one call that does not stream
RESUMPTIONS = 5   # of a stream that breaks
MOST_AT_ONCE = 256  # solves that one call makes
MOST_BYTES_AT_ONCE = 3 << 20  # of their requests; the server's limit is 4 MiB
TOO_LONG = "send it in several batches"  # words of the server's refusal, which counts stored models and warm starts too


def _batches(requests: Iterable[calls.CreateSolveRequest]) -> Iterator[List[calls.CreateSolveRequest]]:
    batch: List[calls.CreateSolveRequest] = []
    size = 0
    for request in requests:
        if batch and (len(batch) == MOST_AT_ONCE or size + request.ByteSize() > MOST_BYTES_AT_ONCE):
            yield batch
            batch, size = [], 0
        batch.append(request)
        size += request.ByteSize()
    if batch:
        yield batch


def gait_of(solve: solve_pb2.Solve) -> Gait:
    """The gait of a finished solve; SolveFailed without a trajectory."""
    if solve.state == solve_pb2.SOLVE_STATE_SUCCEEDED and solve.result.HasField("trajectory"):
        return Gait(solve)
    said = solve.error.message or solve.result.message
    state = solve_pb2.SolveState.Name(solve.state)[len("SOLVE_STATE_"):].lower()
    raise errors.SolveFailed(f"{solve.name} {state}: {said}", solve)


class Client:
    """A connection to a server. Use it in a `with` statement, or close it.

    >>> with Client() as client:
    ...     gait = client.solve(model="planar", slope_deg=5)
    """

    def __init__(self, connection: Optional[Connection] = None):
        self.connection = connection or Connection()
        self._metadata = self.connection.metadata()
        self._channel = self.connection.channel()
        self._stub = gait_service_pb2_grpc.GaitServiceStub(self._channel)

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, *exception) -> None:
        self.close()

    def close(self) -> None:
        self._channel.close()

    def _call(self, method, request, timeout: float = TIMEOUT_S):
        try:
            return method(request, metadata=self._metadata, timeout=timeout)
        except grpc.RpcError as error:
            raise errors.from_rpc(error) from None

    def solve(self, model: str = "human29", *, progress: Progress = True, **request) -> Gait:
        """Creates a solve and waits for its gait. Keywords as `make_spec`. Ctrl-C cancels the solve on the server."""
        return self.solve_spec(make_spec(model, **request), progress=progress)

    def solve_spec(self, spec: solve_spec_pb2.SolveSpec, *, progress: Progress = True, label: str = "") -> Gait:
        return self.wait(self.create(spec).name, progress=progress, cancel_on_interrupt=True, label=label)

    def create(self, spec: solve_spec_pb2.SolveSpec, *, request_id: str = "",
               labels: Optional[Dict[str, str]] = None, priority: int = 0) -> solve_pb2.Solve:
        """Stores a solve. With the same request_id, spec and labels it answers with the solve made before. Of your queued
        solves the one with the highest priority, -10 to 10, runs first."""
        return self._call(self._stub.CreateSolve, calls.CreateSolveRequest(spec=spec, request_id=request_id, labels=labels,
                                                                           priority=priority))

    def create_all(self, specs: Iterable[solve_spec_pb2.SolveSpec], *,
                   labels: Optional[Dict[str, str]] = None, priority: int = 0) -> List[solve_pb2.Solve]:
        """Stores solves with the same labels and priority, in the order of the specs. As many as the server takes at once are a batch, of
        which all are stored or none: MOST_AT_ONCE, fewer if they are long. A server that is too busy for a batch is waited for
        once, as long as it says."""
        made: List[solve_pb2.Solve] = []
        for batch in _batches([calls.CreateSolveRequest(spec=spec, labels=labels, priority=priority) for spec in specs]):
            made += self._create_batch(batch)
        return made

    def _create_batch(self, requests: List[calls.CreateSolveRequest]) -> List[solve_pb2.Solve]:
        batch = calls.BatchCreateSolvesRequest(requests=requests)
        try:
            try:
                return list(self._call(self._stub.BatchCreateSolves, batch).solves)
            except errors.ServerBusy as busy:
                if busy.retry_after_s is None:
                    raise
                time.sleep(busy.retry_after_s)
                return list(self._call(self._stub.BatchCreateSolves, batch).solves)
        except errors.InvalidRequest as refused:
            if len(requests) < 2 or TOO_LONG not in str(refused):
                raise
        half = len(requests) // 2
        return self._create_batch(requests[:half]) + self._create_batch(requests[half:])

    def check(self, spec: solve_spec_pb2.SolveSpec) -> None:
        """Raises InvalidRequest if the server would refuse the spec; stores nothing."""
        self._call(self._stub.CreateSolve, calls.CreateSolveRequest(spec=spec, validate_only=True))

    def watch(self, name: str, after_sequence: int = 0) -> Iterator[solve_pb2.SolveEvent]:
        """The events of a solve to its end. A stream that breaks is taken up where it was."""
        left = RESUMPTIONS
        while True:
            stream = self._stub.WatchSolve(calls.WatchSolveRequest(name=name, after_sequence=after_sequence),
                                           metadata=self._metadata)
            try:
                for event in stream:
                    after_sequence, left = event.sequence, RESUMPTIONS
                    yield event
                    if event.WhichOneof("event") == "finished":
                        return
            except grpc.RpcError as error:
                left -= 1
                if error.code() != grpc.StatusCode.UNAVAILABLE or left < 0:
                    raise errors.from_rpc(error) from None
            finally:
                stream.cancel()

    def wait(self, name: str, *, progress: Progress = True, cancel_on_interrupt: bool = False, label: str = "") -> Gait:
        """Waits for the end of a solve. SolveFailed if it has no trajectory."""
        tell = observer(progress, label)
        try:
            for event in self.watch(name):
                tell(event)
                if event.WhichOneof("event") == "finished":
                    return gait_of(event.finished)
        except KeyboardInterrupt:
            if cancel_on_interrupt:
                self.cancel(name)
            raise
        raise errors.RollgaitError(f"the events of {name} ended before the solve did")

    def get(self, name: str) -> Gait:
        """A finished solve. SolveFailed if it has no trajectory (yet)."""
        return gait_of(self._call(self._stub.GetSolve, calls.GetSolveRequest(name=name)))

    def list(self, *, page_size: int = 50, **filters) -> Iterator[solve_pb2.Solve]:
        """Solves, newest first, without results but with their outcome; all, or those that pass the filters, which are fields
        of rollgait.v1.SolveFilter: labels={"sweep": "hills"}, model="planar"."""
        token = ""
        chosen = calls.SolveFilter(**filters) if filters else None
        while True:
            page = self._call(self._stub.ListSolves,
                              calls.ListSolvesRequest(page_size=page_size, page_token=token, filter=chosen))
            yield from page.solves
            token = page.next_page_token
            if not token:
                return

    def cancel(self, name: str) -> solve_pb2.Solve:
        return self._call(self._stub.CancelSolve, calls.CancelSolveRequest(name=name))

    def set_priority(self, name: str, priority: int) -> solve_pb2.Solve:
        """Of a queued solve, -10 to 10: among your queued solves the highest runs first."""
        return self._call(self._stub.SetSolvePriority, calls.SetSolvePriorityRequest(name=name, priority=priority))

    def delete(self, name: str) -> None:
        self._call(self._stub.DeleteSolve, calls.DeleteSolveRequest(name=name))

    def models(self) -> List[str]:
        """Names that requests take: those of the server's list, then "models/ID@VERSION" of your own."""
        names: List[str] = []
        token = ""
        while True:
            page = self._call(self._stub.ListModels, calls.ListModelsRequest(page_size=1000, page_token=token))
            names += [model.stored.name if model.HasField("stored") else model.name for model in page.models]
            token = page.next_page_token
            if not token:
                return names

    def model(self, name: str, **selection) -> model_pb2.Model:
        """The whole model, scaled. Keywords: fields of rollgait.v1.ModelSelection."""
        return self._call(self._stub.GetModel,
                          calls.GetModelRequest(model=model_pb2.ModelSelection(name=name, **selection)))

    def server_info(self) -> calls.ServerInfo:
        return self._call(self._stub.GetServerInfo, calls.GetServerInfoRequest())

    def sweep(self, slopes_deg: Iterable[float], model: str = "human29", *, progress: Progress = True,
              **request) -> Dict[float, Gait]:
        """One gait for each slope, by slope. All are created before the first is waited for, so that the server's slots are
        busy; answers do not depend on the order. A solve without a trajectory is left out after its SolveFailed was
        told to `progress`, which takes exceptions too if it is a function."""
        slopes = list(slopes_deg)
        specs = [make_spec(model, slope_deg=slope, **request) for slope in slopes]
        names = {slope: solve.name for slope, solve in zip(slopes, self.create_all(specs))}
        gaits: Dict[float, Gait] = {}
        try:
            for slope, name in names.items():
                try:
                    gaits[slope] = self.wait(name, progress=progress, label=f"{slope:g}°, ")
                except errors.SolveFailed as failed:
                    if callable(progress):
                        progress(failed)
                    elif progress:
                        import warnings
                        warnings.warn(f"{slope:g}°: {failed}", stacklevel=2)
        except KeyboardInterrupt:
            for name in names.values():
                self.cancel(name)
            raise
        return gaits


def solve(model: str = "human29", *, connection: Optional[Connection] = None, progress: Progress = True, **request) -> Gait:
    """One gait, over a connection of its own. Keywords as `make_spec`."""
    with Client(connection) as client:
        return client.solve(model, progress=progress, **request)


def sweep(slopes_deg: Iterable[float], model: str = "human29", *, connection: Optional[Connection] = None,
          progress: Progress = True, **request) -> Dict[float, Gait]:
    """As `Client.sweep`, over a connection of its own."""
    with Client(connection) as client:
        return client.sweep(slopes_deg, model, progress=progress, **request)
