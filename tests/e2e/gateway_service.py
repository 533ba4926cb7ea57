"""rollgaitd with rollgait-gateway in front, and ways to ask it, for gateway_test.py."""
import contextlib
import http.client
import json
import os
import re
import subprocess
import time

SOURCE = os.environ["ROLLGAIT_SOURCE"]


def memory(process, name="VmHWM"):
    """MiB of a process: its peak, or what it holds now (VmRSS)."""
    with open(f"/proc/{process.pid}/status", encoding="utf-8") as status:
        return int(re.search(name + r":\s+(\d+) kB", status.read()).group(1)) // 1024


class Answer:
    def __init__(self, response):
        self.status, self.headers, self.text = response.status, dict(response.getheaders()), response.read().decode()

    def json(self):
        return json.loads(self.text)

    def error(self):
        return self.json()["error"]


class Service:
    def __init__(self, directory, flags=(), gateway_flags=()):
        self.directory = directory
        os.mkdir(directory)
        self.log = open(directory + "/log", "ab")
        self.socket = f"unix:{directory}/rollgaitd.sock"
        self.rollgaitd = self.gateway = None
        self.start_rollgaitd(flags)
        self.start_gateway(gateway_flags)

    def start_rollgaitd(self, flags):
        self.rollgaitd = subprocess.Popen(
            [os.environ["ROLLGAITD"], "--data-dir", self.directory + "/data", "--listen", self.socket, "--solver",
             os.environ["SLOW_SOLVER"], "--solver-slots", "4", *flags], stdout=subprocess.PIPE, stderr=self.log)
        if not self.rollgaitd.stdout.readline().startswith(b"rollgaitd listening on "):
            raise AssertionError("rollgaitd does not start: " + self.logged())

    def start_gateway(self, flags):
        self.gateway = subprocess.Popen(
            [os.environ["ROLLGAIT_GATEWAY"], "--listen", "127.0.0.1:0", "--server", self.socket, *flags],
            stdout=subprocess.PIPE, stderr=self.log)
        line = self.gateway.stdout.readline().decode().strip()
        if not line.startswith("rollgait-gateway listening on "):
            raise AssertionError("the gateway does not start: " + self.logged())
        host, port = line.rsplit(" ", 1)[1].rsplit(":", 1)
        self.address = (host, int(port))

    def stop(self):
        for process in (self.gateway, self.rollgaitd):
            process.terminate()
            code = process.wait(60)
            process.stdout.close()
            if code != 0:
                raise AssertionError(f"exit code {code}: {self.logged()}")
        self.log.close()

    def logged(self):
        with open(self.directory + "/log", encoding="utf-8", errors="replace") as log:
            return log.read()

    def connect(self):
        return http.client.HTTPConnection(*self.address, timeout=20)

    def ask(self, verb, path, body=None, headers=None):
        """The whole answer. A body that is no bytes goes as JSON."""
        connection = self.connect()
        headers = dict(headers or {})
        if body is not None and not isinstance(body, bytes):
            body = json.dumps(body).encode()
        if body is not None:
            headers.setdefault("Content-Type", "application/json")
        try:
            connection.request(verb, path, body=body, headers=headers)
            return Answer(connection.getresponse())
        finally:
            connection.close()

    def create(self, iterations=60, **fields):
        spec = {"model": {"name": "planar"}, "solverLimits": {"maxIterations": iterations}}
        answer = self.ask("POST", "/v1/solves", {"spec": spec, **fields})
        if answer.status != 200:
            raise AssertionError(answer.text)
        return answer.json()["name"]

    def wait_for_state(self, name, *states):
        for _ in range(1200):
            solve = self.ask("GET", "/v1/" + name).json()
            if solve.get("state") in states:
                return solve
            time.sleep(0.05)
        raise AssertionError(f"{name} does not get to {states}: {solve}")


class Events:
    """Server-sent events, read as the standard of HTML says."""

    def __init__(self, service, path, verb="GET", body=None, last_event_id=None, headers=None):
        self.connection = service.connect()
        headers = dict(headers or {})
        if last_event_id is not None:
            headers["Last-Event-ID"] = str(last_event_id)
        if body is not None:
            headers["Content-Type"] = "application/json"
        self.connection.request(verb, path, body=json.dumps(body) if body is not None else None, headers=headers)
        self.response = self.connection.getresponse()
        self.status, self.comments = self.response.status, 0

    def __iter__(self):
        event = {"event": "message", "data": []}
        for line in self.response:
            line = line.decode().rstrip("\n")
            if line == "":
                if event["data"]:
                    event["data"] = json.loads("\n".join(event["data"]))
                    yield event
                event = {"event": "message", "data": []}
            elif line.startswith(":"):
                self.comments += 1
            elif line.startswith("data: "):
                event["data"].append(line[6:])
            else:
                name, value = line.split(": ", 1)
                event[name] = value

    def all(self):
        with contextlib.closing(self):
            return list(self)

    def close(self):
        self.response.close()
        self.connection.close()
