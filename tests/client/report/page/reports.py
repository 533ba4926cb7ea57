"""Reports for the tests: gaits of a planar human with feet of two surfaces, solved once by a server of their own."""
import json
import math
import os
import pathlib
import re
import subprocess

WORK = pathlib.Path(os.environ["ROLLGAIT_WORK"])
ROLLGAIT = os.environ["ROLLGAIT"]


class Reports:
    def __init__(self):
        data = WORK / "server"
        command = [os.environ["ROLLGAITD"], "--data-dir", str(data), "--listen", "127.0.0.1:0", "--solver-slots", "1"]
        self.server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.address = re.search(r"listening on (\S+)", self.server.stdout.readline()).group(1)
        self.solve = WORK / "solve.json"
        gait = ["--model", "planar", "--feet", "two", "--speed", "1.3", "--slope", "0"]
        self.run("solve", *gait, "-q", "-o", str(self.solve))
        self.name = json.loads(self.solve.read_text())["name"]

    def close(self):
        self.server.terminate()
        self.server.wait()
        self.server.stdout.close()

    def run(self, *arguments: str):
        subprocess.run([ROLLGAIT, "--server", self.address, *arguments], check=True, capture_output=True, text=True)

    def one(self) -> pathlib.Path:
        """Of the solve on the server, with the solver's log."""
        page = WORK / "one.html"
        self.run("report", self.name, "-q", "-o", str(page))
        return page

    def several(self, count: int) -> pathlib.Path:
        """The same gait so often, each said to be on another slope."""
        files = []
        for i in range(count):
            solve = json.loads(self.solve.read_text())
            solve["spec"]["slopeRad"] = math.radians(i - count // 2)
            solve["name"] = f"solves/copy{i}"
            files.append(WORK / f"copy{i}.json")
            files[-1].write_text(json.dumps(solve))
        page = WORK / f"several{count}.html"
        self.run("report", *map(str, files), "-q", "-o", str(page))
        return page

    def shaped(self) -> pathlib.Path:
        """On boxy heels and pointed forefeet."""
        solve, page = WORK / "shaped.json", WORK / "shaped.html"
        feet = ["--feet", "two", "--foot", "heel=:0.6", "--foot", "forefoot=:1.6"]
        self.run("solve", "--model", "planar", "--speed", "1.3", "--slope", "0", *feet, "-q", "-o", str(solve))
        self.run("report", str(solve), "-q", "-o", str(page))
        return page

    def ball(self) -> pathlib.Path:
        solve, page = WORK / "ball.json", WORK / "ball.html"
        motion = ["--model", "ball", "--from", "0,0", "--to", "1,0.5", "--duration", "2", "--semi-axes", "0.15,0.1,0.1"]
        self.run("solve", *motion, "-q", "-o", str(solve))
        self.run("report", str(solve), "-q", "-o", str(page))
        return page

    def front(self) -> pathlib.Path:
        """Of a simulation with two tolerances."""
        scene = pathlib.Path(__file__).resolve().parents[4] / "scenes" / "ball_bowled.json"
        points = ["--tolerance", "1e-3,1e-6", "--repeats", "1", "--duration", "0.5"]
        self.run("tradeoff", "--scene", str(scene), *points, "--output", str(WORK / "front"))
        return WORK / "front" / "tradeoff.html"
