"""The Python client against a real server and solver."""
import asyncio
import os
import pathlib
import subprocess
import sys
import unittest
import unittest.mock

import grpc
import numpy as np

import rollgait
from rollgait.gait import _hermite
from rollgait.v1 import solve_pb2, solve_spec_pb2
from server import Server, work


def setUpModule():
    global server, client, gait
    server = Server()
    client = rollgait.Client(server.connection())
    gait = client.solve("planar", preset="human", slope_deg=3, progress=False)


def tearDownModule():
    client.close()
    server.stop()


class Solving(unittest.TestCase):
    def test_gives_the_arrays_of_the_message(self):
        self.assertEqual(gait.termination, "optimal")
        self.assertTrue(gait.is_within, gait.verdict)
        self.assertAlmostEqual(gait.speed_m_s, 1.3, places=6)
        self.assertAlmostEqual(sum(gait.costs.values()), gait.objective, places=9)
        self.assertEqual(gait.positions.shape, (len(gait.times_s), len(gait.joints)))
        self.assertEqual(gait.efforts.shape, (len(gait.point_times_s), len(gait.actuated_joints)))
        first = gait.solve.result.trajectory.phases[0]
        knee = gait.joints.index("knee_r")
        self.assertEqual(gait.angles("knee_r")[1], first.node_positions.values[len(gait.joints) + knee])
        self.assertAlmostEqual(gait.angles_deg("knee_r")[1], np.degrees(gait.angles("knee_r")[1]))

    def test_tells_the_verdict_in_words_and_figures(self):
        slip = gait.criteria["max_slip_m_s"]
        self.assertEqual((slip.bound, slip.unit, slip.exceeded), (1e-3, "m/s", False))
        self.assertLessEqual(slip.value, slip.bound)
        draft = client.solve("planar", accuracy="draft", progress=False)
        self.assertEqual(draft.verdict, "not judged")
        self.assertIsNone(draft.criteria["max_slip_m_s"].bound)

    def test_estimates_errors_where_they_are_asked_for(self):
        self.assertEqual(gait.errors, {})
        coarse = client.solve("planar", accuracy="draft", intervals=8, estimate_errors=True, progress=False)
        angle = coarse.errors["joint angle"]
        self.assertEqual(angle.unit, "rad")
        self.assertIn(angle.where, coarse.joints)
        fine = client.solve("planar", accuracy="draft", intervals=8, max_error={"angle_rad": angle.largest / 2},
                            progress=False)
        self.assertTrue(fine.solve.result.errors.within_max_error, fine.solve.result.message)
        self.assertLess(fine.errors["joint angle"].largest, angle.largest / 2)
        with self.assertRaisesRegex(ValueError, "angle_rad"):
            client.solve("planar", max_error={"angel": 1})

    def test_shows_every_iteration_in_order(self):
        events = []
        client.wait(gait.name, progress=events.append)
        self.assertEqual([e.sequence for e in events], sorted({e.sequence for e in events}))
        self.assertEqual(events[-1].WhichOneof("event"), "finished")
        self.assertEqual(sum(e.WhichOneof("event") == "iteration" for e in events) > 10, True)

    def test_finds_a_solve_again(self):
        again = client.get(gait.name)
        self.assertEqual(again.objective, gait.objective)
        self.assertIn(gait.name, [solve.name for solve in client.list(page_size=1)])

    def test_the_same_request_id_makes_no_second_solve(self):
        spec = rollgait.make_spec("planar", accuracy="draft", intervals=5)
        first, second = (client.create(spec, request_id="python-test") for _ in range(2))
        self.assertEqual(first.name, second.name)
        client.wait(first.name, progress=False)
        client.delete(first.name)
        with self.assertRaises(rollgait.NotFound):
            client.get(first.name)

    def test_finds_what_was_made_together_by_its_label(self):
        specs = [rollgait.make_spec("planar", accuracy="draft", intervals=5, slope_deg=slope) for slope in (1, 2)]
        made = client.create_all(specs, labels={"study": "python-test"}, priority=-2)
        self.assertEqual([solve.priority for solve in made], [-2, -2])
        self.assertEqual([solve.spec.slope_rad for solve in made], [spec.slope_rad for spec in specs])
        found = [solve.name for solve in client.list(page_size=1, labels={"study": "python-test"})]
        self.assertEqual(found, [solve.name for solve in reversed(made)])
        self.assertEqual(list(client.list(labels={"study": "python-test"}, model="human29")), [])
        with self.assertRaisesRegex(rollgait.RollgaitError, r"requests\[1\].spec"):
            client.create_all([specs[0], rollgait.make_spec("planar", slope_deg=80)])

    def test_refuses_a_priority_that_there_is_not(self):
        spec = rollgait.make_spec("planar", accuracy="draft", intervals=5)
        with self.assertRaisesRegex(rollgait.InvalidRequest, "priority is 11, must be from -10 to 10"):
            client.create(spec, priority=11)
        with self.assertRaisesRegex(rollgait.InvalidRequest, "priority is -11"):
            client.set_priority("solves/none", -11)

    def test_sends_in_parts_what_is_too_long_and_waits_for_a_busy_server(self):
        sent = []

        def answer(_, batch):
            sent.append(len(batch.requests))
            if len(sent) == 1:
                raise rollgait.ServerBusy("too many a second", 0.01)
            if len(batch.requests) > 2:
                raise rollgait.InvalidRequest("requests[2].spec is too long; send it in several batches", [])
            return unittest.mock.Mock(solves=[request.spec.slope_rad for request in batch.requests])
        specs = [rollgait.make_spec("planar", slope_deg=slope) for slope in range(5)]
        with unittest.mock.patch.object(client, "_call", answer):
            made = client.create_all(specs)
        self.assertEqual(made, [spec.slope_rad for spec in specs])
        self.assertEqual(sent, [5, 5, 2, 3, 1, 2])
        long = [solve_spec_pb2.SolveSpec(warm_start="x" * (1 << 20)) for _ in range(4)]
        sent[:] = [0]
        with unittest.mock.patch.object(client, "_call", answer):
            client.create_all(long)
        self.assertEqual(sent, [0, 2, 2])

    def test_cancels(self):
        name = client.create(rollgait.make_spec("human29", preset="torque", accuracy="fine", intervals=60)).name
        client.cancel(name)
        with self.assertRaises(rollgait.SolveFailed) as caught:
            client.wait(name, progress=False)
        self.assertEqual(caught.exception.solve.state, solve_pb2.SOLVE_STATE_CANCELLED)

    def test_sweeps(self):
        gaits = client.sweep([-2, 2], "planar", accuracy="draft", progress=False)
        self.assertEqual(list(gaits), [-2, 2])
        for slope, found in gaits.items():
            self.assertAlmostEqual(np.degrees(found.slope_rad), slope)
        self.assertLess(gaits[-2].objective, gaits[2].objective)

    def test_knows_models_and_server(self):
        self.assertIn("human29", client.models())
        self.assertAlmostEqual(client.model("planar", body_mass_kg=60).total_mass_kg, 60, places=6)
        self.assertEqual(client.server_info().version, rollgait.__version__)

    def test_works_with_an_event_loop(self):
        async def both():
            async with rollgait.AsyncClient(server.connection()) as loop_client:
                found = await asyncio.gather(*(loop_client.solve("planar", accuracy="draft", slope_deg=s) for s in (0, 1)))
                with self.assertRaises(rollgait.InvalidRequest):
                    await loop_client.solve("planar", slope_deg=60)
                return found
        level, uphill = asyncio.run(both())
        self.assertEqual((level.termination, uphill.termination), ("optimal", "optimal"))

    def test_sets_a_priority_with_an_event_loop(self):
        async def make_and_raise():
            async with rollgait.AsyncClient(server.connection()) as loop_client:
                def long(slope):
                    return rollgait.make_spec("human29", preset="torque", accuracy="fine", intervals=61, slope_deg=slope)
                # One more than there are slots: the last one waits.
                running = [await loop_client.create(long(1.5 + 0.1 * i)) for i in range(client.server_info().solver_slots)]
                waiting = await loop_client.create(long(2.5), priority=-3)
                try:
                    raised = await loop_client.set_priority(waiting.name, 7)
                    with self.assertRaisesRegex(rollgait.InvalidRequest, "priority is 11, must be from -10 to 10"):
                        await loop_client.set_priority(waiting.name, 11)
                finally:
                    for solve in [waiting] + running:
                        await loop_client.cancel(solve.name)
                return waiting, raised
        waiting, raised = asyncio.run(make_and_raise())
        self.assertEqual((waiting.priority, raised.priority), (-3, 7))
        self.assertEqual({solve.name: solve.priority for solve in client.list()}[waiting.name], 7)

    def test_a_task_that_is_cancelled_cancels_its_solve(self):
        before = {solve.name for solve in client.list()}
        events = []

        async def start_and_stop():
            async with rollgait.AsyncClient(server.connection()) as loop_client:
                task = asyncio.create_task(loop_client.solve("human29", preset="torque", accuracy="fine", intervals=61,
                                                             progress=events.append))
                while not events:
                    await asyncio.sleep(0.05)
                task.cancel()
                with self.assertRaises(asyncio.CancelledError):
                    await task
        asyncio.run(start_and_stop())
        new = [solve.name for solve in client.list() if solve.name not in before]
        self.assertEqual(new, [events[0].name])
        with self.assertRaises(rollgait.SolveFailed):
            client.wait(new[0], progress=False)


