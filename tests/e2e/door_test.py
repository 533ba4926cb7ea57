"""The door of docs/explanation/door.md: rollgaitd behind haproxy with TLS and tokens, good calls during every attack, and that the
server learns who calls from the door alone.

  door_test.py [TEST...]    environment: ROLLGAITD, ROLLGAIT_GATEWAY, SLOW_SOLVER, ROLLGAIT_SOURCE; exit code 77: haproxy is missing

Asserts answers, memory and which alerts an attack raises, not times; prints a row of docs/explanation/door.md's table for each attack.
"""
import contextlib
import http.client
import json
import os
import re
import shutil
import socket
import sqlite3
import ssl
import subprocess
import sys
import tempfile
import threading
import time
import unittest

if shutil.which("haproxy", path=os.environ["PATH"] + ":/usr/sbin") is None or shutil.which("openssl") is None:
    print("skipped: there is no haproxy here; scripts/install-packages installs it")
    sys.exit(77)
try:
    import grpc
except ImportError:
    print("skipped: Python has no grpc here; scripts/install-packages installs it")
    sys.exit(77)

import alert_rules

SOURCE = os.environ["ROLLGAIT_SOURCE"]
ATTACKS = SOURCE + "/tests/faults/attacks.py"
MOST_MIB = 512  # a quarter of what the Kubernetes manifest gives rollgaitd
SECONDS = float(os.environ.get("ROLLGAIT_ATTACK_SECONDS", "3"))
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith("ROLLGAIT_DOOR")}


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def memory(process, name="VmHWM"):
    """MiB of a process: its peak, or what it holds now (VmRSS)."""
    with open(f"/proc/{process.pid}/status", encoding="utf-8") as status:
        return int(re.search(name + r":\s+(\d+) kB", status.read()).group(1)) // 1024


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Certificates:
    """Those of scripts/make-certificates."""

    def __init__(self, directory):
        self.directory = directory
        run(SOURCE + "/scripts/make-certificates", directory, "localhost", "lab")

    def path(self, name):
        return f"{self.directory}/{name}"

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()


class Server:
    """rollgaitd and, unless `flags` say otherwise, the door in front of it."""

    def __init__(self, directory, certificates, flags, door=None):
        self.directory, self.certificates, self.haproxy = directory, certificates, None
        os.mkdir(directory)
        listen = f"unix:{directory}/door.sock" if door is not None else "127.0.0.1:0"
        self.log = open(directory + "/log", "ab")
        self.rollgaitd = subprocess.Popen(
            [os.environ["ROLLGAITD"], "--data-dir", directory + "/data", "--listen", listen, "--solver",
             os.environ["SLOW_SOLVER"], "--log-level", "debug", *flags], stdout=subprocess.PIPE, stderr=self.log)
        self.address = self.rollgaitd.stdout.readline().decode().strip().removeprefix("rollgaitd listening on ")
        if door is not None:
            self.address = f"127.0.0.1:{free_port()}"
            self.start_door(door)

    def start_door(self, door):
        self.haproxy = subprocess.Popen(
            ["haproxy", "-db", "-f", SOURCE + "/docker/door/haproxy.cfg"], stdout=self.log, stderr=self.log,
            env={**ENVIRONMENT, "PATH": os.environ["PATH"] + ":/usr/sbin", "ROLLGAIT_DOOR_LISTEN": self.address,
                 "ROLLGAIT_DOOR_SOCKET": self.directory + "/door.sock",
                 "ROLLGAIT_DOOR_CERTIFICATE": self.certificates.path("server.crt"), **door})

    def token(self, tenant="lab"):
        return run(os.environ["ROLLGAITD"], "token", "create", "--data-dir", self.directory + "/data", "--tenant",
                   tenant, "--scopes", "read,solve").strip()

    def long_solve(self, channel, token):
        """The name of a finished solve of the token's tenant, with a result of 1.5 MB."""
        metadata = (("authorization", "Bearer " + token),)
        spec = b"\x0a\x08\x0a\x06planar"  # model.name
        solve = ask(channel, metadata, "CreateSolve", b"\x0a" + bytes((len(spec),)) + spec)
        name = solve[2:2 + solve[1]]
        request, deadline = b"\x0a" + bytes((len(name),)) + name, time.monotonic() + 60
        while b"from the test's solver" not in ask(channel, metadata, "GetSolve", request):
            if time.monotonic() > deadline:
                raise AssertionError("the solve does not end")
            time.sleep(0.1)
        with contextlib.closing(sqlite3.connect(self.directory + "/data/rollgait.db", timeout=30)) as database:
            (result,) = database.execute("SELECT payload FROM results").fetchone()
            message = b"\x12\x80\x80\x60" + b"x" * (96 << 14)  # SolveResult.message again: the last one counts
            database.execute("UPDATE results SET payload = ?", (result + message,))
            database.commit()
        return name.decode()

    def stop(self):
        for process in (self.haproxy, self.rollgaitd):
            if process is not None:
                process.terminate()
                process.wait(30)
        self.rollgaitd.stdout.close()
        self.log.close()

    def logged(self):
        with open(self.directory + "/log", encoding="utf-8", errors="replace") as log:
            return log.read()


