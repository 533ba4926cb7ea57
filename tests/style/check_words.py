#!/usr/bin/env python3
"""Refuses phrases of this project's own where the field has a term, in sources, interface definitions and documentation.

  tests/style/check_words.py ROOT              every file below ROOT; exit code 1 and a list of places when one is found
  tests/style/check_words.py ROOT --self-test  plants every phrase in turn and expects a refusal that names it

A row of PHRASES is a pattern, the files it is looked for in, and what to write in its place. A line is refused also when
the phrase is broken at its end. ALLOWED holds names that another change is about to replace; a row that allows nothing
is an error, so the list can only become shorter.
"""

import argparse
import pathlib
import re
import sys
import tempfile

TEXT = {".cc", ".h", ".proto", ".md", ".py", ".js", ".css", ".html", ".cmake", ".txt", ".json", ".yaml", ".cfg", ".sh", ""}
ANY, PROSE = r".*", r"\.(md|cmake|proto)$|CMakeLists\.txt$"

PHRASES = [
    (r"chain of stages|follows? the elimination groups", ANY, "stage-structured KKT factorisation",
     "a method that follows the chain of stages"),
    (r"mesh(es)? on the way|reached by way of|by way of (a )?coarser|leads? nowhere", ANY,
     "intermediate mesh; mesh continuation", "a mesh on the way"),
    (r"\bmesh_ascent\b|MESH_ASCENT|\bAscend\((const GaitSpec|spec|charted)|\bTEST\(Ascend\b", ANY, "mesh continuation",
     "mesh_ascent"),
    (r"\b(from )?afar\b|FromAfar", ANY, "cold start", "a start from afar"),
    (r"leads? (\w+ )?astray|LeadsAstray|artefacts? of (its|their|one|a) mesh", ANY, "discretisation artefact",
     "the mesh leads astray"),
    (r"sharpen", ANY, "homotopy in the smoothing parameter", "powers are sharpened"),
    (r"\b(walk\w*|muscles?|refinement|request|what \w+) (\w+ )?pays? for", ANY, "cost function; the cost includes",
     "what walking pays for"),
    (r"\bprices? of (the )?(a )?(power|rate|effort)s?\b|power_price|PowerPrice|POWER_PRICE", ANY, "power cost; rate cost",
     "a price of power"),
    (r"shares? nothing with", ANY, "independent verification", "code that shares nothing with the solver"),
    (r"\bfloors?\b", PROSE, "layer", "the table of floors"),
    (r"check_floors", ANY, "check_layers", "check_floors.cmake"),
    (r"\bbeside (people|persons)\b", ANY, "comparison with normative data", "the gait beside people"),
    (r"\bhumps?\b|\btrough(\b|[A-Z_])|Humps?\b|HumpsText|two_humps", ANY, "first peak, valley, second peak of the vertical force",
     "hump / trough / hump"),
    (r"\bat (the|an) end of its range\b", ANY, "at a joint limit", "a joint at the end of its range"),
    (r"\bborn\b", ANY, "initialised to", "matrices born as NaN"),
    (r"friction, mean over", ANY, "the ground must provide a coefficient of at least ...; it provides ...",
     "friction, mean over the motion"),
    (r"\bwho signs\b", ANY, "CA bundle (PEM)", "who signs the server, PEM"),
    (r"\b(leave|leaves|left|leaving) ([^.;:()]{0,60} )?away\b", ANY, "omit", "leave away the field"),
    (r"[Ll]ongest wait for the answer", ANY, "RPC deadline", "Longest wait for the answer of one call"),
    (r"[Cc]ontortionist", ANY, "implausible posture", "only a contortionist could walk away"),
    (r"not having been there", ANY, "repudiation", "doing it and not having been there"),
    (r"(making|derivatives|unknowns|solution|rows) of the program\b|[Tt]he program (of the mesh|whose solution|that led)", ANY,
     "the NLP", "derivatives of the program"),
    (r"\blet go of (before|the mesh)", ANY, "free", "let go of before the next is solved"),
    (r"[Ll]eav(e|es|ing) the \w+ to the (optimiser|solver)|paid for (work|power)", ANY, "optimise the ...; the cost is ...",
     "Leave the speed to the optimiser"),
    (r"what it claims to be", ANY, "accuracy, measured by independent re-integration", "how far it is from what it claims to be"),
]

