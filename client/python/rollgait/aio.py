"""The service for programs with an event loop."""
from __future__ import annotations

import asyncio
from typing import AsyncIterator, Optional

import grpc
import grpc.aio

from rollgait import errors
from rollgait.client import RESUMPTIONS, TIMEOUT_S, gait_of
from rollgait.connection import Connection
from rollgait.gait import Gait
from rollgait.progress import Progress, observer
from rollgait.spec import make_spec
from rollgait.v1 import gait_service_pb2 as calls
from rollgait.v1 import gait_service_pb2_grpc, solve_pb2, solve_spec_pb2


class AsyncClient:
    """As Client, with coroutines. Cancelling the task that waits in `solve` cancels the solve on the server.

    >>> async with AsyncClient() as client:
    ...     level, uphill = await asyncio.gather(client.solve(slope_deg=0), client.solve(slope_deg=5))
    """

    def __init__(self, connection: Optional[Connection] = None):
        self.connection = connection or Connection()
        self._metadata = self.connection.metadata()
        self._channel = self.connection.channel(grpc.aio)
        self._stub = gait_service_pb2_grpc.GaitServiceStub(self._channel)

    async def __aenter__(self) -> "AsyncClient":
        return self

    async def __aexit__(self, *exception) -> None:
        await self.close()

    async def close(self) -> None:
        await self._channel.close()

    async def _call(self, method, request):
        try:
            return await method(request, metadata=self._metadata, timeout=TIMEOUT_S)
        except grpc.RpcError as error:
            raise errors.from_rpc(error) from None

    async def solve(self, model: str = "human29", *, progress: Progress = False, **request) -> Gait:
        """Creates a solve and waits for its gait. Keywords as `make_spec`."""
        name = (await self.create(make_spec(model, **request))).name
        try:
            return await self.wait(name, progress=progress)
        except asyncio.CancelledError:
            await asyncio.shield(self.cancel(name))
            raise

    async def create(self, spec: solve_spec_pb2.SolveSpec, *, request_id: str = "",
                     priority: int = 0) -> solve_pb2.Solve:
        return await self._call(self._stub.CreateSolve, calls.CreateSolveRequest(spec=spec, request_id=request_id,
                                                                                 priority=priority))

    async def watch(self, name: str, after_sequence: int = 0) -> AsyncIterator[solve_pb2.SolveEvent]:
        left = RESUMPTIONS
        while True:
            stream = self._stub.WatchSolve(calls.WatchSolveRequest(name=name, after_sequence=after_sequence),
                                           metadata=self._metadata)
            try:
                async for event in stream:
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

    async def wait(self, name: str, *, progress: Progress = False) -> Gait:
        tell = observer(progress)
        async for event in self.watch(name):
            tell(event)
            if event.WhichOneof("event") == "finished":
                return gait_of(event.finished)
        raise errors.RollgaitError(f"the events of {name} ended before the solve did")

    async def get(self, name: str) -> Gait:
        return gait_of(await self._call(self._stub.GetSolve, calls.GetSolveRequest(name=name)))

    async def cancel(self, name: str) -> solve_pb2.Solve:
        return await self._call(self._stub.CancelSolve, calls.CancelSolveRequest(name=name))

    async def set_priority(self, name: str, priority: int) -> solve_pb2.Solve:
        return await self._call(self._stub.SetSolvePriority, calls.SetSolvePriorityRequest(name=name, priority=priority))
