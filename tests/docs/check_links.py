#!/usr/bin/env python3
"""Checks that every relative link and anchor of the documentation, and every docs/ path named anywhere, leads somewhere.

  tests/docs/check_links.py ROOT              exit code 1 and a list of places where one does not
  tests/docs/check_links.py ROOT --self-test  plants broken links and expects each to be refused

A page below docs/ that no other page links to is refused, too. Links to other hosts are not followed.
"""

import argparse
import pathlib
import re
import sys
import tempfile

LINK = re.compile(r"\]\(([^)\s]+)\)")
NAMED = re.compile(r"(?<![\w/.-])docs/(?:[\w-]+/)*[\w-]+\.(?:md|py|svg|png|webp|gif)\b")
SKIPPED = re.compile(r"^(build|\.git|tests/data)/|^tests/docs/check_links\.py$|^tests/style/check_|\.(png|webp|gif|ico|bin)$")


def anchors(text):
    """The anchors that GitHub gives the headings of a page."""
    found, seen = set(), {}
    for heading in re.findall(r"^#{1,6} +(.*?) *#*$", without_code(text), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
        anchor = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
        count = seen.get(anchor, 0)
        seen[anchor] = count + 1
        found.add(anchor if count == 0 else f"{anchor}-{count}")
    return found | set(re.findall(r'<a (?:id|name)="([^"]+)"', text))


def without_code(text):
    return re.sub(r"^(```|~~~).*?^\1", lambda m: "\n" * m.group(0).count("\n"), text, flags=re.M | re.S)


def check(root):
    root, problems, linked, links = root.resolve(), [], set(), 0
    pages = {}
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if not path.is_file() or SKIPPED.search(name):
            continue
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
        if path.suffix == ".md":
            pages[path] = text
        for match in NAMED.finditer(text):
            if name != "CHANGELOG.md" and not (root / match.group(0)).is_file():
                problems.append(f"{name}:{text[:match.start()].count(chr(10)) + 1}: there is no {match.group(0)}")
    for path, text in pages.items():
        name = path.relative_to(root).as_posix()
        body = without_code(text)
        for match in LINK.finditer(body):
            target = match.group(1)
            if re.match(r"[a-z]+:", target):
                continue
            links += 1
            where = f"{name}:{body[:match.start()].count(chr(10)) + 1}"
            file, _, anchor = target.partition("#")
            other = (path.parent / file).resolve() if file else path
            if not other.exists():
                problems.append(f"{where}: {target} is a dead link")
                continue
            if other != path:
                linked.add(other)
            if anchor and other.suffix == ".md" and anchor not in anchors(other.read_text(encoding="utf-8")):
                problems.append(f"{where}: {target}: no such heading")
    for path in pages:
        name = path.relative_to(root).as_posix()
        if name.startswith("docs/") and path not in linked:
            problems.append(f"{name}: no page links to it")
    return problems, len(pages), links


def self_test():
    with tempfile.TemporaryDirectory() as place:
        root = pathlib.Path(place)
        (root / "docs" / "how-to").mkdir(parents=True)
        (root / "core").mkdir()
        (root / "docs" / "how-to" / "page.md").write_text("# A page: with `code`\n## Twice\n## Twice\n")
        (root / "core" / "a.h").write_text("// docs/how-to/page.md\n")
        good = "[one](docs/how-to/page.md#a-page-with-code) [two](docs/how-to/page.md#twice-1)\n```\n[no](link)\n```\n"

        def expect(file, text, refusal):
            (root / "README.md").write_text(good)
            (root / file).write_text(text)
            problems = check(root)[0]
            if (refusal is None) != (not problems) or (refusal and not any(refusal in p for p in problems)):
                sys.exit(f"{file} with {text!r}: expected {refusal}, got {problems}")
            if file != "README.md":
                (root / file).unlink()

        expect("README.md", good, None)
        expect("README.md", good + "[x](docs/gone.md)\n", "README.md:5: docs/gone.md is a dead link")
        expect("README.md", good + "[x](docs/how-to/page.md#thrice)\n", "no such heading")
        expect("README.md", good + "[x](#nothing)\n", "no such heading")
        expect("core/b.cc", "// docs/old_name.md\n", "core/b.cc:1: there is no docs/old_name.md")
        expect("docs/lost.md", "# Lost\n", "docs/lost.md: no page links to it")
    print("5 planted faults were refused.")


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("root", type=pathlib.Path)
    arguments.add_argument("--self-test", action="store_true")
    given = arguments.parse_args()
    if given.self_test:
        return self_test()
    problems, pages, links = check(given.root)
    if problems:
        sys.exit("Dead links:\n  " + "\n  ".join(problems))
    print(f"{links} links of {pages} pages lead somewhere.")


if __name__ == "__main__":
    main()
