"""rollgait-gateway in front of a real rollgaitd: every kind of answer, streams that go on, and requests that mean harm.

  gateway_test.py [TEST...]    environment: ROLLGAITD, ROLLGAIT_GATEWAY, SLOW_SOLVER, ROLLGAIT_SOURCE

Asserts answers and memory, not times.
"""
import contextlib
import json
import os
import select
import signal
import socket
import subprocess
import tempfile
import threading
import time
import unittest

import openapi_check
from gateway_service import SOURCE, Answer, Events, Service, memory

MOST_MIB = 256
MOST_BODY = 4 << 20
TRACE = "4bf92f3577b34da6a3ce929d0e0e4736"


def token(service, *scopes):
    return subprocess.run([os.environ["ROLLGAITD"], "token", "create", "--data-dir", service.directory + "/data", "--tenant", "lab",
                           "--scopes", ",".join(scopes)], check=True, capture_output=True, text=True).stdout.strip()


def until(holds):
    """Waits for what other threads and processes do."""
    for _ in range(600):
        if holds():
            return
        time.sleep(0.05)
    raise AssertionError("this has not come to be within 30 s")


def halt(process):
    """Stops every thread of a process; the signal alone lets those that run go on for a while."""
    process.send_signal(signal.SIGSTOP)

    def halted(thread):
        with open(f"/proc/{process.pid}/task/{thread}/stat", encoding="ascii") as stat:
            return stat.read().rpartition(")")[2].split()[0] == "T"

    until(lambda: all(map(halted, os.listdir(f"/proc/{process.pid}/task"))))


class WithService(unittest.TestCase):
    flags, gateway_flags = (), ()

    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory(prefix="rollgait-gateway-")
        cls.service = Service(cls.place.name + "/service", cls.flags, cls.gateway_flags)

    @classmethod
    def tearDownClass(cls):
        try:
            cls.service.stop()  # asserts that both programs end with 0
        finally:
            cls.place.cleanup()

    def refused(self, answer, status, code, *words):
        self.assertEqual(answer.status, status, answer.text)
        error = answer.error()
        self.assertEqual((error["code"], error["status"]), (status, code))
        for word in words:
            self.assertIn(word, error["message"])
        return error


