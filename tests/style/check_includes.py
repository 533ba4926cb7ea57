#!/usr/bin/env python3
"""Every file includes what it uses of the headers that cmake/PrecompiledHeaders.cmake precompiles.

With precompiled headers the compiler misses no include, and in a unity build a file has those of its neighbours. Here a file has the
headers of its own includes and of the project's headers that these include, and nothing else.

  check_includes.py ROOT              exit code 1, and a line for each name whose header is missing
  check_includes.py ROOT --self-test  takes the includes of a header out of all files, and expects every file that uses it to be refused
"""

import functools
import pathlib
import re
import sys

FOLDERS = ("core", "server", "client", "bench", "tests")
PRECOMPILED = pathlib.Path("cmake/PrecompiledHeaders.cmake")

# Names of a header, and headers that the standard or the library says include it.
NAMES = {
    "functional": (r"std::(function|hash|greater|less|reference_wrapper|bind|ref|cref|invoke)\b", ()),
    "memory": (r"std::(unique_ptr|shared_ptr|weak_ptr|make_unique|make_shared|enable_shared_from_this|addressof)\b", ()),
    "optional": (r"std::(optional|nullopt|nullopt_t|make_optional)\b", ()),
    "random": (r"std::(mt19937|mt19937_64|\w+_distribution|random_device|seed_seq|generate_canonical)\b", ()),
    "string": (r"std::(string|to_string|stoi|stod|stol|stoul|stoll|stoull|getline)\b", ()),
    "variant": (r"std::(variant|visit|get_if|holds_alternative|monostate)\b", ()),
    "vector": (r"std::vector\b", ()),
    "Eigen/Dense": (r"\bEigen::\w+", ("Eigen/Core", "Eigen/Geometry")),
    "grpcpp/grpcpp.h": (r"\bgrpc::\w+", ("grpcpp/", "rollgait/v1/gait_service.grpc.pb.h")),
    "rollgait/v1/gait_service.pb.h": (r"\bv1::\w+", ("rollgait/v1/", "server/base/wire.pb.h")),
    "rollgait/v1/gait_service.grpc.pb.h": (r"\bv1::GaitService\b", ()),
    # Headers declare CLI::App, CLI::Option and CLI::Error by themselves.
    "CLI/CLI.hpp": (r"\bCLI::(?!(App|Option|Error)\b)\w+|(->|\.)add_(option|flag|subcommand)\w*\(", ()),
    "nlohmann/json.hpp": (r"\bnlohmann::\w+", ("nlohmann/json_fwd.hpp",)),
    "gmock/gmock.h": (r"\b(EXPECT_THAT|ASSERT_THAT|MATCHER_P?|MOCK_METHOD)\(", ()),
    "gtest/gtest.h": (r"^(TEST|TEST_F|TEST_P|TYPED_TEST)\(|\b(EXPECT|ASSERT)_(EQ|NE|LT|LE|GT|GE|TRUE|FALSE|NEAR)\(", ("gmock/gmock.h",)),
}
INCLUDE = re.compile(r'^\s*#\s*include\s+[<"]([^>"]+)[>"]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"", re.DOTALL)


def precompiled(root):
    """The headers that are precompiled, as PrecompiledHeaders.cmake names them."""
    return sorted(set(re.findall(r"<([\w./]+)>", (root / PRECOMPILED).read_text())))


class Sources:
    """The project's files, and which headers of others a file has."""

    def __init__(self, root):
        self.texts = {}
        for folder in FOLDERS:
            for path in sorted((root / folder).rglob("*")):
                if path.suffix in (".h", ".cc"):
                    self.texts[str(path.relative_to(root))] = path.read_text()

    @functools.cache
    def included(self, name):
        return frozenset(INCLUDE.findall(self.texts[name]))

    def headers(self, name, without=()):
        """Every include of the file and of the project's headers below it; `without`: (file, header) pairs that count as absent."""
        found, todo = set(), [name]
        while todo:
            file = todo.pop()
            for header in self.included(file):
                if header in found or (file, header) in without:
                    continue
                found.add(header)
                if header in self.texts:
                    todo.append(header)
        return found

    @functools.cache
    def code(self, name):
        return COMMENT.sub('""', self.texts[name])


def gives(include, header):
    return include == header or include.startswith(NAMES[header][1])


def lacks(sources, name, header, without=()):
    """The first name of the header that the file uses without having it, or None."""
    if any(gives(each, header) for each in sources.headers(name, without)):
        return None
    used = re.search(NAMES[header][0], sources.code(name), re.MULTILINE)
    return used and used.group(0)


def main():
    root = pathlib.Path(sys.argv[1])
    unknown = [header for header in precompiled(root) if header not in NAMES]
    if unknown:
        print(f"{PRECOMPILED} precompiles {', '.join(unknown)}, of which check_includes.py knows no name.")
        return 1
    sources = Sources(root)
    if sys.argv[2:] == ["--self-test"]:
        return self_test(sources)
    lines = [f"{name}: {used} without #include of {header}" for name in sources.texts for header in NAMES
             if (used := lacks(sources, name, header))]
    print("\n".join(lines) if lines else f"{len(sources.texts)} files include what they use of {len(NAMES)} headers.")
    return 1 if lines else 0


def self_test(sources):
    for header, (pattern, _) in NAMES.items():
        without = {(file, each) for file in sources.texts for each in sources.included(file) if gives(each, header)}
        users = [name for name in sources.texts if re.search(pattern, sources.code(name), re.MULTILINE)]
        passed = [name for name in users if not lacks(sources, name, header, without)]
        if passed or not users:
            print(f"Where no file has {header}, {len(users)} use it, and {len(passed)} of them pass: {', '.join(passed[:3])}")
            return 1
        print(f"{header}: {len(users)} files are refused without it.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