class StrideOfBothLegs(unittest.TestCase):
    def test_is_periodic_and_mirrored(self):
        stride = gait.stride(201)
        self.assertEqual(len(stride), 201)
        for name in stride:
            if name in ("percent", "time_s", "base_x"):
                continue
            first, last = stride[name][0], stride[name][-1]
            if ".force" in name or ".effort" in name:
                continue  # forces may jump at the heel strike
            self.assertAlmostEqual(first, last, delta=1e-4, msg=name)
        # Half a cycle later the left leg does what the right one did.
        for joint in ("hip", "knee", "ankle"):
            np.testing.assert_allclose(stride[joint + "_l"][100:], stride[joint + "_r"][:101], atol=1e-4)
            np.testing.assert_allclose(stride[joint + "_l.effort"][120:140], stride[joint + "_r.effort"][20:40], atol=0.5)
        walked = stride["base_x"][-1] - stride["base_x"][0]
        self.assertAlmostEqual(walked, gait.solve.result.gait_events.displacement_m, places=6)
        self.assertLess(np.max(np.abs(np.diff(stride["base_x"]) - walked / 200)), walked / 200,
                        "the pelvis neither stops nor moves at twice its mean speed")

    def test_velocities_are_those_of_the_positions(self):
        stride = gait.stride(2001)
        step = stride["time_s"][1]
        for joint in ("hip_r", "knee_l", "base_z"):
            central = (stride[joint][2:] - stride[joint][:-2]) / (2 * step)
            error = np.abs(central - stride[joint + ".velocity"][1:-1])
            self.assertLess(np.median(error), 1e-2, joint)

    def test_interpolants_are_exact_for_cubics(self):
        nodes = np.array([0.0, 0.3, 0.3, 1.0])  # a phase ends where another begins
        cubic, slope = (lambda t: t ** 3 - 2 * t ** 2 + t), (lambda t: 3 * t ** 2 - 4 * t + 1)
        at = np.array([0.0, 0.1, 0.3, 0.31, 0.9, 1.0])
        values, rates = _hermite(nodes, cubic(nodes)[:, None], slope(nodes)[:, None], at)
        np.testing.assert_allclose(values[:, 0], cubic(at), atol=1e-15)
        np.testing.assert_allclose(rates[:, 0], slope(at), atol=1e-14)

    def test_forces_carry_the_weight(self):
        stride, weight = gait.stride(2001), gait.solve.result.gait_events.body_weight_n
        up = stride["right.force_z"] + stride["left.force_z"]
        self.assertAlmostEqual(np.mean(up[:-1]) / (weight * np.cos(gait.slope_rad)), 1, delta=2e-3)

    def test_mirrors_what_lies_to_the_side_with_its_sign(self):
        body = client.solve("human29", preset="human", accuracy="draft", intervals=6, progress=False)
        stride = body.stride(201)
        self.assertGreater(np.ptp(stride["base_y"]), 1e-3)
        for name in body.joints:
            if name != "base_x":
                self.assertAlmostEqual(stride[name][0], stride[name][-1], delta=1e-4, msg=name)
                self.assertLess(np.max(np.abs(np.diff(stride[name]))), 0.3, name)
        np.testing.assert_allclose(stride["base_y"][100:], -stride["base_y"][:101], atol=1e-4)

    def test_reads_back_from_csv(self):
        path = work() / "stride.csv"
        stride = gait.stride()
        stride.to_csv(path)
        table = np.genfromtxt(path, delimiter=",", names=True, deletechars="")
        np.testing.assert_array_equal(table["knee_r"], stride["knee_r"])

    def test_agrees_with_the_table_of_the_command_line(self):
        path = work() / "exported.json"
        gait.to_json(path)
        run = subprocess.run([os.environ["ROLLGAIT"], "export", str(path), "--format", "stride"], stdout=subprocess.PIPE, check=True)
        names, *lines = run.stdout.decode().splitlines()
        table = dict(zip(names.split(","), np.array([[float(cell) for cell in line.split(",")] for line in lines]).T))
        stride = gait.stride(201)
        self.assertEqual(list(table)[:len(stride.columns)], stride.columns)
        for name in stride:
            if ".effort" in name:  # lines between points here, the polynomials through them there
                self.assertLess(np.median(np.abs(table[name] - stride[name])), 0.5, name)
            else:
                np.testing.assert_allclose(table[name], stride[name], atol=1e-6, err_msg=name)

    def test_says_which_columns_there_are(self):
        with self.assertRaisesRegex(KeyError, "no column 'knee'.*knee_r"):
            gait.stride()["knee"]
        with self.assertRaisesRegex(KeyError, "no joint 'wing'"):
            gait.angles("wing")


