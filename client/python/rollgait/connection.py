"""Where the server is and who is calling, from the same places as for the command line client."""
from __future__ import annotations

import dataclasses
import ipaddress
import os
import pathlib
import re
from typing import List, Optional, Tuple

import grpc

from rollgait._version import __version__

_OPTIONS = [
    ("grpc.max_receive_message_length", -1),
    ("grpc.keepalive_time_ms", 30000),
    ("grpc.keepalive_timeout_ms", 10000),
    ("grpc.primary_user_agent", "rollgait-python/" + __version__),
]


def _read(what: str, path: str) -> bytes:
    try:
        data = pathlib.Path(path).read_bytes()
    except OSError as error:
        raise ValueError(f"{what} {path}: cannot be read ({error.strerror})") from error
    if not data:
        raise ValueError(f"{what} {path}: is empty")
    return data


@dataclasses.dataclass(frozen=True)
class Connection:
    """How to reach a server. Every field has the meaning of the command line's flag of that name.

    server     "HOST:PORT" or "unix:PATH". Default: ROLLGAIT_SERVER, else 127.0.0.1:50051.
    tls_ca     CA bundle (PEM) for the server's certificate. Default beyond loopback: that of grpcio.
    tls_cert, tls_key   PEM files of this client, both or none.
    token_file File with the token. Default: the token in ROLLGAIT_TOKEN, else none.
    insecure   Speak plain text beyond loopback. Refused with a token.
    """
    server: Optional[str] = None
    tls_ca: Optional[str] = None
    tls_cert: Optional[str] = None
    tls_key: Optional[str] = None
    token_file: Optional[str] = None
    insecure: bool = False

    @property
    def address(self) -> str:
        address = self.server or os.environ.get("ROLLGAIT_SERVER") or "127.0.0.1:50051"
        port = address.rpartition(":")[2]
        if not address.startswith("unix:") and not (port.isdigit() and 1 <= int(port) <= 65535):
            raise ValueError(f"server {address}: must be HOST:PORT with a port in [1, 65535], "
                             "for example 127.0.0.1:50051")
        return address

    @property
    def is_local(self) -> bool:
        """Loopback or a unix socket. Of names localhost alone, for 127.example.org is anybody's."""
        if self.address.startswith("unix:"):
            return True
        host = self.address.rpartition(":")[0]
        try:
            return host in ("localhost", "[::1]") or ipaddress.IPv4Address(host).is_loopback
        except ValueError:
            return False

    def token(self) -> str:
        text = _read("token_file", self.token_file).decode() if self.token_file else os.environ.get("ROLLGAIT_TOKEN", "")
        token = text.splitlines()[0] if text else ""
        if not re.fullmatch(r"[a-z2-7_]*", token):
            raise ValueError("the token begins with rgt_ and has small letters and digits only; "
                             "what token_file or ROLLGAIT_TOKEN holds is none")
        return token

    def metadata(self) -> List[Tuple[str, str]]:
        """What every call carries."""
        token = self.token()
        if token and self.insecure and not self.is_local:
            raise ValueError("insecure: a token is not sent in plain text beyond this machine; leave one of both out")
        return [("authorization", "Bearer " + token)] if token else []

    def credentials(self) -> Optional[grpc.ChannelCredentials]:
        """None: plain text."""
        asked = self.tls_ca or self.tls_cert
        if asked and self.insecure:
            raise ValueError("insecure excludes tls_ca, tls_cert and tls_key")
        if bool(self.tls_cert) != bool(self.tls_key):
            raise ValueError("tls_cert and tls_key belong together: give both or none")
        if not asked and (self.insecure or self.is_local):
            return None
        return grpc.ssl_channel_credentials(
            root_certificates=_read("tls_ca", self.tls_ca) if self.tls_ca else None,
            private_key=_read("tls_key", self.tls_key) if self.tls_key else None,
            certificate_chain=_read("tls_cert", self.tls_cert) if self.tls_cert else None)

    def channel(self, module=grpc):
        """A channel of grpc, or of grpc.aio if that is given."""
        credentials = self.credentials()
        if credentials is None:
            return module.insecure_channel(self.address, options=_OPTIONS)
        return module.secure_channel(self.address, credentials, options=_OPTIONS)