class Calls(WithService):
    def test_create_watch_resume_get_list_delete(self):
        name = self.service.create(iterations=100, labels={"lab": "gait 1"})
        first = Events(self.service, f"/v1/{name}:watch")
        seen = []
        for event in first:
            seen.append(event)
            if len(seen) == 20:
                break
        first.close()
        rest = Events(self.service, f"/v1/{name}:watch?iteratesPerSecond=1", last_event_id=seen[-1]["id"]).all()
        self.assertEqual(rest[-1], {"event": "end", "data": {}})
        events = seen + rest[:-1]
        self.assertEqual([int(event["id"]) for event in events], list(range(1, len(events) + 1)))
        self.assertEqual([event["data"]["sequence"] for event in events], [event["id"] for event in events])
        self.assertEqual(sum(event["event"] == "iteration" for event in events), 100)
        self.assertEqual(events[-1]["event"], "finished")
        # Nothing follows: an EventSource that asks again is told to stop.
        self.assertEqual(self.service.ask("GET", f"/v1/{name}:watch", headers={"Last-Event-ID": events[-1]["id"]}).status, 204)
        self.refused(self.service.ask("GET", f"/v1/{name}:watch", headers={"Last-Event-ID": "100000"}), 400, "OUT_OF_RANGE")
        self.refused(self.service.ask("GET", f"/v1/{name}:watch", headers={"Last-Event-ID": "x"}), 400, "INVALID_ARGUMENT", "Last-Event-ID")

        solve = self.service.ask("GET", "/v1/" + name)
        self.assertEqual(solve.headers["Content-Type"], "application/json")
        self.assertEqual(solve.json()["state"], "SOLVE_STATE_SUCCEEDED")
        self.assertEqual(solve.json()["result"]["message"], "from the test's solver")
        other = self.service.create(iterations=1, labels={"lab": "gait 2"})
        self.service.wait_for_state(other, "SOLVE_STATE_SUCCEEDED")

        def names(query):
            return [solve["name"] for solve in self.service.ask("GET", "/v1/solves?" + query).json().get("solves", [])]
        self.assertEqual(names("filter.labels%5Blab%5D=gait+1"), [name])
        self.assertEqual(names("filter.labels.lab=gait%202&filter.states=SOLVE_STATE_SUCCEEDED&filter.states=SOLVE_STATE_FAILED"), [other])
        self.assertEqual(names("filter.createTimeBefore=2020-01-01T00:00:00Z"), [])
        self.assertEqual(names("filter.model=planar&pageSize=1"), [other])
        page = self.service.ask("GET", "/v1/solves?pageSize=1").json()
        self.assertEqual(names("pageSize=1&pageToken=" + page["nextPageToken"])[:1], [name])

        self.assertEqual(self.service.ask("DELETE", "/v1/" + name).json(), {})
        self.refused(self.service.ask("GET", "/v1/" + name), 404, "NOT_FOUND", name)
        self.refused(self.service.ask("GET", f"/v1/{name}:watch"), 404, "NOT_FOUND", name)

    def test_cancel(self):
        name = self.service.create(iterations=3000)
        self.refused(self.service.ask("DELETE", "/v1/" + name), 412, "FAILED_PRECONDITION")
        with contextlib.closing(Events(self.service, f"/v1/{name}:watch")) as events:
            kinds = []
            for event in events:
                kinds.append(event["event"])
                if kinds.count("iteration") == 5:
                    self.assertEqual(self.service.ask("POST", f"/v1/{name}:cancel").status, 200)
        self.assertEqual(kinds[-2:], ["finished", "end"])
        self.assertEqual(self.service.ask("GET", "/v1/" + name).json()["state"], "SOLVE_STATE_CANCELLED")

    def test_many_at_once(self):
        spec = {"model": {"name": "planar"}, "solverLimits": {"maxIterations": 7}}
        requests = [{"spec": dict(spec, slopeRad=slope / 100), "labels": {"sweep": "a"}} for slope in range(3)]
        made = self.service.ask("POST", "/v1/solves:batchCreate", {"requests": requests})
        names = {solve["name"] for solve in made.json()["solves"]}
        self.assertEqual(len(names), 3)
        for events in (Events(self.service, "/v1/solves:watch?labels.sweep=a"),
                       Events(self.service, "/v1/solves:watch", "POST", {"solves": [{"name": name} for name in names]})):
            events = events.all()
            self.assertEqual({event["data"]["name"] for event in events if event["event"] == "finished"}, names)
            self.assertEqual(events[-1], {"event": "end", "data": {}})
        run = Events(self.service, "/v1/solves:run", "POST", {"spec": dict(spec, slopeRad=0.2)}).all()
        self.assertEqual([event["event"] for event in run[-2:]], ["finished", "end"])

    def test_models_and_scenes(self):
        self.assertIn("planar", [model["name"] for model in self.service.ask("GET", "/v1/models").json()["models"]])
        model = self.service.ask("GET", "/v1/models:get?model.name=planar&model.bodyMassKg=80").json()
        self.assertEqual(self.service.ask("POST", "/v1/models:get", {"model": {"name": "planar", "bodyMassKg": 80}}).json(), model)
        stored = self.service.ask("POST", "/v1/models?modelId=mine", model)
        self.assertEqual(stored.status, 200, stored.text)
        self.assertEqual(self.service.ask("GET", "/v1/models/mine").json(), stored.json())
        self.assertEqual(self.service.ask("DELETE", "/v1/models/mine").status, 200)
        self.refused(self.service.ask("GET", "/v1/models/mine"), 404, "NOT_FOUND")
        with open(SOURCE + "/scenes/ball_flat.json", encoding="utf-8") as file:
            scene = json.load(file)
        events = Events(self.service, "/v1/scenes:simulate", "POST", {"scene": scene}).all()
        self.assertEqual([event["event"] for event in events[-2:]], ["report", "end"])
        self.assertEqual(events[0]["event"], "samples")
        scene["joints"] = []
        error = self.refused(self.service.ask("POST", "/v1/scenes:simulate", {"scene": scene}), 400, "INVALID_ARGUMENT")
        self.assertIn("joints", error["details"][0]["fieldViolations"][0]["field"])

    def test_what_is_refused(self):
        ask = self.service.ask
        error = self.refused(ask("POST", "/v1/solves", {"spec": {"model": {"name": "planar"}, "slopeRad": 9}}), 400, "INVALID_ARGUMENT")
        self.assertEqual(error["details"][0]["fieldViolations"][0]["field"], "spec.slope_rad")
        self.refused(ask("POST", "/v1/solves", {"spec": {"modl": 1}}), 400, "INVALID_ARGUMENT", "modl")
        self.refused(ask("GET", "/v1/solves?filter.nothing=1"), 400, "INVALID_ARGUMENT", "filter.nothing")
        spec = {"model": {"name": "planar"}, "solverLimits": {"maxIterations": 1}}
        self.assertEqual(ask("POST", "/v1/solves", {"spec": spec, "requestId": "r"}).status, 200)
        self.refused(ask("POST", "/v1/solves", {"spec": dict(spec, slopeRad=0.1), "requestId": "r"}), 409, "ALREADY_EXISTS")
        self.refused(ask("POST", "/v1/solves", b"{}", {"Content-Type": "text/plain"}), 415, "INVALID_ARGUMENT", "application/json")
        for verb, path, allowed in (("PUT", "/v1/solves", "POST, GET, HEAD"), ("POST", "/v1/openapi.json", "GET, HEAD"),
                                    ("DELETE", "/v1/solves:run", "POST")):
            answer = ask(verb, path)
            self.refused(answer, 405, "UNIMPLEMENTED", allowed)
            self.assertEqual(answer.headers["Allow"], allowed)
        self.assertEqual(ask("HEAD", "/v1/solves/a:watch").status, 405)
        self.refused(ask("GET", "/v1/nothing"), 404, "NOT_FOUND", "openapi.json")

    def test_head(self):
        for path in ("/v1/models:get?model.name=planar", "/v1/openapi.json"):  # the same at any time
            answer = self.service.ask("HEAD", path)
            whole = self.service.ask("GET", path)
            self.assertEqual((answer.status, answer.text, answer.headers["Content-Length"]), (200, "", str(len(whole.text.encode()))))

    def test_a_trace_goes_on(self):
        # Of refused calls the log tells at its usual level.
        self.assertEqual(self.service.ask("GET", "/v1/solves/none", headers={"traceparent": f"00-{TRACE}-00f067aa0ba902b7-01"}).status, 404)
        until(lambda: TRACE in self.service.logged())

    def test_health(self):
        command = [os.environ["ROLLGAIT_GATEWAY"], "--health", "--listen"]
        host, port = self.service.address
        for where in (host, "*", ""):  # of a gateway that listens everywhere, loopback is asked
            self.assertEqual(subprocess.run([*command, f"{where}:{port}"], timeout=60).returncode, 0)
        self.assertEqual(subprocess.run([*command, "unix:/nowhere"], stderr=subprocess.DEVNULL, timeout=60).returncode, 1)

    def test_document(self):
        answer = self.service.ask("GET", "/v1/openapi.json")
        document = answer.json()
        self.assertEqual(openapi_check.problems(document), [])
        printed = subprocess.run([os.environ["ROLLGAIT_GATEWAY"], "--openapi"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(printed, answer.text)
        # What is answered is what the document says.
        name = self.service.create(iterations=2)
        self.service.wait_for_state(name, "SOLVE_STATE_SUCCEEDED")
        asked = [("/v1/solves/{solve}", self.service.ask("GET", "/v1/" + name)), ("/v1/solves", self.service.ask("GET", "/v1/solves")),
                 ("/v1/models", self.service.ask("GET", "/v1/models")), ("/v1/serverInfo", self.service.ask("GET", "/v1/serverInfo")),
                 ("/v1/models:get", self.service.ask("GET", "/v1/models:get?model.name=human29"))]
        for path, answer in asked:
            schema = document["paths"][path]["get"]["responses"]["200"]["content"]["application/json"]["schema"]
            self.assertEqual(openapi_check.mismatches(document, schema, answer.json(), path), [])

    def test_browsers_of_other_sites_are_refused(self):
        ask, (host, port) = self.service.ask, self.service.address
        self.refused(ask("GET", "/v1/solves", headers={"Origin": "https://evil.example"}), 403, "PERMISSION_DENIED", "--allow-origin")
        self.refused(ask("GET", "/v1/solves", headers={"Host": f"evil.example:{port}"}), 403, "PERMISSION_DENIED", "127.0.0.1")
        self.refused(ask("OPTIONS", "/v1/solves", headers={"Origin": "https://evil.example"}), 403, "PERMISSION_DENIED")
        own = ask("GET", "/v1/solves", headers={"Origin": f"http://{host}:{port}"})
        self.assertEqual((own.status, "Access-Control-Allow-Origin" in own.headers), (200, False))
        self.assertEqual(ask("GET", "/v1/solves", headers={"Host": f"LocalHost:{port}"}).status, 200)


class Limited(WithService):
    """Who calls is asked, a page of another site may ask, one solve may wait, few streams, short calls."""
    flags = ("--require-token", "--max-queued", "1", "--tenant-max-queued", "1")
    gateway_flags = ("--allow-origin", "https://lab.example", "--max-streams", "3", "--max-streams-per-peer", "2", "--call-time", "1")

    def test_tokens(self):
        refused = self.service.ask("GET", "/v1/solves")
        self.refused(refused, 401, "UNAUTHENTICATED")
        self.assertEqual(refused.headers["WWW-Authenticate"], "Bearer")
        self.refused(self.service.ask("GET", "/v1/solves", headers={"Authorization": "Bearer rgt_no"}), 401, "UNAUTHENTICATED")
        self.refused(self.service.ask("GET", "/v1/solves/a:watch"), 401, "UNAUTHENTICATED")
        reader = {"Authorization": "Bearer " + token(self.service, "read")}
        self.assertEqual(self.service.ask("GET", "/v1/solves", headers=reader).status, 200)
        self.assertEqual(self.service.ask("GET", "/v1/serverInfo", headers=reader).json()["caller"]["tenant"], "lab")
        self.refused(self.service.ask("POST", "/v1/solves", {}, reader), 403, "PERMISSION_DENIED", "solve")
        # Without a door in front nobody's word counts for the peer's address.
        self.assertEqual(self.service.ask("GET", "/v1/solves", headers={**reader, "x-rollgait-peer": "ipv4:1.2.3.4:5"}).status, 200)

    def test_origin(self):
        reader = {"Authorization": "Bearer " + token(self.service, "read"), "Origin": "https://lab.example"}
        answer = self.service.ask("GET", "/v1/solves", headers=reader)
        self.assertEqual((answer.status, answer.headers["Access-Control-Allow-Origin"]), (200, "https://lab.example"))
        asked_first = self.service.ask("OPTIONS", "/v1/solves/a", headers={"Origin": "https://lab.example"})
        self.assertEqual((asked_first.status, asked_first.headers["Access-Control-Allow-Methods"]), (204, "GET, HEAD, DELETE"))
        for name in ("last-event-id", "traceparent"):
            self.assertIn(name, asked_first.headers["Access-Control-Allow-Headers"])
        document = self.service.ask("OPTIONS", "/v1/openapi.json", headers={"Origin": "https://lab.example"})
        self.assertEqual((document.status, document.headers["Access-Control-Allow-Methods"]), (204, "GET, HEAD"))
        # A page can read refusals, too, whoever refuses.
        for refused, status in ((self.service.ask("GET", "/v1/solves", headers={"Origin": "https://lab.example"}), 401),
                                (self.service.ask("POST", "/v1/solves", b"", {**reader, "Content-Length": str(MOST_BODY + 1)}), 413)):
            self.assertEqual(refused.status, status)
            self.assertEqual(refused.headers["Access-Control-Allow-Origin"], "https://lab.example")
            self.assertIn("Retry-After", refused.headers["Access-Control-Expose-Headers"])

    def test_long_bodies_are_asked_for_after_the_caller(self):
        def head(bytes, *headers):
            return "\r\n".join(["POST /v1/solves HTTP/1.1", "Host: localhost", "Content-Type: application/json", f"Content-Length: {bytes}",
                                *headers, "", ""]).encode()
        for headers in ((), ("Authorization: Bearer rgt_no",)):
            with socket.create_connection(self.service.address, timeout=60) as peer:
                peer.sendall(head(1_000_000, *headers))  # and nothing more
                self.assertIn(b" 401 ", peer.recv(4096).split(b"\r\n")[0])
        body = json.dumps({"spec": {}}).encode() + b" " * 1_000_000
        solver, reader = token(self.service, "solve"), token(self.service, "read")
        self.refused(self.service.ask("POST", "/v1/solves", body, {"Authorization": "Bearer " + solver}), 400, "INVALID_ARGUMENT")
        self.refused(self.service.ask("POST", "/v1/solves", body, {"Authorization": "Bearer " + reader}), 403, "PERMISSION_DENIED")

    def test_full_and_too_late(self):
        caller = {"Authorization": "Bearer " + token(self.service, "read", "solve")}
        names, full = [], None
        for slope in range(12):
            spec = {"model": {"name": "planar"}, "solverLimits": {"maxIterations": 3000}, "slopeRad": slope / 100}
            answer = self.service.ask("POST", "/v1/solves", {"spec": spec}, caller)
            if answer.status != 200:
                full = answer
                break
            names.append(answer.json()["name"])
        self.refused(full, 429, "RESOURCE_EXHAUSTED")
        self.assertGreaterEqual(int(full.headers["Retry-After"]), 1)
        # Of two streams there is no third, and the place of one that went is free again.
        streams = [Events(self.service, f"/v1/{names[0]}:watch", headers=caller) for _ in range(2)]
        self.assertEqual([stream.status for stream in streams], [200, 200])
        self.refused(self.service.ask("GET", f"/v1/{names[0]}:watch", headers=caller), 503, "UNAVAILABLE", "2 streams of your address")
        streams[0].close()
        until(lambda: self.service.ask("GET", f"/v1/{names[0]}:watch?afterSequence=9999999", headers=caller).status != 503)
        streams[1].close()
        # A server that stands still.
        halt(self.service.rollgaitd)
        try:
            self.refused(self.service.ask("GET", "/v1/solves", headers=caller), 504, "DEADLINE_EXCEEDED")
        finally:
            self.service.rollgaitd.send_signal(signal.SIGCONT)
        for name in names:
            self.service.ask("POST", f"/v1/{name}:cancel", headers=caller)


class Stopped(unittest.TestCase):
    def test_rollgaitd_goes_and_comes(self):
        with tempfile.TemporaryDirectory() as place:
            service = Service(place + "/service")
            name = service.create(iterations=3000)
            events = Events(service, f"/v1/{name}:watch")
            iterator = iter(events)
            number = next(iterator)["id"]
            service.rollgaitd.send_signal(signal.SIGTERM)
            last = list(iterator)[-1]
            events.close()
            self.assertEqual((last["event"], last["data"]["error"]["code"]), ("end", 503))
            service.rollgaitd.wait(60)
            service.rollgaitd.stdout.close()
            self.assertEqual(service.ask("GET", "/v1/solves").status, 503)
            service.start_rollgaitd(())
            until(lambda: service.ask("GET", "/v1/serverInfo").status == 200)
            events = Events(service, f"/v1/{name}:watch", last_event_id=number)
            following = next(iter(events))
            self.assertEqual(int(following["id"]), int(number) + 1)
            # The gateway stops although a stream is open, and half a request.
            with socket.create_connection(service.address) as half, socket.create_connection(service.address) as head:
                half.sendall(b"POST /v1/solves HTTP/1.1\r\nHost: localhost\r\nContent-Length: 10\r\n\r\n{")
                head.sendall(b"GET /v1/solves HTTP/1.1\r\nHost: loc")
                self.assertEqual(service.ask("GET", "/v1/serverInfo").status, 200)  # both have been read
                service.stop()
            events.close()

    def test_the_gateway_stops(self):
        """Calls are answered, streams are told, and who gets no answer is told that, too."""
        for continues in (True, False):
            with tempfile.TemporaryDirectory() as place:
                service = Service(place + "/service")
                events = Events(service, f"/v1/{service.create(iterations=3000)}:watch")
                iterator = iter(events)
                next(iterator)
                halt(service.rollgaitd)
                call = service.connect()
                call.request("GET", "/v1/serverInfo")
                self.assertEqual(service.ask("GET", "/v1/openapi.json").status, 200)  # the call has been read, too
                service.gateway.send_signal(signal.SIGTERM)
                last = list(iterator)[-1]
                events.close()
                self.assertEqual((last["event"], last["data"]["error"]["code"]), ("end", 503))
                self.assertIn("the gateway stops", last["data"]["error"]["message"])
                if continues:
                    service.rollgaitd.send_signal(signal.SIGCONT)
                with contextlib.closing(call):
                    answer = Answer(call.getresponse())
                service.rollgaitd.send_signal(signal.SIGCONT)
                self.assertEqual(answer.status, 200 if continues else 503, answer.text)
                service.stop()

    def test_flags_that_would_open_it(self):
        for flags, word in ((["--listen", "0.0.0.0:0"], "loopback"), (["--server", "gait.example:50051"], "plain text"),
                            (["--listen", "127.evil.example:0"], "loopback"),
                            (["--behind-door"], "unix:"), (["--allow-origin", "*"], "origin"), (["--allow-origin", "https://a/b"], "origin")):
            done = subprocess.run([os.environ["ROLLGAIT_GATEWAY"], *flags], capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 1, flags)
            self.assertIn(word, done.stderr)


class Harm(WithService):
    def tearDown(self):
        self.assertIsNone(self.service.gateway.poll(), self.service.logged()[-3000:])
        self.assertEqual(self.service.ask("GET", "/v1/serverInfo").status, 200)
        self.assertLess(memory(self.service.gateway), MOST_MIB)

    def raw(self, data):
        """What comes back until the server closes."""
        with socket.create_connection(self.service.address, timeout=60) as peer:
            with contextlib.suppress(ConnectionError):
                peer.sendall(data)
            answer = b""
            with contextlib.suppress(ConnectionError):
                while piece := peer.recv(65536):
                    answer += piece
            return answer

    def status(self, data):
        """Of the one answer to it; 0: it is closed without one."""
        answer = self.raw(data)
        self.assertTrue(answer == b"" or answer.startswith(b"HTTP/1.1 "), answer[:200])
        return int(answer.split()[1]) if answer else 0

    def test_bytes_that_no_call_can_carry(self):
        for value in (b"Bearer \xe9", b"Bearer \xff\xfe", b"a\x01b", b"a\x7fb", b"a\tb", "Bearer é".encode()):
            head = b"GET /v1/serverInfo HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nAuthorization: " + value + b"\r\n"
            self.assertEqual(self.status(head + b"\r\n"), 400, value)
            self.assertEqual(self.status(head.replace(b"GET", b"POST").replace(b"serverInfo", b"solves") +
                                         b"Content-Type: application/json\r\nContent-Length: 100000\r\n\r\n"), 400, value)
        trace = b"GET /v1/serverInfo HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\ntraceparent: \xe9\r\nx-rollgait-peer: \xe9\r\n\r\n"
        self.assertEqual(self.status(trace), 200)

    def test_bodies(self):
        head = "POST /v1/solves HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Type: application/json\r\n"
        for rest, status in ((f"Content-Length: {MOST_BODY + 1}\r\n\r\n", 413),
                             ("Transfer-Encoding: chunked\r\n\r\n5\r\n{}\r\n0\r\n\r\n", 411),
                             ("Content-Length: 2\r\nContent-Length: 3\r\n\r\n{}", 400),
                             ("Content-Length: 2\r\nTransfer-Encoding: chunked\r\n\r\n{}", 400),
                             ("Transfer-Encoding: chunked\r\nContent-Length: 2\r\n\r\n{}", 400),
                             ("Content-Length: -2\r\n\r\n{}", 400),
                             ("Content-Length: 99999999999999999999\r\n\r\n{}", 413)):
            self.assertEqual(self.status((head + rest).encode()), status, rest)

        def filled(begin, entry, end):
            """As many entries as fit."""
            count = (MOST_BODY - len(begin) - len(end)) // (len(entry % 0xFFFFFF) + 1)
            return begin + b",".join(entry % i for i in range(count)) + end
        for body in (b'{"spec":' + b"[" * MOST_BODY, b'{"spec":' * 2_000_000, b'{"requestId":"' + b"\xff" * 1000 + b'"}',
                     filled(b'{"labels":{', b'"%x":""', b"}}"), filled(b'{"spec":{"model":{"segmentLengthsM":{', b'"%x":1', b"}}}}"),
                     b'{"spec":{"model":{"loads":[' + b"{}," * (MOST_BODY // 3 - 20) + b"{}]}}}",
                     b'{"spec":{"phases":[' + b"{}," * (MOST_BODY // 3 - 10) + b"{}]}}", b"\0" * 100_000, b'"' + b"\\u0000" * 2_000_000):
            answer = self.service.ask("POST", "/v1/solves", body[:MOST_BODY])
            self.assertIn(answer.status, (400, 413), answer.text)
            self.assertLess(len(answer.text), 10_000)
            self.assertLess(memory(self.service.gateway), MOST_MIB, body[:100])

    def test_long_bodies_are_few_at_a_time(self):
        def stall():
            peer = socket.create_connection(self.service.address)
            peer.sendall(b"POST /v1/solves HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n" % MOST_BODY
                         + b" " * 10_000)
            return peer
        peers = [stall() for _ in range(4)]
        # Once the last of the four is read.
        until(lambda: self.service.ask("POST", "/v1/solves", b" " * 100_000).status == 503)
        answer = self.service.ask("POST", "/v1/solves", b" " * 100_000)
        self.refused(answer, 503, "UNAVAILABLE", "4 long bodies of your address")
        self.assertEqual(answer.headers["Retry-After"], "1")
        self.assertEqual(self.service.ask("POST", "/v1/solves", b" " * 10_000).status, 400)
        # Two go; two stand still, and are closed.
        for peer in peers[:2]:
            peer.close()
        until(lambda: self.service.ask("POST", "/v1/solves", b" " * 100_000).status == 400)
        for peer in peers[2:]:
            peer.settimeout(60)
            with contextlib.suppress(ConnectionError):
                self.assertEqual(peer.recv(1), b"")
            peer.close()

    def test_heads(self):
        many = "".join(f"x-{i}: {i}\r\n" for i in range(10_000))
        self.assertEqual(self.status(f"GET /v1/solves HTTP/1.1\r\nHost: localhost\r\n{many}\r\n".encode()), 431)
        self.assertIn(self.status(b"GET /v1/solves HTTP/1.1\r\nHost: localhost\r\nx: " + b"y" * 10_000_000 + b"\r\n\r\n"), (0, 431))
        self.assertIn(self.status(b"GET /" + b"v" * 10_000_000 + b" HTTP/1.1\r\n\r\n"), (0, 414))
        twice = b"GET /v1/solves HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nAuthorization: a\r\nAuthorization: b\r\n\r\n"
        self.assertIn(b"authorization is given twice", self.raw(twice))
        query = "&".join("filter.states=1" for _ in range(300))
        self.refused(self.service.ask("GET", "/v1/solves?" + query), 400, "INVALID_ARGUMENT", "256")

    def test_paths(self):
        for path in ("/../etc/passwd", "/v1/../../etc/passwd", "/v1/solves/%2e%2e", "/v1/solves/..%2f..%2fetc", "/v1/solves/a%00b", "/v1/%",
                     "//etc/passwd", "/v1/solves/%ff", "*", "http://127.0.0.1/etc/passwd"):
            self.assertEqual(self.status(f"GET {path} HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n".encode()), 404, path)
        for name in ("a" * 8000, "a%27%3B--", "%C3%A9", "-"):
            self.assertIn(self.service.ask("GET", "/v1/solves/" + name).status, (400, 404))

    def test_half_requests_are_closed(self):
        halves = [b"", b"GET", b"GET /v1/solves HTTP/1.1\r\nHost: localhost\r\n", b"GET /v1/solves HTTP/1.1\r\nHost: loc",
                  b"\x16\x03\x01" + b"\0" * 1000]
        threads, answers = [], []
        for half in halves:
            threads.append(threading.Thread(target=lambda data=half: answers.append(self.raw(data))))
            threads[-1].start()
        for thread in threads:
            thread.join()
        self.assertEqual(answers, [b""] * len(halves))  # recv came to its end, or this hangs

    def test_connections_are_bounded(self):
        peers = [socket.create_connection(self.service.address) for _ in range(100)]
        # Of one address 64 are served; the others are closed.
        closed = 0
        while closed < 36:
            readable, _, _ = select.select(peers, [], [], 60)
            self.assertTrue(readable)
            for peer in readable:
                peer.close()
                peers.remove(peer)
                closed += 1
        for peer in peers:
            peer.close()

        def is_served():
            with contextlib.suppress(ConnectionError):
                return self.service.ask("GET", "/v1/serverInfo").status == 200
        until(is_served)

    def test_answers_that_nobody_reads(self):
        model = self.service.ask("GET", "/v1/models:get?model.name=human29")
        peers = []
        for _ in range(50):
            peer = socket.socket()
            peer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
            peer.connect(self.service.address)
            peer.sendall(b"GET /v1/models:get?model.name=human29 HTTP/1.1\r\nHost: localhost\r\n\r\n" * 20)
            peers.append(peer)
        self.assertEqual(self.service.ask("GET", "/v1/models:get?model.name=human29").text, model.text)
        for peer in peers:
            peer.close()


class Slow(WithService):
    gateway_flags = ("--read-time", "2")

    def test_a_stream_that_nobody_reads_is_dropped_and_told_why(self):
        with open(SOURCE + "/scenes/ball_flat.json", encoding="utf-8") as file:
            scene = json.load(file)
        scene["output_step_s"] = scene["duration_s"] / 1_000_000
        body = json.dumps({"scene": scene}).encode()
        peer = socket.socket()
        peer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 2048)
        peer.connect(self.service.address)
        peer.sendall(b"POST /v1/scenes:simulate HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: "
                     + str(len(body)).encode() + b"\r\n\r\n" + body)
        until(lambda: "stream.dropped" in self.service.logged())
        peer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        answer = b""
        while piece := peer.recv(65536):
            answer += piece
        peer.close()
        self.assertIn(b"the client has not read in time", answer)
        self.assertIn(b"event: end", answer)


if __name__ == "__main__":
    unittest.main(verbosity=2)
