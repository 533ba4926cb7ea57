#!/usr/bin/env python3
"""The acceptance tables with the door in place beside those without it: the scenarios of service_load against one rollgaitd each, with TLS
and a token, in turn, so that what else the machine does falls on both.

  beside_door.py BUILD [--seconds 15] [--rounds 3] [--scenarios results,watch,…]

BUILD is a build with -DROLLGAIT_BENCH=ON. Prints a row a scenario: medians over the rounds, and their ratio; what is asked is that neither rate
nor latency is worse by more than 20 %. Exit code 0: so it is, 1: it is not, 2: could not measure. Memory is not looked at: the door has its own.
"""
import argparse
import contextlib
import json
import os
import pathlib
import socket
import statistics
import subprocess
import sys
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
WORST = 1.2
# As service_load gives its own server. Slots: a core each where nothing is said.
SIZES = {"creates": ["--max-queued", "1000000"], "overload": ["--max-queued", "100"]}
SLOTS = {"watch": 20, "first-iteration": os.cpu_count() + 1}
# Of one address, which all clients of this program have: connections, and calls a second.
DOOR = {"ROLLGAIT_DOOR_PER_SOURCE": "64"}
# The door lets an address make 3000 calls a second; overload asks for as many, drawn at random.
RATES = {"overload": ["--rate", "2800"]}


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(port):
    deadline = time.monotonic() + 60
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port), 5).close()
        except OSError:
            if time.monotonic() > deadline:
                raise
            time.sleep(0.05)


def identity(directory):
    """The certificate of an authority and of "localhost"."""
    run = lambda *words: subprocess.run(["openssl", *words], check=True, capture_output=True, cwd=directory)
    key = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes")
    run("req", "-x509", *key, "-days", "2", "-keyout", "ca.key", "-out", "ca.crt", "-subj", "/CN=authority")
    run("req", *key, "-keyout", "tls.crt.key", "-out", "tls.csr", "-subj", "/CN=localhost")
    pathlib.Path(directory, "extension").write_text("subjectAltName=DNS:localhost,IP:127.0.0.1", encoding="utf-8")
    run("x509", "-req", "-in", "tls.csr", "-CA", "ca.crt", "-CAkey", "ca.key", "-CAcreateserial", "-days", "2", "-out", "tls.crt",
        "-extfile", "extension")
    pathlib.Path(directory, "tls.key").write_bytes(pathlib.Path(directory, "tls.crt.key").read_bytes())


@contextlib.contextmanager
def serve(build, directory, flags, slots, with_door):
    """The address of a new server, and the file of a token."""
    os.mkdir(f"{directory}/run")
    port, own, started = free_port(), f"{directory}/run", []
    listen = ["--listen", f"unix:{own}/door.sock", "--behind-door"] if with_door else [
        "--listen", f"127.0.0.1:{port}", "--tls-cert", f"{directory}/tls.crt", "--tls-key", f"{directory}/tls.key"]
    with open(f"{directory}/log", "ab") as log:
        try:
            started.append(subprocess.Popen(
                [f"{build}/bin/rollgaitd", "--data-dir", f"{own}/data", "--require-token", "--log-level", "warning", "--solver-slots",
                 str(slots), *listen, *flags], stdout=subprocess.PIPE, stderr=log))
            started[0].stdout.readline()
            if with_door:
                started.append(subprocess.Popen(
                    ["haproxy", "-db", "-f", f"{SOURCE}/docker/door/haproxy.cfg"], stdout=log, stderr=log,
                    env={**os.environ, **DOOR, "PATH": os.environ["PATH"] + ":/usr/sbin", "ROLLGAIT_DOOR_LISTEN": f"127.0.0.1:{port}",
                         "ROLLGAIT_DOOR_SOCKET": f"{own}/door.sock", "ROLLGAIT_DOOR_CERTIFICATE": f"{directory}/tls.crt"}))
            wait_for(port)
            token = subprocess.run([f"{build}/bin/rollgaitd", "token", "create", "--data-dir", f"{own}/data", "--tenant", "load",
                                    "--scopes", "read,solve"], check=True, capture_output=True, text=True).stdout
            pathlib.Path(own, "token").write_text(token, encoding="utf-8")
            yield f"localhost:{port}", f"{own}/token"
        finally:
            for process in reversed(started):
                process.terminate()
                process.wait(60)
            started[0].stdout.close()
            subprocess.run(["rm", "-r", own], check=True)


def measure(build, directory, scenario, seconds, with_door):
    """The figures of one run."""
    with serve(build, directory, SIZES.get(scenario, []), SLOTS.get(scenario, os.cpu_count()), with_door) as (address, token):
        said = subprocess.run([f"{build}/bin/service_load", scenario, "--json", "--seconds", str(seconds), "--target", address, "--tls-ca",
                               f"{directory}/ca.crt", "--token-file", token, *RATES.get(scenario, [])],
                              capture_output=True, text=True, check=False)
    lines = [line for line in said.stdout.splitlines() if line.startswith('{"scenario"')]
    if said.returncode not in (0, 1) or len(lines) != 1:
        print(f"service_load {scenario}: {said.stdout}{said.stderr}", file=sys.stderr)
        sys.exit(2)
    return json.loads(lines[0])


def figures(row):
    """What is compared: name to value and whether more is better."""
    found = {}
    for name, value in row["figures"].items():
        if isinstance(value, dict) and "p99_ms" in value and name != "sent_late":
            found[f"{name} median ms"], found[f"{name} p99 ms"] = (value["median_ms"], False), (value["p99_ms"], False)
        elif name == "rate":
            found["calls/s"] = (value, True)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--seconds", type=float, default=15)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--scenarios", default="results,watch,creates,first-iteration,overload,stalled-readers")
    options = parser.parse_args()
    met = True
    print("| scenario | figure | without the door | with it | ratio | |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="rollgait-beside-") as directory:
        identity(directory)
        for scenario in options.scenarios.split(","):
            runs = {door: [figures(row) for row in (measure(options.build, directory, scenario, options.seconds, door),)]
                    for door in (False, True)}
            for _ in range(1, options.rounds):
                for door in (False, True):
                    runs[door].append(figures(measure(options.build, directory, scenario, options.seconds, door)))
            for name in runs[False][0]:
                medians = [statistics.median(run[name][0] for run in runs[door] if name in run) for door in (False, True)]
                better = runs[False][0][name][1]
                ratio = medians[1] / medians[0] if medians[0] > 0 else float("inf")
                good = ratio >= 1 / WORST if better else ratio <= WORST
                met = met and good
                print(f"| {scenario} | {name} | {medians[0]:.4g} | {medians[1]:.4g} | {ratio:.2f} | {'met' if good else '**not met**'} |",
                      flush=True)
    return 0 if met else 1


if __name__ == "__main__":
    sys.exit(main())
