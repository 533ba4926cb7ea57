#!/usr/bin/env python3
"""Shows that scripts/make-reference --check can fail: one word is changed in each page in turn, and each must be named."""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys


def main():
    arguments = argparse.ArgumentParser()
    for name in ("bin", "source", "work"):
        arguments.add_argument("--" + name, type=pathlib.Path, required=True)
    options = arguments.parse_args()
    shutil.rmtree(options.work, ignore_errors=True)
    options.work.mkdir(parents=True)
    script = [sys.executable, str(options.source / "scripts" / "make-reference"), "--bin", str(options.bin), "--into", str(options.work)]
    subprocess.run(script, check=True)
    subprocess.run(script + ["--check"], check=True)
    pages = sorted(page for page in options.work.iterdir() if page.suffix in (".md", ".json"))
    if [page.name for page in pages] != ["api.md", "errors.md", "models.md", "openapi.json", "programs.md"]:
        sys.exit(f"unexpected pages: {pages}")
    for page in pages:
        text = page.read_text(encoding="utf-8")
        page.write_text(re.sub(r"\bthe\b", "a", text, count=1), encoding="utf-8")
        done = subprocess.run(script + ["--check"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode == 0 or f"{page.name} as committed" not in done.stdout:
            sys.exit(f"a changed {page.name} was let through:\n{done.stdout}")
        page.write_text(text, encoding="utf-8")
    # A declaration that the parser does not know must stop it, not vanish.
    copy = options.work / "copy"
    shutil.copytree(options.source / "proto", copy / "proto")
    (copy / "scripts").mkdir()
    shutil.copy(options.source / "scripts" / "make-reference", copy / "scripts")
    with open(copy / "proto" / "rollgait" / "v1" / "surface.proto", "a", encoding="utf-8") as file:
        file.write("message Odd {\n  group Old = 1 {\n  }\n}\n")
    done = subprocess.run([sys.executable, str(copy / "scripts" / "make-reference"), *script[2:]], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    if done.returncode == 0 or "does not understand" not in done.stdout:
        sys.exit(f"an unknown declaration was let through:\n{done.stdout}")
    print(f"{len(pages)} stale pages and an unknown declaration were refused.")


if __name__ == "__main__":
    main()