def ask(channel, metadata=(), method="GetServerInfo", message=b""):
    """The bytes of the answer; raises grpc.RpcError."""
    call = channel.unary_unary("/rollgait.v1.GaitService/" + method)
    return call(message, metadata=metadata, timeout=30, wait_for_ready=True)


LONG_MESSAGE = b"\xfa\x7f\x80\x80\x08" + b"x" * (128 << 10)  # GetServerInfoRequest with a field that nobody knows


class GoodCaller(threading.Thread):
    """One who calls again and again, now and then over a new connection and with a message longer than a buffer of the door."""

    def __init__(self, server, token):
        super().__init__()
        self.server, self.metadata, self.times, self.failures = server, (("authorization", "Bearer " + token),), [], []
        self.attack, self.stopping = "no attack", threading.Event()

    def run(self):
        tls = grpc.ssl_channel_credentials(self.server.certificates.read("ca.pem"))
        while not self.stopping.is_set():
            options = (("grpc.use_local_subchannel_pool", 1), ("grpc.ssl_target_name_override", "localhost"))
            with grpc.secure_channel(self.server.address, tls, options) as channel:
                for number in range(20):
                    start = time.monotonic()
                    try:
                        ask(channel, self.metadata, message=LONG_MESSAGE if number == 10 else b"")
                    except grpc.RpcError as error:
                        self.failures.append(f"during {self.attack}: {error.code()} {error.details()} "
                                             f"{error.debug_error_string()}")
                    self.times.append(time.monotonic() - start)
                    if self.stopping.wait(0.02):
                        break

    def row(self):
        times = sorted(self.times)
        return f"{len(times)} | {1000 * times[len(times) // 2]:.0f} | {1000 * times[len(times) * 99 // 100]:.0f}"


class DoorTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory(prefix="rollgait-door-")
        cls.certificates = Certificates(cls.directory.name)
        cls.servers = 0

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    def serve(self, *flags, door=None):
        type(self).servers += 1
        server = Server(f"{self.directory.name}/{self.servers}", self.certificates, flags, door)
        self.addCleanup(server.stop)
        return server

    def attack(self, name, server, source, *more):
        line = run("/usr/bin/python3", ATTACKS, name, "--to", server.address, "--seconds", str(SECONDS), "--source",
                   source, *more)
        return json.loads(line)

    def test_good_calls_are_answered_during_every_attack(self):
        watched = f"127.0.0.1:{free_port()}", f"127.0.0.1:{free_port()}"
        server = self.serve("--behind-door", "--require-token", "--metrics-listen", watched[0],
                            door={"ROLLGAIT_DOOR_METRICS": watched[1]})
        hostile = server.token("hostile")
        with open(server.directory + "/token", "w", encoding="utf-8") as file:
            file.write(hostile)
        tls = grpc.ssl_channel_credentials(self.certificates.read("ca.pem"))
        with grpc.secure_channel(server.address, tls, (("grpc.ssl_target_name_override", "localhost"),)) as channel:
            solve = server.long_solve(channel, hostile)
        caller = GoodCaller(server, server.token())  # from 127.0.0.1, another tenant
        caller.start()
        attacks = ["continuation_flood", "rapid_reset", "hpack_varint", "hpack_bomb", "idle_connections",
                   "half_handshakes", "half_calls", "half_bodies", "compressed_bodies", "unread_refusals", "unread_answers",
                   "unread_results", "unread_watches"]
        rules = alert_rules.rules(SOURCE + "/docker/observability/alerts.yml")
        print("| attack | connections | streams | MB sent | good calls | p50 ms | p99 ms | rollgaitd MiB | door MiB | alerts |")
        try:
            before = alert_rules.scrape(*watched)
            time.sleep(SECONDS)
            after = alert_rules.scrape(*watched)
            self.assertEqual([name for name, rule in rules.items() if alert_rules.fires(rule, before, after, SECONDS)], [],
                             "alerts without an attack")
            for number, name in enumerate(attacks):
                legal = name.startswith("unread_") and name != "unread_refusals"
                more = ("--token", server.directory + "/token", "--solve", solve) if legal else ()
                caller.attack = name
                caller.times.clear()
                before = alert_rules.scrape(*watched)
                made = self.attack(name, server, f"127.0.0.{number + 2}", "--ca", self.certificates.path("ca.pem"),
                                   *more)
                peaks = memory(server.rollgaitd), memory(server.haproxy)
                after = alert_rules.scrape(*watched)
                alerts = [alert.removeprefix("Rollgait") for alert, rule in rules.items()
                          if alert_rules.fires(rule, before, after, SECONDS)]
                print(f"| {name} | {made['connections']} | {made['streams']} | {made['bytes'] / 1e6:.0f} "
                      f"| {caller.row()} | {peaks[0]} | {peaks[1]} | {', '.join(alerts)} |", flush=True)
                self.assertGreater(made["connections"], 0, "the attack never reached the door")
                self.assertIsNone(server.rollgaitd.poll(), "rollgaitd has ended")
                self.assertIsNone(server.haproxy.poll(), "haproxy has ended")
                self.assertLess(peaks[0], MOST_MIB, name)
                self.assertLess(peaks[1], MOST_MIB, name)
                self.assertNotEqual(alerts, [], f"nobody is told of {name}")
        finally:
            caller.stopping.set()
            caller.join()
        self.assertEqual(caller.failures, [])

    def test_unread_results_are_bounded_without_the_door_too(self):
        """Two connections of 2000 streams each took 5.9 GB. Refusals that nobody reads, of more of them, are the door's to
        bound."""
        server = self.serve("--require-token")
        token, hostile = server.token(), server.token("hostile")
        with open(server.directory + "/token", "w", encoding="utf-8") as file:
            file.write(hostile)
        with grpc.insecure_channel(server.address) as channel:
            solve = server.long_solve(channel, hostile)
            for name in ("unread_results", "unread_watches"):
                self.attack(name, server, "127.0.0.2", "--token", server.directory + "/token", "--solve", solve,
                            "--connections", "2", "--streams", "2000")
                peak = memory(server.rollgaitd)
                print(f"| {name} without the door | rollgaitd {peak} MiB |", flush=True)
                self.assertLess(peak, MOST_MIB, name)
                ask(channel, (("authorization", "Bearer " + token),))

    def test_without_the_door_the_attack_is_felt(self):
        """What the test above would see if the door did not hold."""
        server = self.serve()
        deadline, peak = time.monotonic() + 120, 0
        while peak <= MOST_MIB and time.monotonic() < deadline:
            self.attack("rapid_reset", server, "127.0.0.2")
            peak = memory(server.rollgaitd)
        print(f"| rapid_reset without the door | rollgaitd {peak} MiB |")
        self.assertGreater(peak, MOST_MIB)

    def test_the_door_and_nobody_else_says_who_calls(self):
        server = self.serve("--behind-door", "--certificate-tenant", "cn",
                            door={"ROLLGAIT_DOOR_CLIENT_CA": self.certificates.path("ca.pem"),
                                  "ROLLGAIT_DOOR_VERIFY": "optional"})
        ca, key, cert = (self.certificates.read(name) for name in ("ca.pem", "client.key", "client.pem"))
        options = (("grpc.ssl_target_name_override", "localhost"), ("grpc.use_local_subchannel_pool", 1))
        with grpc.secure_channel(server.address, grpc.ssl_channel_credentials(ca, key, cert), options) as channel:
            self.assertIn(b"lab", ask(channel))
        forged = run("openssl", "x509", "-in", self.certificates.path("client.pem"), "-outform", "pem")
        forged = "".join(forged.split("\n")[1:-2])
        with grpc.secure_channel(server.address, grpc.ssl_channel_credentials(ca), options) as channel:
            for name, value in (("x-rollgait-client-certificate", forged), ("x-rollgait-peer", "ipv4:203.0.113.9:1")):
                with self.assertRaises(grpc.RpcError) as caught:
                    ask(channel, ((name, value),))
                self.assertEqual(caught.exception.code(), grpc.StatusCode.UNAUTHENTICATED)
        time.sleep(0.5)
        self.assertIn('"peer":"ipv4:127.0.0.1:', server.logged())
        self.assertNotIn("203.0.113.9", server.logged())
        audit = run(os.environ["ROLLGAITD"], "audit", "--data-dir", server.directory + "/data")
        self.assertIn("peer=ipv4:127.0.0.1:", audit)

    def test_http_comes_in_through_the_same_door(self):
        server = self.serve("--behind-door", "--require-token", door={"ROLLGAIT_DOOR_GATEWAY": self.directory.name + "/http.sock"})
        tls = ssl.create_default_context(cafile=self.certificates.path("ca.pem"))
        tls.verify_flags |= ssl.VERIFY_X509_STRICT  # the default from Python 3.13 on
        host, port = "localhost", int(server.address.rsplit(":", 1)[1])

        def answer(verb, path, body=None, **headers):
            connection = http.client.HTTPSConnection(host, port, timeout=60, context=tls)
            with contextlib.closing(connection):
                connection.request(verb, path, body, {name.replace("_", "-"): value for name, value in headers.items()})
                response = connection.getresponse()
                return response.status, response.read().decode(), response.headers
        bearer = {"authorization": "Bearer " + server.token()}
        credentials = grpc.ssl_channel_credentials(self.certificates.read("ca.pem"))
        with grpc.secure_channel(server.address, credentials, (("grpc.ssl_target_name_override", "localhost"),)) as channel:
            ask(channel, tuple(bearer.items()))
        self.assertEqual(answer("GET", "/v1/serverInfo")[0], 503)  # no gateway yet
        with self.start_gateway(server):
            status, text, _ = answer("POST", "/v1/solves", '{"spec":{"model":{"name":"planar"}}}', content_type="application/json",
                                     x_rollgait_peer="ipv4:6.6.6.6:6", **bearer)
            self.assertEqual(status, 200, text)
            solve = json.loads(text)
            status, text, headers = answer("GET", f"/v1/{solve['name']}:watch", **bearer)
            self.assertEqual((status, headers["content-type"]), (200, "text/event-stream"))
            self.assertTrue(text.endswith("event: end\ndata: {}\n\n"), text[-200:])
            audit = run(os.environ["ROLLGAITD"], "audit", "--data-dir", server.directory + "/data")
            self.assertIn("peer=ipv4:127.0.0.1:", audit)
            self.assertNotIn("6.6.6.6", audit)
            # HTTP/2, as browsers speak it.
            shown = run("curl", "--silent", "--show-error", "--http2", "--cacert", self.certificates.path("ca.pem"), "--write-out",
                        "%{http_version} %{http_code}", "--header", "authorization: " + bearer["authorization"],
                        f"https://localhost:{port}/v1/{solve['name']}")
            self.assertTrue(shown.endswith("2 200"), shown[-200:])
            self.assertEqual(answer("GET", "/elsewhere")[0], 415)
            self.assertEqual(answer("POST", "/v1/solves", content_length=str((4 << 20) + 1), **bearer)[0], 413)
            # Who guesses tokens is counted as with gRPC: 100 refusals in 10 s.
            statuses = set()
            for _ in range(400):
                status, _, headers = answer("GET", "/v1/serverInfo")
                statuses.add(status)
                self.assertNotIn("x-rollgait-refused", headers)
                if status == 429:
                    break
            self.assertEqual(statuses, {401, 429})

    @contextlib.contextmanager
    def start_gateway(self, server):
        gateway = subprocess.Popen(
            [os.environ["ROLLGAIT_GATEWAY"], "--listen", f"unix:{self.directory.name}/http.sock", "--server",
             f"unix:{server.directory}/door.sock", "--behind-door"], stdout=subprocess.PIPE, stderr=server.log)
        try:
            self.assertIn(b"listening on unix:", gateway.stdout.readline())
            yield gateway
        finally:
            gateway.terminate()
            self.assertEqual(gateway.wait(60), 0)
            gateway.stdout.close()

    def test_the_configuration_holds_no_warning(self):
        for more in ({}, {"ROLLGAIT_DOOR_CLIENT_CA": self.certificates.path("ca.pem"), "ROLLGAIT_DOOR_METRICS": "127.0.0.1:9466"}):
            checked = subprocess.run(
                ["haproxy", "-c", "-f", SOURCE + "/docker/door/haproxy.cfg"], capture_output=True, text=True, check=False,
                env={**ENVIRONMENT, "PATH": os.environ["PATH"] + ":/usr/sbin",
                     "ROLLGAIT_DOOR_CERTIFICATE": self.certificates.path("server.crt"), **more})
            self.assertEqual(checked.returncode, 0, checked.stderr)
            self.assertNotIn("WARNING", checked.stderr)

    def test_a_certificate_is_asked_for_where_it_must_be(self):
        server = self.serve("--behind-door", "--require-token",
                            door={"ROLLGAIT_DOOR_CLIENT_CA": self.certificates.path("ca.pem")})
        credentials = grpc.ssl_channel_credentials(self.certificates.read("ca.pem"))
        options = (("grpc.ssl_target_name_override", "localhost"), ("grpc.use_local_subchannel_pool", 1))
        with grpc.secure_channel(server.address, credentials, options) as channel:
            with self.assertRaises(grpc.RpcError) as caught:
                channel.unary_unary("/rollgait.v1.GaitService/GetServerInfo")(b"", timeout=5)
            self.assertIn(caught.exception.code(), (grpc.StatusCode.UNAVAILABLE, grpc.StatusCode.DEADLINE_EXCEEDED))

    def test_a_reader_of_the_log_that_stands_still_holds_up_nobody(self):
        ends = os.pipe()
        server = subprocess.Popen(
            [os.environ["ROLLGAITD"], "--data-dir", self.directory.name + "/still", "--listen", "127.0.0.1:0",
             "--solver", os.environ["SLOW_SOLVER"], "--log-level", "debug"], stdout=subprocess.PIPE, stderr=ends[1])
        os.close(ends[1])
        address = server.stdout.readline().decode().strip().removeprefix("rollgaitd listening on ")
        with grpc.insecure_channel(address) as channel:
            for _ in range(2000):  # 0.4 KB of log each; a pipe holds 64 KB
                ask(channel)
        server.terminate()
        self.assertEqual(server.wait(60), 0)
        server.stdout.close()
        os.close(ends[0])

    def test_beyond_loopback_a_door_is_asked_for(self):
        for flags, word in ((("--listen", "0.0.0.0:0"), "--without-door"),
                            (("--listen", "0.0.0.0:0", "--without-door"), "--insecure-listen"),
                            (("--listen", "127.0.0.1:0", "--behind-door"), "unix:/PATH")):
            ended = subprocess.run([os.environ["ROLLGAITD"], "--data-dir", self.directory.name + "/none", *flags],
                                   capture_output=True, text=True, timeout=60, check=False)
            self.assertEqual(ended.returncode, 1)
            self.assertIn(word, ended.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=1)
