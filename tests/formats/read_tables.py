#!/usr/bin/env python3
"""Reads the stride table and the MCAP log that `rollgait export` writes, with Python's standard library alone.

   read_tables.py --rollgait PROGRAM --gaits DIR --specs DIR --work DIR

No Debian package reads MCAP: the reader here is written from the format's specification and knows nothing of the writer.
"""
import argparse
import csv
import io
import json
import math
import pathlib
import struct
import subprocess
import sys
import unittest
import xml.etree.ElementTree

GAITS = ("planar", "human", "toes")
OPTIONS = None


def export(gait, *flags):
    solve = OPTIONS.work / (gait + ".json")
    spec = json.loads((OPTIONS.specs / (gait + ".json")).read_text())
    result = json.loads((OPTIONS.gaits / (gait + ".json")).read_text())
    solve.write_text(json.dumps({"name": "solves/" + gait, "state": "SOLVE_STATE_SUCCEEDED", "spec": spec, "result": result}))
    run = subprocess.run([str(OPTIONS.rollgait), "export", str(solve), *flags], stdout=subprocess.PIPE, check=True)
    return run.stdout, spec, result


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


class StrideTable(unittest.TestCase):
    def read(self, gait):
        text, spec, result = export(gait, "--format", "stride")
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(io.StringIO(text.decode()))]
        self.assertEqual(len(rows), 201)
        self.assertEqual([row["percent"] for row in rows], [i / 2 for i in range(201)])
        return rows, spec, result

    def vector(self, row, name, quantity, axes="xyz"):
        return [row[f"{name}.{quantity}_{axis}"] for axis in axes]

    def test_columns_are_those_of_the_python_client(self):
        for gait in GAITS:
            rows, _, result = self.read(gait)
            joints = [joint["name"] for joint in result["model"]["joints"]]
            actuated = [joint["name"] for joint in result["model"]["joints"] if joint.get("actuated")]
            names = ["percent", "time_s"]
            for joint in joints:
                names += [joint, joint + ".velocity"]
            names += [joint + ".effort" for joint in actuated]
            names += [f"{foot}.force_{axis}" for foot in ("right", "left") for axis in "xyz"]
            self.assertEqual(list(rows[0])[:len(names)], names)

    def test_force_of_a_foot_is_that_of_its_surfaces(self):
        for gait in GAITS:
            rows, _, result = self.read(gait)
            twisted = 0
            for foot in result["gaitEvents"]["feet"]:
                side = foot["foot"][len("FOOT_"):].lower()
                for row in rows:
                    force, moment = [0, 0, 0], [0, 0, 0]
                    for surface in foot["contacts"]:
                        push, point = self.vector(row, surface, "force"), self.vector(row, surface, "point")
                        force = [a + b for a, b in zip(force, push)]
                        moment = [a + b for a, b in zip(moment, cross(point, push))]
                    pressure = self.vector(row, side, "pressure", "xy") + [0]
                    found = self.vector(row, side, "force")
                    for axis in range(3):
                        self.assertAlmostEqual(found[axis], force[axis], places=9)
                    if force[2] < 1:
                        continue
                    carried = cross(pressure, found)
                    self.assertAlmostEqual(carried[0], moment[0], places=8)
                    self.assertAlmostEqual(carried[1], moment[1], places=8)
                    self.assertAlmostEqual(carried[2] + row[side + ".free_moment"], moment[2], places=8)
                    twisted = max(twisted, abs(row[side + ".free_moment"]))
            self.assertEqual(twisted > 0.1, gait != "planar")

    def test_forces_carry_the_weight_on_the_slope(self):
        for gait in GAITS:
            rows, spec, result = self.read(gait)
            weight = result["model"]["totalMassKg"] * spec.get("gravityMS2", 9.81)
            slope = spec.get("slopeRad", 0)
            mean = [sum(self.vector(row, "right", "force")[axis] + self.vector(row, "left", "force")[axis]
                        for row in rows[:-1]) / 200 / weight for axis in range(3)]
            # Rows are equal steps over a force that jumps at events.
            self.assertAlmostEqual(mean[0], math.sin(slope), delta=0.01)
            self.assertAlmostEqual(mean[1], 0, delta=0.01)
            self.assertAlmostEqual(mean[2], math.cos(slope), delta=0.01)

    def test_motion_is_one_walking_cycle(self):
        for gait in GAITS:
            rows, _, result = self.read(gait)
            self.assertAlmostEqual(rows[-1]["base_x"] - rows[0]["base_x"], result["gaitEvents"]["displacementM"], places=6)
            self.assertAlmostEqual(rows[-1]["time_s"], result["gaitEvents"]["durationS"], places=9)
            step = rows[1]["time_s"]
            for joint in (joint["name"] for joint in result["model"]["joints"]):
                if joint != "base_x":
                    self.assertAlmostEqual(rows[0][joint], rows[-1][joint], places=5)
                # Accelerations jump where a contact comes or goes, so the middle of the differences is judged.
                errors = sorted(abs((after[joint] - before[joint]) / (2 * step) - row[joint + ".velocity"])
                                for before, row, after in zip(rows, rows[1:], rows[2:]))
                self.assertLess(errors[100], 0.03, joint)
            if gait != "toes":  # its halves differ
                for joint in ("hip", "knee", "ankle"):
                    for early, late in zip(rows, rows[100:]):
                        self.assertAlmostEqual(early[joint + "_r"], late[joint + "_l"], places=6)


