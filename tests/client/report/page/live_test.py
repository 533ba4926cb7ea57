"""What a person sees of a solve that runs: the page of `rollgait view`."""
import json
import os
import re
import signal
import subprocess
import time
import unittest

from browser import Browser
from reports import ROLLGAIT, WORK

CHROMIUM = os.environ["ROLLGAIT_CHROMIUM"]
# A solve of some seconds, so that there is something to watch.
GAIT = ["--model", "human29", "--slope", "5", "--speed", "1.2", "--intervals", "40"]
FIRST_PICTURE_S = 20  # from the request of the page; a second on an idle machine with a graphics card
SOLVED_S = 1200  # ends a test that hangs: the gait takes 20 s of a core, which other tests may want, too


class View:
    """A server, a solve that it runs, and `rollgait view` of it."""

    def __init__(self, directory: str, gait: list):
        command = [os.environ["ROLLGAITD"], "--data-dir", str(WORK / directory), "--listen", "127.0.0.1:0", "--solver-slots", "1"]
        self.server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.address = re.search(r"listening on (\S+)", self.server.stdout.readline()).group(1)
        client = [ROLLGAIT, "--server", self.address]
        self.name = subprocess.run([*client, "solve", *gait, "--detach"], check=True, capture_output=True, text=True).stdout.strip()
        # Without a name: the newest that runs.
        self.view = subprocess.Popen([*client, "view"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.url = self.view.stdout.readline().strip()

    def end(self) -> int:
        """The exit code after Ctrl-C."""
        self.view.send_signal(signal.SIGINT)
        self.view.communicate(timeout=30)
        return self.view.returncode

    def close(self):
        if self.view.poll() is None:
            self.end()
        self.server.terminate()
        self.server.wait()
        self.server.stdout.close()


class LiveTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(CHROMIUM)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def test_page_follows_the_solver_and_becomes_the_report(self):
        view = View("live", GAIT)
        self.addCleanup(view.close)
        self.assertRegex(view.url, r"^http://127\.0\.0\.1:\d+/[0-9a-f]{32}/$")
        browser = self.browser
        start = time.monotonic()
        browser.open_address(view.url)
        browser.wait_for("window.rollgaitScene && rollgaitScene.frames > 0", FIRST_PICTURE_S)
        print(f"first picture after {time.monotonic() - start:.2f} s", flush=True)
        self.assertEqual(browser.evaluate("document.title"), "Solve in progress")
        iterate = "plots.dataset.iterate"
        browser.evaluate(f"window.before = [{iterate}, rollgaitScene.walkers[0].scene.poses[0].join()]")
        browser.wait_for(f"{iterate} !== before[0] && rollgaitScene.walkers[0].scene.poses[0].join() !== before[1]")
        browser.wait_for("document.querySelectorAll('.grid.three svg path.curve').length === 3")
        self.assertRegex(browser.evaluate("document.querySelector('[role=status] b').textContent"),
                         r"^Mesh \d+, iteration \d+: objective \S+, constraint violation \S+\.$")
        self.assertIn(view.name, browser.evaluate("document.querySelector('.lead').textContent"))
        browser.picture(WORK / "live.png")
        browser.wait_for("document.title === 'Optimal gait'", SOLVED_S)
        browser.wait_for("window.rollgaitScene")
        self.assertIn("accurate within the bounds", browser.evaluate("document.querySelector('.lead').textContent"))
        self.assertGreater(browser.evaluate("SOLVES[0].log.length"), 20)
        browser.picture(WORK / "ended.png")
        # Nothing that the page's policy refused, and nobody else was asked.
        self.assertEqual(browser.problems, [])
        port = re.search(r":\d+/", view.url).group(0)
        others = [url for url in browser.requests if port not in url and not url.startswith(("about:", "blob:", "data:"))]
        self.assertEqual(others, [])
        self.assertEqual(view.end(), 0)


if __name__ == "__main__":
    unittest.main()
