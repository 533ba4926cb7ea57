#!/usr/bin/env python3
"""Runs every command of the tutorial, the how-to guides and README.md against a server of its own.

  run_commands.py --bin DIRECTORY --source REPOSITORY --work DIRECTORY [--only TEXT]
  run_commands.py --self-test

A fenced block says what it is: sh and python are run, text and json are what is printed or read. A block of another kind is
refused. The blocks of a page run in order in an empty directory, in which the folders of the repository appear, with the programs
in PATH. A block that cannot run here stands below a line  <!-- not run: REASON -->; all of these are listed at the end.
"""

import argparse
import importlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

RUN, SHOWN = ("sh", "python"), ("text", "json")
FENCE = re.compile(r"(?:^<!-- not run: *(?P<reason>.*?) *-->\n)?^```(?P<kind>[^\n]*)\n(?P<body>.*?)^```$", re.M | re.S)
SECONDS = 1200  # for one block; ends a command that hangs, and nothing else: beside other tests the longest take minutes


class Block:
    def __init__(self, page, text, match):
        self.page, self.kind, self.body, self.reason = page, match["kind"].strip(), match["body"], match["reason"]
        self.line = text[:match.start("body")].count("\n") + 1

    def __str__(self):
        return f"{self.page}:{self.line}"


def blocks_of(page, text):
    """The blocks of a page, and what is wrong with them."""
    blocks = [Block(page, text, match) for match in FENCE.finditer(text)]
    wrong = [f"{b}: a block of kind '{b.kind}'; say one of {', '.join(RUN + SHOWN)}" for b in blocks if b.kind not in RUN + SHOWN]
    wrong += [f"{b}: 'not run' without a reason" for b in blocks if b.reason == ""]
    wrong += [f"{page}: {count} fences, {len(blocks)} blocks: one is not closed"
              for count in [len(re.findall(r"^```", text, re.M))] if count != 2 * len(blocks)]
    return blocks, wrong


