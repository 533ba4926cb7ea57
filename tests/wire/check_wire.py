#!/usr/bin/env python3
"""Refuses changes of rollgait.v1 that programs of the last release would not understand.

  check_wire.py ROOT               the .proto files of ROOT against tests/wire/released.txt; exit code 1 and a line for each break
  check_wire.py ROOT --self-test   plants a break of each kind in turn and expects a refusal that names it
  check_wire.py ROOT --write COMMIT  writes released.txt anew, for a release: git's proto/ at COMMIT

released.txt has a line for each field, enum value and method. What is added is no break; what was there stays, with its number, name, type,
whether it is repeated or optional, and its oneof. tests/wire/allowed.txt holds breaks that were decided: the refusal's text up to " | ", and the
reason. A row that allows nothing is an error, so the list is empty after each release.
"""
import pathlib
import subprocess
import sys
import tempfile

from google.protobuf import descriptor_pb2 as pb

KIND = {number: name[5:].lower() for name, number in pb.FieldDescriptorProto.Type.items()}


def descriptors(root):
    """The FileDescriptorSet of the service and what it imports of ours."""
    with tempfile.NamedTemporaryFile() as output:
        subprocess.run(["protoc", f"-I{root}/proto", "--include_imports", f"--descriptor_set_out={output.name}",
                        *sorted(str(path) for path in pathlib.Path(root, "proto").rglob("*.proto"))], check=True)
        files = pb.FileDescriptorSet.FromString(pathlib.Path(output.name).read_bytes())
    return [file for file in files.file if file.package.startswith("rollgait.")]


def message_rows(name, message):
    for field in message.field:
        kind = field.type_name.lstrip(".") or KIND[field.type]
        # An optional field says whether it was given, which JSON and has_… show.
        repeated = "repeated" if field.label == field.LABEL_REPEATED else "optional" if field.proto3_optional else "single"
        in_oneof = field.HasField("oneof_index") and not field.proto3_optional
        yield (f"field {name} {field.number}", f"{field.name} {kind} {repeated} "
               + (message.oneof_decl[field.oneof_index].name if in_oneof else "-"))
    for inner in message.nested_type:
        yield from message_rows(f"{name}.{inner.name}", inner)
    for inner in message.enum_type:
        yield from enum_rows(f"{name}.{inner.name}", inner)


def enum_rows(name, enum):
    for value in enum.value:
        yield f"value {name} {value.number}", value.name


def rows(files):
    """What a program relies on: a place, which must stay, and what stands there."""
    found = {}
    for file in files:
        for message in file.message_type:
            found.update(message_rows(f"{file.package}.{message.name}", message))
        for enum in file.enum_type:
            found.update(enum_rows(f"{file.package}.{enum.name}", enum))
        for service in file.service:
            for method in service.method:
                streams = ("stream " if method.client_streaming else "") + "to " + ("stream " if method.server_streaming else "")
                found[f"method {file.package}.{service.name} {method.name}"] = (
                    f"{method.input_type.lstrip('.')} {streams}{method.output_type.lstrip('.')}")
    return found


def breaks(released, current):
    for place, what in released.items():
        if place not in current:
            yield f"{place}: {what} is gone"
        elif current[place] != what:
            yield f"{place}: was {what}, is {current[place]}"


def read(path):
    return [line for line in path.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]


def check(released, current, allowed):
    """Breaks that nobody decided, and rows that allow nothing."""
    left = dict(row.split(" | ", 1) for row in allowed)
    problems = [problem for problem in breaks(released, current) if left.pop(problem, None) is None]
    return problems + [f"tests/wire/allowed.txt: nothing is allowed by: {row}" for row in left]


