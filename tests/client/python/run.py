#!/usr/bin/env python3
"""Runs the tests of the Python client against a server of their own.

   run.py --rollgaitd PROGRAM --rollgait PROGRAM --source REPOSITORY --work DIR

The package is copied into DIR, where its messages are made, so that the repository stays as it is. Exit code 77, which ctest
takes for "skipped", where a Debian package is missing; the line before says which.
"""
import argparse
import importlib
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

SKIPPED = 77


def main() -> int:
    parser = argparse.ArgumentParser()
    for name in ("rollgaitd", "rollgait", "source", "work"):
        parser.add_argument("--" + name, type=pathlib.Path, required=True)
    options = parser.parse_args()
    for module, package in (("grpc", "python3-grpcio"), ("google.protobuf", "python3-protobuf"),
                            ("numpy", "python3-numpy")):
        try:
            importlib.import_module(module)
        except ImportError:
            print(f"Skipped: {sys.executable} has no {module}; install {package}.")
            return SKIPPED
    client = options.source / "client" / "python"
    shutil.rmtree(options.work, ignore_errors=True)
    shutil.copytree(client / "rollgait", options.work / "rollgait", ignore=shutil.ignore_patterns("v1", "__pycache__"))
    subprocess.run([sys.executable, str(client / "make_messages.py"), "--into", str(options.work)], check=True)
    environment = dict(os.environ, ROLLGAITD=str(options.rollgaitd), ROLLGAIT=str(options.rollgait),
                       ROLLGAIT_PYTHON=str(client), ROLLGAIT_WORK=str(options.work), PYTHONPATH=str(options.work))
    for name in ("ROLLGAIT_SERVER", "ROLLGAIT_TOKEN"):
        environment.pop(name, None)
    here = pathlib.Path(__file__).resolve().parent
    return subprocess.run([sys.executable, "-m", "unittest", "discover", "-s", str(here), "-v"], env=environment).returncode


if __name__ == "__main__":
    sys.exit(main())