class Refusals(unittest.TestCase):
    def test_name_field_value_and_limit(self):
        with self.assertRaises(rollgait.InvalidRequest) as caught:
            client.solve("planar", slope_deg=60, speed_m_s=-1, progress=False)
        fields = {v.field for v in caught.exception.violations}
        self.assertTrue(any("slope" in f for f in fields) and any("speed" in f for f in fields), fields)
        self.assertIn("speed", str(caught.exception))
        for violation in caught.exception.violations:
            self.assertEqual(str(caught.exception).count(violation.description), 1, "each is said once")

    def test_words_are_checked_before_anything_is_sent(self):
        with self.assertRaisesRegex(ValueError, "preset='humna'.*Did you mean 'human'"):
            rollgait.make_spec("planar", preset="humna")
        with self.assertRaisesRegex(ValueError, "there is no 'max_slip'.*max_slip_m_s"):
            rollgait.make_spec("planar", bounds={"max_slip": 1})

    def test_no_server(self):
        with rollgait.Client(rollgait.Connection(server="unix:/nowhere/at/all")) as nobody:
            with self.assertRaises(rollgait.ServerUnavailable):
                nobody.models()

    def test_addresses_and_tokens(self):
        with self.assertRaisesRegex(ValueError, "HOST:PORT"):
            rollgait.Client(rollgait.Connection(server="here"))
        with self.assertRaisesRegex(ValueError, "belong together"):
            rollgait.Client(rollgait.Connection(server="example.org:1", tls_cert="a"))
        with self.assertRaisesRegex(ValueError, "cannot be read"):
            rollgait.Client(rollgait.Connection(token_file="/nowhere/token"))
        path = work() / "token"
        path.write_text("rgt_abc234\n")
        for far in ("example.org:1", "127.example.org:1", "127.0.0.1.example.org:1"):
            with self.assertRaisesRegex(ValueError, "plain text"):
                rollgait.Client(rollgait.Connection(server=far, token_file=str(path), insecure=True))
        for local in ("127.0.0.1:1", "127.8.9.1:1", "localhost:1", "[::1]:1", "unix:/tmp/socket"):
            self.assertTrue(rollgait.Connection(server=local).is_local, local)
        path.write_text("Not a token!\n")
        with self.assertRaisesRegex(ValueError, "is none|none"):
            rollgait.Connection(token_file=str(path)).token()

    def test_further_fields_come_as_json(self):
        spec = rollgait.make_spec("planar", spec={"groundContact": {"swingClearanceM": 0.03}}, friction=0.5)
        self.assertEqual(spec.ground_contact.swing_clearance_m, 0.03)
        self.assertEqual(spec.ground_contact.friction_coefficient, 0.5)