def read_mcap(data):
    """(schemas, channels, messages, statistics) by the specification of MCAP; messages are (topic, log time ns, object)."""
    magic = b"\x89MCAP0\r\n"
    if data[:8] != magic or data[-8:] != magic:
        raise ValueError("no magic")

    def text(content, at):
        length = struct.unpack_from("<I", content, at)[0]
        return content[at + 4:at + 4 + length].decode(), at + 4 + length

    schemas, channels, messages, statistics, order = {}, {}, [], None, []
    at, summary, ended = 8, None, False
    while at < len(data) - 8:
        opcode, length = struct.unpack_from("<BQ", data, at)
        content = data[at + 9:at + 9 + length]
        order.append((at, opcode))
        at += 9 + length
        if opcode == 0x03:
            key = struct.unpack_from("<H", content)[0]
            name, place = text(content, 2)
            encoding, place = text(content, place)
            schema, place = text(content, place)
            if schemas.setdefault(key, (name, encoding, schema)) != (name, encoding, schema):
                raise ValueError("a schema that differs from itself")
        elif opcode == 0x04:
            key, schema = struct.unpack_from("<HH", content)
            topic, place = text(content, 4)
            encoding, place = text(content, place)
            channels[key] = (topic, encoding, schema)
        elif opcode == 0x05:
            key, sequence, log, published = struct.unpack_from("<HIQQ", content)
            if ended or key not in channels:
                raise ValueError("a message where none may be")
            messages.append((channels[key][0], log, json.loads(content[22:])))
        elif opcode == 0x0B:
            fields = struct.unpack_from("<QHIIIIQQ", content)
            counts = content[struct.calcsize("<QHIIIIQQ"):]
            each = [struct.unpack_from("<HQ", counts, 4 + 10 * i) for i in range(struct.unpack_from("<I", counts)[0] // 10)]
            statistics = fields, {channels[key][0]: count for key, count in each}
        elif opcode == 0x0F:
            ended = True
        elif opcode == 0x02:
            summary = struct.unpack_from("<QQI", content)
    if order[0][1] != 0x01 or order[-1][1] != 0x02 or not ended:
        raise ValueError("header, end of data or footer missing")
    if dict(order)[summary[0]] != 0x03:
        raise ValueError("the summary does not begin where the footer says")
    return schemas, channels, messages, statistics


class McapLog(unittest.TestCase):
    def test_has_the_numbers_of_the_stride_table(self):
        for gait in GAITS:
            rows, _, result = StrideTable.read(self, gait)
            schemas, channels, messages, statistics = read_mcap(export(gait, "--format", "mcap")[0])
            self.assertEqual(sorted(topic for topic, _, _ in channels.values()), ["/body", "/ground_reaction", "/joints", "/tf"])
            for topic, encoding, schema in channels.values():
                self.assertEqual((encoding, schemas[schema][1]), ("json", "jsonschema"))
                self.assertEqual(json.loads(schemas[schema][2])["type"], "object")
            by_topic = {topic: [(log, message) for t, log, message in messages if t == topic] for topic in ("/joints", "/ground_reaction", "/tf", "/body")}
            self.assertEqual([len(by_topic[t]) for t in ("/joints", "/ground_reaction", "/tf", "/body")], [201, 201, 201, 1])
            self.assertEqual(statistics[0][0], 604)
            self.assertEqual(statistics[1], {topic: len(found) for topic, found in by_topic.items()})
            self.assertEqual(statistics[0][-2:], (0, by_topic["/tf"][-1][0]))
            self.assertEqual([log for _, log, _ in messages], sorted(log for _, log, _ in messages))
            links = {joint["linkName"] for joint in result["model"]["joints"] if joint.get("massKg", 0) > 0}
            for row, (log, joints), (_, ground), (_, frames) in zip(rows, by_topic["/joints"], by_topic["/ground_reaction"], by_topic["/tf"]):
                self.assertAlmostEqual(log * 1e-9, row["time_s"], places=9)
                for name, position, velocity, effort in zip(joints["name"], joints["position"], joints["velocity"], joints["effort"]):
                    self.assertEqual((position, velocity), (row[name], row[name + ".velocity"]))
                    self.assertEqual(effort, row.get(name + ".effort", 0))
                for foot in ground["feet"]:
                    for axis in "xyz":
                        self.assertEqual(foot["force"][axis], row[f"{foot['name']}.force_{axis}"])
                    self.assertEqual(foot["center_of_pressure"]["x"], row[foot["name"] + ".pressure_x"])
                    self.assertEqual(foot["free_moment"], row[foot["name"] + ".free_moment"])
                self.assertEqual({frame["child_frame_id"] for frame in frames["transforms"]}, links)
                for frame in frames["transforms"]:
                    self.assertAlmostEqual(sum(part ** 2 for part in frame["rotation"].values()), 1, places=12)
                    self.assertEqual(frame["timestamp"]["sec"] * 10 ** 9 + frame["timestamp"]["nsec"], log)

    def test_body_stands_where_its_contacts_are(self):
        """An ellipsoid of /body in its frame of /tf has its lowest point where the stride table has it."""
        rows = StrideTable.read(self, "human")[0]
        messages = read_mcap(export("human", "--format", "mcap")[0])[2]
        entities = {entity["id"]: entity for topic, _, message in messages if topic == "/body" for entity in message["entities"]}
        frames = [message["transforms"] for topic, _, message in messages if topic == "/tf"]

        def turn(q, v):
            u = [q["x"], q["y"], q["z"]]
            t = [2 * part for part in cross(u, v)]
            return [a + q["w"] * b + c for a, b, c in zip(v, t, cross(u, t))]

        for row, transforms in list(zip(rows, frames))[::20]:
            for surface in ("right_heel", "left_forefoot"):
                entity = entities[surface]
                sphere, frame = entity["spheres"][0], next(f for f in transforms if f["child_frame_id"] == entity["frame_id"])
                center = turn(frame["rotation"], list(sphere["pose"]["position"].values()))
                height = center[2] + frame["translation"]["z"]
                rows_up = [turn(frame["rotation"], turn(sphere["pose"]["orientation"], axis))[2] for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]
                depth = math.sqrt(sum((part * size / 2) ** 2 for part, size in zip(rows_up, sphere["size"].values())))
                self.assertAlmostEqual(height - depth, row[surface + ".point_z"], places=9)


class Folder(unittest.TestCase):
    def test_has_files_that_refer_to_each_other(self):
        folder = OPTIONS.work / "opensim"
        self.assertEqual(export("human", "--format", "opensim", "-o", str(folder))[0], b"")
        names = sorted(path.name for path in folder.iterdir())
        self.assertEqual(names, ["external_loads.xml", "ground_reaction.mot", "markers.trc", "model.osim", "motion.mot"])
        loads = xml.etree.ElementTree.parse(folder / "external_loads.xml").getroot()
        self.assertTrue((folder / loads.find(".//datafile").text).is_file())
        model = xml.etree.ElementTree.parse(folder / "model.osim").getroot()
        bodies = {body.get("name") for body in model.iter("Body")}
        self.assertTrue({load.text for load in loads.iter("applied_to_body")} <= bodies)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    for option in ("rollgait", "gaits", "specs", "work"):
        parser.add_argument("--" + option, type=pathlib.Path, required=True)
    OPTIONS, rest = parser.parse_known_args()
    OPTIONS.work.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=[sys.argv[0], *rest], verbosity=2)
