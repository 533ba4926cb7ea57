#!/usr/bin/env python3
"""Makes rollgait/v1/*_pb2.py and the service's stub from ../../proto, with the protoc of the machine.

   make_messages.py [--into DIR]     # default: rollgait/ beside this file

The files are not kept in the repository: they must fit the protobuf library that is installed.
"""
import argparse
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
PROTO = HERE.parent.parent / "proto"


def make_messages(into: pathlib.Path = HERE) -> None:
    """Writes the package rollgait.v1 into the folder `into`."""
    inputs = sorted(str(path) for path in (PROTO / "rollgait" / "v1").glob("*.proto"))
    protoc, plugin = shutil.which("protoc"), shutil.which("grpc_python_plugin")
    if not inputs:
        sys.exit(f"There are no .proto files under {PROTO}. Build from a whole checkout.")
    if protoc is None or plugin is None:
        sys.exit("protoc or grpc_python_plugin is missing. Install protobuf-compiler and protobuf-compiler-grpc.")
    subprocess.run([protoc, f"-I{PROTO}", f"--python_out={into}", *inputs], check=True)
    service = PROTO / "rollgait" / "v1" / "gait_service.proto"
    subprocess.run([protoc, f"-I{PROTO}", f"--grpc_out={into}", f"--plugin=protoc-gen-grpc={plugin}", str(service)],
                   check=True)
    (into / "rollgait" / "v1" / "__init__.py").write_text('"""Messages of the service, generated from proto/."""\n')


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--into", type=pathlib.Path, default=HERE)
    make_messages(parser.parse_args().into)
