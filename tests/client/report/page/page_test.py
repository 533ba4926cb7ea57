"""What a person sees of a report, what the keyboard and a screen reader find, and what the printer gets."""
import os
import re
import unittest

from browser import Browser
from reports import Reports

CHROMIUM = os.environ["ROLLGAIT_CHROMIUM"]


def setUpModule():
    global reports, browser, flat
    reports = Reports()
    browser = Browser(CHROMIUM)
    flat = Browser(CHROMIUM, webgl=False)


def tearDownModule():
    for thing in (browser, flat, reports):
        thing.close()


class PageTest(unittest.TestCase):
    def open(self, page, driver=None, **options):
        driver = driver or browser
        driver.open(page, **options)
        self.assertEqual(driver.problems, [])
        # One file: nothing else is asked for.
        files = [url for url in driver.requests if url.startswith("file:")]
        self.assertEqual([url for url in driver.requests if not url.startswith(("file:", "about:", "blob:"))], [])
        self.assertEqual(len(files), 1)

    def test_scene_draws_the_body_and_follows_the_slider(self):
        self.open(reports.one())
        parts = browser.evaluate("rollgaitScene.walkers[0].scene.shapes.map((s) => s.part)")
        for part in ("head", "chest", "left heel", "right forefoot", "right shank", "left upper arm"):
            self.assertIn(part, parts)
        browser.evaluate("window.before = rollgaitScene.canvas.toDataURL()")
        browser.evaluate("set('.player input', 40, 'input')")
        browser.wait_for("rollgaitScene.canvas.toDataURL() !== before")
        # The words for a screen reader are of the same instant.
        self.assertIn("40 % of the cycle", browser.evaluate("document.querySelector('.unseen').textContent"))

    def test_scene_draws_right_and_left_in_their_own_colours(self):
        self.open(reports.one())
        sides = browser.evaluate("Object.fromEntries(SOLVES[0].motion.scene.shapes.map((s) => [s.part, s.side]))")
        for part in ("upper arm", "forearm", "shank", "heel"):
            self.assertEqual([sides[f"right {part}"], sides[f"left {part}"]], [1, 2], part)

    def test_front_of_a_tradeoff_is_drawn_and_listed(self):
        self.open(reports.front())
        self.assertEqual(browser.evaluate("document.querySelectorAll('tbody tr').length"), 2)
        titles = browser.evaluate("document.body.textContent")
        for title in ("Largest error of a position", "Largest error of an angle", "CPU time"):
            self.assertIn(title, titles)
        self.assertGreaterEqual(browser.evaluate("document.querySelectorAll('svg circle').length"), 6)
        self.assertEqual(browser.evaluate("[fmt(1e-5), fmt(-1e-5), fmt(1.2e-5, 3)]"), ["10⁻⁵", "−1.00·10⁻⁵", "1.2·10⁻⁵"])

    def test_views_and_arrangement(self):
        self.open(reports.several(3))
        vertical = "document.querySelector('select[aria-label=vertical]').value"
        self.assertEqual(browser.evaluate(vertical), "objective")
        pictures = set()
        for view in ("3D", "Side", "Front", "Top", "Below"):
            browser.evaluate(f"press('{view}')")
            pictures.add(browser.evaluate("rollgaitScene.canvas.toDataURL()"))
        self.assertEqual(len(pictures), 5)
        self.assertEqual(browser.evaluate("rollgaitScene.layout().columns"), 3)
        browser.evaluate("press('Overlaid')")
        self.assertEqual(browser.evaluate("rollgaitScene.layout().columns"), 1)
        # Keys turn the view.
        browser.evaluate("rollgaitScene.canvas.focus()")
        azimuth = browser.evaluate("rollgaitScene.camera.azimuth")
        browser.call("Input.dispatchKeyEvent", type="keyDown", key="ArrowLeft", code="ArrowLeft")
        self.assertEqual(browser.evaluate("rollgaitScene.camera.azimuth"), azimuth - 6)

    def test_without_webgl_the_flat_view_says_why(self):
        self.open(reports.one(), flat)
        self.assertIn("no WebGL", flat.evaluate("document.querySelector('.notice').textContent"))
        self.assertEqual(flat.evaluate("all('.flat ellipse[data-part=head]').length"), 1)
        shank = "all('.flat ellipse').find((e) => e.dataset.part === 'right shank').getAttribute('transform')"
        before = flat.evaluate(shank)
        flat.evaluate("showPercent(50)")
        self.assertNotEqual(flat.evaluate(shank), before)

    def test_outlines_of_the_flat_view_bound_their_ellipsoids(self):
        self.open(reports.one())
        for error in browser.evaluate("outlineError()"):
            self.assertAlmostEqual(error, 1, delta=1e-3)

    def test_superellipsoids_are_drawn_as_they_are(self):
        self.open(reports.shaped())
        # Where the solver says that a surface bears, its outline touches the ground, to the step between points and the packing.
        heights = browser.evaluate("heightsOfBearingOutlines()")
        self.assertGreater(len(heights), 50)
        for height in heights:
            self.assertAlmostEqual(height, 0, delta=5e-4)
        self.assertEqual(browser.evaluate("all('polygon.sole').length"), 4)
        text = browser.evaluate("document.body.textContent")
        self.assertIn("and exponents 0.6, 0.6", text)
        self.assertIn("and exponents 1.6, 1.6", text)
        self.open(reports.shaped(), flat)
        self.assertEqual(flat.evaluate("all('.flat polygon').map((p) => p.dataset.part).sort().join()"),
                         "left forefoot,left heel,right forefoot,right heel")

    def test_labels_do_not_overlap_and_are_large_enough(self):
        for width in (390, 1280):
            self.open(reports.one(), width=width)
            self.assertEqual(browser.evaluate("all('.plot svg').flatMap(overlaps)"), [], width)
            self.assertGreater(browser.evaluate("smallestText()"), 9, width)

    def test_events_are_of_a_foot_and_not_of_its_surfaces(self):
        self.open(reports.one())
        events = browser.evaluate("titles('text.event')")
        self.assertTrue(any(event.startswith("foot flat") for event in events), events)
        self.assertEqual([event for event in events if "forefoot" in event or "left" in event], [])
        toe_off = browser.evaluate("eventAt(SOLVES[0].stride, 'right', 'toe off')")
        self.assertAlmostEqual(toe_off, browser.evaluate("100 * rightFoot(SOLVES[0].stride).stance"), delta=1e-6)

    def test_a_phone_needs_no_sideways_scrolling(self):
        for page in (reports.one(), reports.several(20)):
            self.open(page, width=390, height=844)
            self.assertLessEqual(browser.evaluate("document.documentElement.scrollWidth"), 390)
            self.assertEqual(browser.evaluate("beyond(390)"), [])

    def test_force_plots_show_the_whole_foot(self):
        self.open(reports.one())
        sums = browser.evaluate("forceSums()")
        compared = 0
        for i in range(1, len(sums)):
            if abs(sums[i][0] - sums[i - 1][0]) < 5:  # not at an event, where forces may jump
                compared += 1
                self.assertAlmostEqual(sums[i][0], sums[i][1], delta=0.2, msg=f"{i / 2} %")
        self.assertGreater(compared, 150)
        self.assertIn("Vertical force, both feet", browser.evaluate("titles('h3')"))

    def test_pressure_lies_under_the_foot_in_the_scene(self):
        self.open(reports.one())
        offsets = browser.evaluate("pressureOffsets()")
        self.assertEqual(len(offsets), 402)
        self.assertLess(max(offsets), 1e-3)

    def test_twenty_gaits_have_twenty_colours_and_a_short_page(self):
        for scheme in ("light", "dark"):
            self.open(reports.several(20), scheme=scheme)
            colours = browser.evaluate("SOLVES.map((s) => colorValue(solveColor(s.index)))")
            self.assertEqual(len(set(colours)), 20)
        self.assertLess(browser.evaluate("document.documentElement.scrollHeight"), 12000)
        self.assertEqual(browser.evaluate("all('.labels > span').length"), 20)
        # Any figure against slope, by menu.
        browser.evaluate("set('select[aria-label=vertical]', 'step length', 'change')")
        browser.wait_for("all('.grid.one circle').length === 20")

    def test_every_plot_can_be_saved(self):
        self.open(reports.one())
        plots, saved = browser.evaluate("all('figure.card').length"), browser.evaluate("savedFiles()")
        self.assertGreater(plots, 15)
        self.assertEqual(len(saved), 2 * plots)
        for name, kind, text in saved:
            if kind == "text/csv":
                self.assertGreater(len(text.strip().split("\n")), 1, name)
            else:
                self.assertTrue(text.startswith("<svg"), name)
                self.assertNotIn("var(--", re.sub(r'style="[^"]*"', "", text), name)
        knee = next(text for name, _, text in saved if name == "knee_angle.csv").strip().split("\n")
        self.assertEqual(len(knee), 202)
        self.assertEqual(knee[0].split(",")[:3], ["percent", "0° right [degrees]", "0° left [degrees]"])

    def test_convergence_of_a_solve_on_the_server(self):
        self.open(reports.one())
        rows = browser.evaluate("SOLVES[0].log.length")
        self.assertEqual(rows, browser.evaluate("SOLVES[0].meshes.reduce((n, m) => n + m.iterations + 1, 0)"))
        self.assertIn("Constraint violation", browser.evaluate("titles('h3')"))

    def test_prints_whole_tables_on_few_pages(self):
        self.open(reports.several(3))
        browser.call("Emulation.setEmulatedMedia", media="print")
        browser.resize(703, 1000)  # A4 less its margins
        cut = "all('.scroll').filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => e.ariaLabel)"
        self.assertEqual(browser.evaluate(cut), [])
        shown = "all('.player, .controls, .files, button').filter((e) => e.getClientRects().length).length"
        self.assertEqual(browser.evaluate(shown), 0)
        pages = len(re.findall(rb"/Type\s*/Page\b", browser.pdf()))
        self.assertGreaterEqual(pages, 3)
        self.assertLessEqual(pages, 12)

    def test_screen_reader_finds_names(self):
        self.open(reports.one())
        names = {}
        for node in browser.call("Accessibility.getFullAXTree")["nodes"]:
            role = node.get("role", {}).get("value")
            names.setdefault(role, []).append(node.get("name", {}).get("value", ""))
        for role in ("button", "image", "img", "slider", "combobox", "checkbox"):
            self.assertNotIn("", names.get(role, []), role)
        self.assertGreater(len(names["heading"]), 10)
        pictures = names.get("image", []) + names.get("img", [])
        self.assertTrue(any("Knee angle in degrees over the gait cycle" in name for name in pictures), pictures[:5])

    def test_space_plays_and_stops(self):
        self.open(reports.one())
        browser.evaluate("document.activeElement.blur()")
        browser.call("Input.dispatchKeyEvent", type="keyDown", key=" ", code="Space")
        browser.wait_for("instant > 1")
        browser.call("Input.dispatchKeyEvent", type="keyDown", key=" ", code="Space")
        self.assertIn("Play", browser.evaluate("document.querySelector('.play').textContent"))

    def test_rolling_body(self):
        self.open(reports.ball())
        self.assertIn("Way over the ground", browser.evaluate("titles('h2')"))
        self.assertEqual(browser.evaluate("rollgaitScene.walkers.length"), 1)


if __name__ == "__main__":
    unittest.main()