def run(block, directory, environment):
    command = ["bash", "-euo", "pipefail", "-c"] if block.kind == "sh" else [environment.get("PYTHON", sys.executable), "-c"]
    try:
        done = subprocess.run(command + [block.body], cwd=directory, env=environment, stdin=subprocess.DEVNULL, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return f"{block}: no end within {SECONDS} s:\n{block.body}"
    if done.returncode == 0:
        return None
    return f"{block}: exit code {done.returncode}:\n{block.body}\n{done.stdout[-3000:]}"


def run_page(page, text, environment, work, source):
    """What went wrong, how many blocks ran, and which did not."""
    blocks, wrong = blocks_of(page, text)
    directory = work / re.sub(r"\W+", "_", page)
    directory.mkdir(parents=True)
    for entry in source.iterdir() if source else []:
        if entry.name not in ("build", ".git"):
            (directory / entry.name).symlink_to(entry)
    ran, left = 0, []
    for block in blocks:
        if block.kind not in RUN:
            continue
        if block.reason:
            left.append(f"{block}: {block.reason}")
        elif block.kind == "python" and "import rollgait" in text and environment.get("NO_PYTHON_CLIENT"):
            left.append(f"{block}: {environment['NO_PYTHON_CLIENT']}")
        else:
            problem = run(block_with_imports(block, blocks), directory, environment)
            ran += 1
            if problem:  # later blocks of the page need what this one did not make
                return wrong + [problem], ran, left
    return wrong, ran, left


def block_with_imports(block, blocks):
    """The Python blocks of a page are one script in pieces: a later one goes on after those before it."""
    if block.kind == "python":
        before = [b.body for b in blocks if b.kind == "python" and b.line < block.line and not b.reason]
        block.body = "".join(before) + block.body
    return block


def start_server(programs, work):
    socket = "unix:" + str(work / "socket")
    server = subprocess.Popen([programs / "rollgaitd", "--data-dir", work / "data", "--listen", socket, "--log-level", "error"],
                              stdout=subprocess.PIPE, text=True)
    line = server.stdout.readline()
    if not line.startswith("rollgaitd listening on "):
        sys.exit(f"the server did not start: {line}")
    return server, socket


def run_all(options):
    shutil.rmtree(options.work, ignore_errors=True)
    options.work.mkdir(parents=True)
    environment = dict(os.environ, PATH=f"{options.bin}:{os.environ['PATH']}", HOME=str(options.work), PYTHONPATH=str(options.work / "python"),
                       MPLBACKEND="Agg", NO_COLOR="1")
    environment.pop("ROLLGAIT_TOKEN", None)
    try:
        for module in ("grpc", "google.protobuf", "numpy", "matplotlib"):
            importlib.import_module(module)
        client = options.source / "client" / "python"
        shutil.copytree(client / "rollgait", options.work / "python" / "rollgait", ignore=shutil.ignore_patterns("v1", "__pycache__"))
        subprocess.run([sys.executable, client / "make_messages.py", "--into", options.work / "python"], check=True)
    except ImportError as error:
        environment["NO_PYTHON_CLIENT"] = f"{sys.executable} has no {error.name}"
    pages = [options.source / "README.md"] + sorted((options.source / "docs" / "tutorial").glob("*.md")) + sorted(
        (options.source / "docs" / "how-to").glob("*.md"))
    problems, count, left = [], 0, []
    with tempfile.TemporaryDirectory(prefix="rollgait-docs-") as place:
        server, environment["ROLLGAIT_SERVER"] = start_server(options.bin, pathlib.Path(place))
        try:
            for page in pages:
                name = page.relative_to(options.source).as_posix()
                if options.only in name:
                    wrong, ran, skipped = run_page(name, page.read_text(encoding="utf-8"), environment, options.work, options.source)
                    print(f"{name}: {ran} blocks run, {len(skipped)} not", flush=True)
                    problems, count, left = problems + wrong, count + ran, left + skipped
        finally:
            server.send_signal(signal.SIGTERM)
            server.wait(timeout=60)
    print("Not run:\n  " + "\n  ".join(left))
    if problems:
        sys.exit("\n".join(problems))
    print(f"{count} blocks of {len(pages)} pages ran, {len(left)} are marked as not run.")


def self_test():
    good = "```sh\necho made > file\n```\n```sh\ntest -s file\n```\n```text\nmade\n```\n"
    cases = [
        (good, None),
        (good + "<!-- not run: needs a cluster -->\n```sh\nfalse\n```\n", None),
        (good + "```sh\nfalse\ntrue\n```\n", "page.md:11: exit code 1"),
        (good + "```sh\nrollgait-of-yesterday --flag\n```\n", "page.md:11: exit code 127"),
        (good + "```python\nvalue = 1\n```\n```python\nassert value == 2\n```\n", "page.md:14: exit code 1"),
        (good + "```\nrollgait\n```\n", "a block of kind ''"),
        (good + "<!-- not run: -->\n```sh\nfalse\n```\n", "'not run' without a reason"),
        (good + "```sh\ntrue\n", "one is not closed"),
    ]
    for text, refusal in cases:
        with tempfile.TemporaryDirectory() as place:
            problems, _, left = run_page("page.md", text, dict(os.environ), pathlib.Path(place), None)
        if (refusal is None) != (not problems) or (refusal and not any(refusal in p for p in problems)):
            sys.exit(f"expected {refusal}, got {problems} for\n{text}")
        if ("needs a cluster" in text) != (left == ["page.md:12: needs a cluster"]):
            sys.exit(f"what is not run is not listed: {left}")
    print(f"{len(cases) - 2} planted faults were refused.")


def main():
    arguments = argparse.ArgumentParser()
    for name in ("bin", "source", "work"):
        arguments.add_argument("--" + name, type=lambda text: pathlib.Path(text).resolve())
    arguments.add_argument("--only", default="")
    arguments.add_argument("--self-test", action="store_true")
    options = arguments.parse_args()
    if options.self_test:
        self_test()
    else:
        run_all(options)


if __name__ == "__main__":
    main()
