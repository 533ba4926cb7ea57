#!/usr/bin/env python3
"""Opens reports in Chromium and tests what a person would see.

   run.py --rollgaitd PROGRAM --rollgait PROGRAM --work DIR

Exit code 77, which ctest takes for "skipped", where there is no Chromium; the line before says so.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys

SKIPPED = 77


def main() -> int:
    parser = argparse.ArgumentParser()
    for name in ("rollgaitd", "rollgait", "work"):
        parser.add_argument("--" + name, type=pathlib.Path, required=True)
    options = parser.parse_args()
    chromium = shutil.which("chromium") or shutil.which("chromium-headless-shell")
    if chromium is None:
        print("Skipped: there is no chromium; install the package chromium.")
        return SKIPPED
    shutil.rmtree(options.work, ignore_errors=True)
    options.work.mkdir(parents=True)
    environment = dict(os.environ, ROLLGAITD=str(options.rollgaitd), ROLLGAIT=str(options.rollgait),
                       ROLLGAIT_WORK=str(options.work), ROLLGAIT_CHROMIUM=chromium)
    environment.pop("ROLLGAIT_SERVER", None)
    here = pathlib.Path(__file__).resolve().parent
    tests = [sys.executable, "-m", "unittest", "discover", "-s", str(here), "-p", "*_test.py", "-v"]
    return subprocess.run(tests, env=environment).returncode


if __name__ == "__main__":
    sys.exit(main())
