#!/usr/bin/env python3
"""Plants each fault of table.py in a copy of the sources, builds the tests of its folder and shows that they go red.

  run.py --build DIR [--only TEXT]   DIR: for the copy and its build. TEXT: the mutants whose description or file has it
  run.py --check                     only whether every text of the table is still in its file, once; builds nothing
  run.py --self-test                 whether that check refuses what it should

One line for each mutant, on stdout: red and the first test that failed, or SURVIVED. A mutant that does not compile, or whose tests do
not end, is told so and counts as a failure: it shows nothing. Exit code: 0 if every mutant was red.
"""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import time

from table import MUTANTS, PROGRAMS

ROOT = pathlib.Path(__file__).resolve().parents[2]
LONGEST = 600  # s, of one program's tests; the slowest takes 5 s


class Stale(Exception):
    """The text of a mutant is not in its file, or not once."""


def places(source, text, first=0):
    """Where the text begins and ends, each time; any space stands for any other, so that the formatter moves nothing away."""
    pattern = re.compile(r"\s+".join(re.escape(word) for word in text.split()))
    return [match.span() for match in pattern.finditer(source, first)]


def mutated(source, text, new):
    """The source with the mutant's text replaced."""
    if isinstance(text, tuple):
        after, text = text
        before = places(source, after)
        found = places(source, text, before[0][1])[:1] if before else []
    else:
        found = places(source, text)
    if len(found) != 1:
        raise Stale(f"“{text}” is there {len(found)} times")
    begin, end = found[0]
    return source[:begin] + new + source[end:]


def programs_of(file):
    return next(programs for folder, programs in PROGRAMS.items() if file.startswith(folder))


def check():
    stale = 0
    for what, file, text, new in MUTANTS:
        try:
            mutated((ROOT / file).read_text(), text, new)
        except (Stale, OSError) as reason:
            stale += 1
            print(f"tests/mutants/table.py: {what}: {file}: {reason}")
    print(f"{len(MUTANTS)} mutants, {stale} of them out of date")
    return stale == 0


def self_test():
    source = "int a = 1;\nint b =\n    2;\nint c = 1;\n"
    expected = [
        ("int b = 2;", "", "int a = 1;\n\nint c = 1;\n"),  # across lines
        (("int c", "1"), "3", "int a = 1;\nint b =\n    2;\nint c = 3;\n"),  # the first behind
        ("int d", "", None),  # not there
        ("= 1;", "", None),  # twice
        (("int d", "1"), "", None),
        (("int c", "2"), "", None),  # before it alone
    ]
    for text, new, result in expected:
        try:
            found = mutated(source, text, new)
        except Stale:
            found = None
        if found != result:
            print(f"{text}: {found!r} where {result!r} is right")
            return False
    return True


class Copy:
    """The sources as they are, and their build with the tests that judge mutants."""

    def __init__(self, directory):
        self.source, self.build = directory / "source", directory / "build"
        self.source.mkdir(parents=True, exist_ok=True)
        files = subprocess.run(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard", "-z"], check=True, capture_output=True).stdout
        for name in files.decode().split("\0"):
            # What is as it was keeps its time: a file that was a mutant's is compiled again.
            source, target = ROOT / name, self.source / name
            if not source.is_file() or target.is_file() and source.read_bytes() == target.read_bytes():
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
            shutil.copymode(source, target)
        self._run("cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DROLLGAIT_X86_64_V3=OFF",
                  "-DROLLGAIT_BENCH=OFF", "-DROLLGAIT_PRECOMPILE=TESTS", "-DCMAKE_CXX_FLAGS=-w",
                  # One program for the tests of a folder, yet every file by itself: a mutant compiles one.
                  "-DROLLGAIT_UNITY=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=1")
        every = sorted({program for programs in PROGRAMS.values() for program in programs})
        self._run("cmake", "--build", self.build, "--target", *every)
        for program in every:
            ended, failed = self.test(program)
            if not ended or failed:
                sys.exit(f"{program} is red without a mutant: {failed}")

    def _run(self, *command):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            sys.exit(done.stdout[-3000:] + "\nThe copy of the sources does not build; the reason is above.")

    def compile(self, programs):
        done = subprocess.run(["cmake", "--build", self.build, "--target", *programs], capture_output=True, text=True)
        return done.returncode == 0, done.stdout

    def test(self, program):
        """Whether the program ended in time, and the first test that failed, if one did."""
        found = list(self.build.glob(f"tests/**/{program}"))
        command = [next(path for path in found if path.is_file()), "--gtest_fail_fast", "--gtest_brief=1"]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            return False, None
        if done.returncode == 0:
            return True, None
        failed = re.search(r"\[  FAILED  \] (\S+)", done.stdout)
        return True, failed.group(1).rstrip(",") if failed else "the program died: " + done.stderr.strip()[-100:]

    def try_mutant(self, file, text, new):
        """What became of it, in words that begin with "red" if a test failed."""
        path = self.source / file
        original = path.read_text()
        try:
            path.write_text(mutated(original, text, new))
            compiled, errors = self.compile(programs_of(file))
            if not compiled:
                error = re.search(r"error: .*", errors)
                return "DOES NOT COMPILE: " + (error.group(0) if error else errors[-200:])
            for program in programs_of(file):
                ended, failed = self.test(program)
                if failed:
                    return f"red: {failed}"
                if not ended:
                    return f"DOES NOT END: {program}"
            return "SURVIVED"
        finally:
            path.write_text(original)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("--build", type=pathlib.Path)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    if options.self_test:
        return 0 if self_test() else 1
    if not check():
        return 1
    if options.check:
        return 0
    if options.build is None:
        parser.error("--build says where the copy of the sources goes")
    chosen = [row for row in MUTANTS if options.only in row[0] or options.only in row[1]]
    copy = Copy(options.build.resolve())
    failures = 0
    started = time.monotonic()
    for what, file, text, new in chosen:
        outcome = copy.try_mutant(file, text, new)
        failures += not outcome.startswith("red")
        print(f"{file}: {what}: {outcome}", flush=True)
    print(f"{len(chosen)} mutants, {len(chosen) - failures} red, {failures} not, in {time.monotonic() - started:.0f} s")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
