"""What can go wrong, as exceptions, with what the server says of it."""
from __future__ import annotations

import dataclasses
from typing import List, Optional

import grpc
from google.protobuf import any_pb2, descriptor_pb2, descriptor_pool, message_factory


@dataclasses.dataclass(frozen=True)
class Violation:
    """One field that the server refuses: its path in the request, and why, with value and limit."""
    field: str
    description: str


class RollgaitError(Exception):
    """Any failure of a call."""


class ServerUnavailable(RollgaitError):
    """No server answers, or not in time."""


class ServerBusy(RollgaitError):
    """A queue or a limit of the tenant is full. `retry_after_s` is when to try again, if the server says so."""

    def __init__(self, message: str, retry_after_s: Optional[float] = None):
        super().__init__(message)
        self.retry_after_s = retry_after_s


class NotAllowed(RollgaitError):
    """The token or certificate is missing, unknown, or lacks the scope."""


class NotFound(RollgaitError):
    """The server has no such solve or model."""


class InvalidRequest(RollgaitError):
    """The server refuses the request. `violations` names each field with its value and limit."""

    def __init__(self, message: str, violations: List[Violation]):
        # The server's message is its first violation, and how many more there are: each is said once.
        listed = violations
        if violations and message.startswith(f"{violations[0].field} {violations[0].description}"):
            message, listed = f"{violations[0].field} {violations[0].description}", violations[1:]
        super().__init__("\n".join([message] + [f"  {v.field}: {v.description}" for v in listed]))
        self.violations = violations


class SolveFailed(RollgaitError):
    """The solve ended without a trajectory. `solve` is the message rollgait.v1.Solve."""

    def __init__(self, message: str, solve):
        super().__init__(message)
        self.solve = solve


def _make_details():
    """google.rpc's Status, BadRequest and RetryInfo, as far as they are read here (google/rpc/error_details.proto)."""
    field = descriptor_pb2.FieldDescriptorProto
    file = descriptor_pb2.FileDescriptorProto(
        name="rollgait/error_details.proto", package="rollgait.details", syntax="proto3",
        dependency=["google/protobuf/any.proto", "google/protobuf/duration.proto"])

    def message(name, *fields):
        kind = file.message_type.add(name=name)
        for number, (label, type_, type_name) in fields:
            kind.field.add(name=label.strip("*"), number=number, type=type_, type_name=type_name,
                           label=field.LABEL_REPEATED if label.startswith("*") else field.LABEL_OPTIONAL)

    message("Status", (2, ("message", field.TYPE_STRING, None)),
            (3, ("*details", field.TYPE_MESSAGE, ".google.protobuf.Any")))
    message("FieldViolation", (1, ("field", field.TYPE_STRING, None)), (2, ("description", field.TYPE_STRING, None)))
    message("BadRequest", (1, ("*field_violations", field.TYPE_MESSAGE, ".rollgait.details.FieldViolation")))
    message("RetryInfo", (1, ("retry_delay", field.TYPE_MESSAGE, ".google.protobuf.Duration")))
    pool = descriptor_pool.Default()
    pool.Add(file)
    if hasattr(message_factory, "GetMessageClass"):
        make = message_factory.GetMessageClass
    else:
        make = message_factory.MessageFactory(pool).GetPrototype
    return {name: make(pool.FindMessageTypeByName("rollgait.details." + name))
            for name in ("Status", "BadRequest", "RetryInfo")}


# Any.proto and duration.proto must be in the pool before the messages that use them.
from google.protobuf import duration_pb2  # noqa: E402,F401

_DETAILS = _make_details()
_ = any_pb2


def _details_of(metadata):
    """The messages in grpc-status-details-bin, by their name in google.rpc."""
    found = {}
    for key, value in metadata or ():
        if key != "grpc-status-details-bin":
            continue
        for detail in _DETAILS["Status"].FromString(value).details:
            name = detail.type_url.rsplit(".", 1)[-1]
            if name in _DETAILS:
                found[name] = _DETAILS[name].FromString(detail.value)
    return found


def from_rpc(error: grpc.RpcError) -> RollgaitError:
    """The exception that a failed call deserves."""
    code, text = error.code(), error.details() or ""
    details = _details_of(error.trailing_metadata())
    status = grpc.StatusCode
    if code == status.INVALID_ARGUMENT:
        bad = details.get("BadRequest")
        violations = [Violation(v.field, v.description) for v in bad.field_violations] if bad else []
        return InvalidRequest(text, violations)
    if code == status.RESOURCE_EXHAUSTED:
        retry = details.get("RetryInfo")
        return ServerBusy(text, retry.retry_delay.seconds + 1e-9 * retry.retry_delay.nanos if retry else None)
    if code in (status.UNAUTHENTICATED, status.PERMISSION_DENIED):
        return NotAllowed(text)
    if code == status.NOT_FOUND:
        return NotFound(text)
    if code in (status.UNAVAILABLE, status.DEADLINE_EXCEEDED):
        return ServerUnavailable(text + ". Is a server running, and is its address right?")
    return RollgaitError(f"{code.name}: {text}")