def self_test(root, released):
    def first(row):
        return next(place for place in released if place.startswith(row))

    def planted(change):
        altered = dict(released)
        change(altered)
        return check(released, altered, [])

    field, value, method = first("field"), first("value"), first("method")
    name, kind, label, oneof = released[field].split()
    plants = {
        "a field is removed": lambda rows: rows.pop(field),
        "a field is renamed": lambda rows: rows.update({field: f"other {kind} {label} {oneof}"}),
        "a field has another type": lambda rows: rows.update({field: f"{name} int32 {label} {oneof}"}),
        "a field is repeated": lambda rows: rows.update({field: f"{name} {kind} other {oneof}"}),
        "a field is in a oneof": lambda rows: rows.update({field: f"{name} {kind} {label} other"}),
        "a field has another number": lambda rows: rows.update({field + "9": rows.pop(field)}),
        "an enum value is removed": lambda rows: rows.pop(value),
        "an enum value is renamed": lambda rows: rows.update({value: "OTHER"}),
        "a method is removed": lambda rows: rows.pop(method),
        "a method answers otherwise": lambda rows: rows.update({method: rows[method] + "x"})}
    for what, change in plants.items():
        found = planted(change)
        if len(found) != 1 or found[0].split(":")[0] not in (field, value, method):
            sys.exit(f"{what}: {found}")
    if planted(lambda rows: rows.update({field + "9": "new string single -"})):
        sys.exit("a field that is added was refused")
    if check(released, released, ["field x 1: y is gone | a reason"]) == []:
        sys.exit("a row that allows nothing was let through")
    # The same through protoc: a real file, altered.
    with tempfile.TemporaryDirectory() as place:
        subprocess.run(["cp", "-r", f"{root}/proto", place], check=True)
        path = pathlib.Path(place, "proto/rollgait/v1/gait_service.proto")
        text = path.read_text(encoding="utf-8")
        before = rows(descriptors(place))
        for old, new, word in (("string request_id = 2;", "optional string request_id = 2;", "optional"),
                               ("string request_id = 2;", "string request_id = 22;", "request_id"),
                               ("string request_id = 2;", "bytes request_id = 2;", "bytes"),
                               ("rpc GetSolve(GetSolveRequest) returns (Solve);", "", "GetSolve"),
                               ("    AUTHENTICATION_OFF = 1;\n", "", "AUTHENTICATION_OFF"),
                               ("returns (stream SolveEvent);", "returns (SolveEvent);", "stream")):
            if old not in text:
                sys.exit(f"the self-test looks for what is not there: {old}")
            path.write_text(text.replace(old, new, 1), encoding="utf-8")
            found = check(before, rows(descriptors(place)), [])
            if not found or word not in found[0]:
                sys.exit(f"{new or 'nothing'} in place of {old} was let through: {found}")
    print(f"{len(plants) + 8} breaks were refused or let through as they must be.")


def write(root, commit):
    with tempfile.TemporaryDirectory() as place:
        archive = subprocess.run(["git", "-C", root, "archive", commit, "proto"], check=True, capture_output=True).stdout
        subprocess.run(["tar", "-x", "-C", place], input=archive, check=True)
        found = rows(descriptors(place))
    version = f"# proto/ at {commit}; written by tests/wire/check_wire.py --write.\n"
    pathlib.Path(root, "tests/wire/released.txt").write_text(version + "".join(f"{place} = {what}\n" for place, what in found.items()),
                                                            encoding="utf-8")


def main():
    root, arguments = sys.argv[1], sys.argv[2:]
    if arguments[:1] == ["--write"]:
        return write(root, arguments[1])
    released = dict(row.split(" = ", 1) for row in read(pathlib.Path(root, "tests/wire/released.txt")))
    if len(released) < 100:
        sys.exit("tests/wire/released.txt holds nothing to compare with")
    if arguments == ["--self-test"]:
        return self_test(root, released)
    current = rows(descriptors(root))
    allowed = read(pathlib.Path(root, "tests/wire/allowed.txt"))
    problems = check(released, current, allowed)
    if problems:
        sys.exit("\n".join(problems) + "\nKeep the old field beside a new one, or decide the break: tests/wire/allowed.txt")
    print(f"{len(released) - len(allowed)} fields, values and methods of the last release are as they were, {len(allowed)} may differ.")


if __name__ == "__main__":
    main()