# (pattern of paths, pattern of phrases, reason). Only names and comments of files that are being rebuilt.
COSTS = "core/ocp/costs is being replaced by one file for each cost; the names go with it"
ALLOWED = [
    (r"^(core|tests/core)/(ocp|gait)/", r"price|Price|PRICE|pays? for", COSTS),
]

# Also what a past release said.
SKIPPED = re.compile(r"^(build|\.git|tests/data)/|^tests/style/check_words\.py$|testdata/|^LICENSE$|^CHANGELOG\.md$|^tests/wire/.*\.txt$")


def files_of(root):
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if path.is_file() and path.suffix in TEXT and not SKIPPED.search(name):
            yield name, path


def found_in(name, text):
    """(line, phrase, advice) of every refused phrase; a comment or sentence may be broken between two lines."""
    joined = re.sub(r"\n[ \t]*(//|#|\*)?[ \t]*", lambda m: " " + "\0" * (len(m.group(0)) - 1), text)
    spaced = re.sub(r"\0+", "", joined)
    places = None
    for pattern, where, advice, _ in PHRASES:
        if not re.search(where, name):
            continue
        for match in re.finditer(pattern, spaced):
            if places is None:  # the line of each character that is left
                places, line, i = [], 1, 0
                for character, original in zip(joined, text):
                    if original == "\n":
                        line += 1
                    if character != "\0":
                        places.append(line)
            yield places[match.start()], match.group(0), advice


def check(root):
    used, problems, count = set(), [], 0
    for name, path in files_of(root):
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
        count += 1
        for line, phrase, advice in found_in(name, text):
            rows = [i for i, (where, what, _) in enumerate(ALLOWED) if re.search(where, name) and re.search(what, phrase)]
            used.update(rows)
            if not rows:
                problems.append(f"{name}:{line}: '{phrase}': write {advice}")
    return problems, used, count


def self_test():
    for pattern, where, advice, example in PHRASES:
        with tempfile.TemporaryDirectory() as place:
            root = pathlib.Path(place)
            (root / "docs").mkdir()
            (root / "docs" / "page.md").write_text("A plain sentence about joint limits.\n")
            assert not check(root)[0], "a plain page was refused"
            words = example.split(" ")
            forms = [f"See {example}.\n"] + ([f"See {words[0]}\n  {' '.join(words[1:])}.\n"] if len(words) > 1 else [])
            for text in forms:
                (root / "docs" / "page.md").write_text("First line.\n" + text)
                problems, _, _ = check(root)
                if not any(p.startswith(("docs/page.md:2:", "docs/page.md:3:")) and p.endswith(advice) for p in problems):
                    sys.exit(f"'{example}' was let through, or named at the wrong line: {problems}")
            (root / "docs" / "page.md").unlink()
            (root / "docs" / "page.png").write_text(example)
            assert not check(root)[0], "a picture was read"
    print(f"{len(PHRASES)} planted phrases were refused.")


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("root", type=pathlib.Path)
    arguments.add_argument("--self-test", action="store_true")
    given = arguments.parse_args()
    if given.self_test:
        return self_test()
    problems, used, count = check(given.root)
    problems += [f"ALLOWED row {i + 1} allows nothing: delete it ({where})"
                 for i, (where, _, _) in enumerate(ALLOWED) if i not in used]
    if problems:
        sys.exit("Phrases that a reader of the field has to guess:\n  " + "\n  ".join(problems))
    print(f"{count} files use the field's terms.")


if __name__ == "__main__":
    main()
