"""A server for the tests of one module, with solves that are made once."""
import functools
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile

import rollgait


class Server:
    def __init__(self, *flags: str):
        self._directory = tempfile.mkdtemp(prefix="rollgait-python-")
        self.socket = "unix:" + self._directory + "/socket"
        self._process = subprocess.Popen(
            [os.environ["ROLLGAITD"], "--data-dir", self._directory + "/data", "--listen", self.socket,
             "--log-level", "error", *flags], stdout=subprocess.PIPE, text=True)
        line = self._process.stdout.readline()
        assert line.startswith("rollgaitd listening on "), line

    def connection(self, **more) -> rollgait.Connection:
        return rollgait.Connection(server=self.socket, **more)

    def stop(self) -> None:
        self._process.send_signal(signal.SIGTERM)
        self._process.wait(timeout=60)
        self._process.stdout.close()
        shutil.rmtree(self._directory, ignore_errors=True)


@functools.lru_cache(maxsize=None)
def work() -> pathlib.Path:
    return pathlib.Path(os.environ["ROLLGAIT_WORK"])
