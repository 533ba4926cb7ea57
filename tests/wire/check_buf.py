#!/usr/bin/env python3
"""buf lint and buf breaking of proto/ against the last release, with the rules of tests/wire/buf/buf.yaml.

  check_buf.py ROOT WORK              exit code 1 and a line for each problem; 77: skipped, and the reason
  check_buf.py ROOT WORK --self-test  plants problems that buf must name

buf comes from npm, in the version of tests/wire/buf/package.json with the digests of package-lock.json, into WORK. Where there is no npm or it
reaches no registry, this is skipped; a package with another digest is an error. The last release is the commit that the first line of
tests/wire/released.txt names. check_wire.py compares the same two without buf, on every machine.
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
UNREACHABLE = re.compile(r"ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ETIMEDOUT|ERR_SOCKET_TIMEOUT|ENETUNREACH|EHOSTUNREACH|ENOTCACHED|"
                         r"E40[1347]\b|E5\d\d\b|CERT_|SELF_SIGNED")


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def install(root, work):
    """The path of buf."""
    if shutil.which("npm") is None:
        skip("there is no npm here, and buf comes from it")
    work.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(root / "tests/wire/buf" / name, work / name)
    made = subprocess.run(["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1", "--fetch-timeout=30000"],
                          cwd=work, capture_output=True, text=True, check=False, timeout=240)
    if made.returncode != 0:
        said = made.stdout + made.stderr
        if UNREACHABLE.search(said):
            skip("npm reaches no registry that has buf: " + next((line for line in said.splitlines() if UNREACHABLE.search(line)), ""))
        sys.exit("npm cannot install buf:\n" + said)
    buf = work / "node_modules/.bin/buf"
    if subprocess.run([buf, "--version"], capture_output=True, check=False).returncode != 0:
        skip("buf has no program for this machine")
    return buf


def ask(buf, root, *command):
    """The messages of buf."""
    run = subprocess.run([buf, *command, "--config", root / "tests/wire/buf/buf.yaml", "--error-format", "json"], cwd=command[1],
                         capture_output=True, text=True, check=False)
    if run.returncode not in (0, 100) or run.stderr.strip() and not run.stdout.strip():
        sys.exit(f"buf {command[0]} ended with {run.returncode}: {run.stderr}")
    return [json.loads(line) for line in run.stdout.splitlines()]


def lint(buf, root, place):
    return [f"{found['path']}:{found['start_line']}: {found['type']}: {found['message']}" for found in ask(buf, root, "lint", place)]


def breaks(buf, root, place, before, allowed):
    """Each break once that nobody decided, and rows that allow nothing."""
    found = ask(buf, root, "breaking", place, "--against", before, "--against-config", root / "tests/wire/buf/buf.yaml")
    messages = dict.fromkeys(each["message"] for each in found)
    return [message for message in messages if message not in allowed] + [
        f"tests/wire/buf/allowed.txt: nothing is allowed by: {row}" for row in allowed if row not in messages]


def last_release(root, place):
    """proto/ of it, in `place`."""
    first = (root / "tests/wire/released.txt").read_text(encoding="utf-8").splitlines()[0]
    commit = re.match(r"# proto/ at (\w+);", first)[1]
    archive = subprocess.run(["git", "-C", root, "archive", commit, "proto"], capture_output=True, check=False)
    if archive.returncode != 0:
        skip(f"proto/ passes lint, and there is no history with the last release, {commit}, to compare it with")
    subprocess.run(["tar", "-x", "-C", place], input=archive.stdout, check=True)
    return commit


def self_test(buf, root):
    plants = (("string request_id = 2;", "string requestId = 2;", "FIELD_LOWER_SNAKE_CASE", "request_id"),
              ("string request_id = 2;", "bytes request_id = 2;", None, 'changed type from "string" to "bytes"'),
              ("rpc GetSolve(GetSolveRequest) returns (Solve);", "", None, "GetSolve"),
              ("AUTHENTICATION_OFF = 1;", "OFF = 1;", "ENUM_VALUE_PREFIX", "AUTHENTICATION_OFF"))
    for old, new, rule, word in plants:
        with tempfile.TemporaryDirectory() as place:
            shutil.copytree(root / "proto", f"{place}/proto")
            path = pathlib.Path(place, "proto/rollgait/v1/gait_service.proto")
            text = path.read_text(encoding="utf-8")
            if old not in text:
                sys.exit(f"the self-test looks for what is not there: {old}")
            path.write_text(text.replace(old, new, 1), encoding="utf-8")
            if rule and not any(rule in problem for problem in lint(buf, root, place)):
                sys.exit(f"lint lets {new} through")
            if not any(word in problem for problem in breaks(buf, root, place, root, {})):
                sys.exit(f"breaking lets {new or 'nothing'} in place of {old} through")
    if breaks(buf, root, root, root, {"no such message": "a reason"}) == []:
        sys.exit("a row that allows nothing was let through")
    print(f"{len(plants) + 1} problems were named.")


def main():
    root, work, arguments = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), sys.argv[3:]
    buf = install(root, work)
    if arguments == ["--self-test"]:
        return self_test(buf, root)
    problems = lint(buf, root, root)
    if problems:
        sys.exit("\n".join(problems))
    rows = (root / "tests/wire/buf/allowed.txt").read_text(encoding="utf-8").splitlines()
    allowed = dict(row.split(" | ", 1) for row in rows if row and not row.startswith("#"))
    with tempfile.TemporaryDirectory() as place:
        commit = last_release(root, place)
        problems = breaks(buf, root, root, place, allowed)
    if problems:
        sys.exit("\n".join(problems) + "\nKeep the old field beside a new one, or decide the break: tests/wire/buf/allowed.txt")
    print(f"proto/ passes lint, and breaks nothing of {commit} but {len(allowed)} things that were decided.")


if __name__ == "__main__":
    main()