class Files(unittest.TestCase):
    def test_the_command_line_client_reads_what_is_written(self):
        path, page = work() / "gait.json", work() / "gait.html"
        gait.to_json(path)
        subprocess.run([os.environ["ROLLGAIT"], "-q", "report", str(path), "-o", str(page)], check=True)
        self.assertIn("<html", page.read_text()[:2000].lower())

    def test_reads_what_is_written_here_and_by_the_command_line_client(self):
        path, fetched = work() / "written.json", work() / "fetched.json"
        gait.to_json(path)
        # Messages that hold NaN are not equal to themselves; their bytes are.
        self.assertEqual(rollgait.Gait.from_json(path).solve.SerializeToString(deterministic=True),
                         gait.solve.SerializeToString(deterministic=True))
        with open(fetched, "wb") as file:
            subprocess.run([os.environ["ROLLGAIT"], "--server", server.socket, "--json", "get", gait.name], stdout=file, check=True)
        read = rollgait.Gait.from_json(fetched)
        self.assertEqual(read.objective, gait.objective)
        np.testing.assert_array_equal(read.angles("knee_r"), gait.angles("knee_r"))

    def test_says_what_is_wrong_with_a_file(self):
        path = work() / "wrong.json"
        for text, words in (("{", "holds no solve"), ('{"speed": 1}', "holds no solve"), ('{"name": "solves/x"}', "no trajectory")):
            path.write_text(text)
            with self.assertRaisesRegex(ValueError, words):
                rollgait.Gait.from_json(path)
        with open(path, "wb") as file:
            file.truncate((256 << 20) + 1)
        with self.assertRaisesRegex(ValueError, "at most 268435456"):
            rollgait.Gait.from_json(path)

    def test_plots(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("matplotlib is not installed")
        path = work() / "gait.png"
        gait.plot(path)
        self.assertEqual(path.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_examples_run(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("matplotlib is not installed")
        environment = dict(os.environ, ROLLGAIT_SERVER=server.socket, MPLBACKEND="Agg")
        examples = pathlib.Path(os.environ["ROLLGAIT_PYTHON"]) / "examples"
        import json
        cells = json.loads((examples / "first_gait.ipynb").read_text())["cells"]
        code = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
        notebook = work() / "first_gait.py"
        notebook.write_text(code)
        for name, arguments in ((notebook, []), ("three_slopes.py", ["--model", "planar", "--out", str(work())]), ("two_at_once.py", [])):
            done = subprocess.run([sys.executable, str(examples / name), *arguments], env=environment, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("within", done.stdout)
        self.assertTrue((work() / "gait_+10.png").exists() and (work() / "gait_-10.csv").exists())


class Tokens(unittest.TestCase):
    def test_reach_every_call(self):
        seen = []

        class Spy(grpc.GenericRpcHandler):
            def service(self, details):
                seen.append(dict(details.invocation_metadata).get("authorization"))
                return None  # UNIMPLEMENTED

        from concurrent import futures
        spied = grpc.server(futures.ThreadPoolExecutor(1), handlers=[Spy()])
        address = "unix:" + str(work() / "spy")
        self.assertTrue(spied.add_insecure_port(address))
        spied.start()
        path = work() / "good-token"
        path.write_text("rgt_abc234\n")
        with rollgait.Client(rollgait.Connection(server=address, token_file=str(path))) as caller:
            for call in (caller.models, caller.server_info, lambda: list(caller.watch("solves/a"))):
                with self.assertRaisesRegex(rollgait.RollgaitError, "UNIMPLEMENTED"):
                    call()
        spied.stop(0)
        self.assertEqual(seen, ["Bearer rgt_abc234"] * 3)


if __name__ == "__main__":
    unittest.main()
