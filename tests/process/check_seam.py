"""Checks of the Python module. python3 check_seam.py LOG CSV [CLASS...]; LOG is of `crossing`, and CSV is
its export by seam-export."""

import csv
import importlib.util
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import seam

LOG, CSV = sys.argv[1:3]
BIN = pathlib.Path(seam.__file__).parents[2]  # the built programs

PENDULUM = """
[[player]]
name = "ann"
[[part]]
name = "hook"
box = [0.2, 0.2]
position = [0, 10]
anchored = true
[[part]]
name = "bob"
circle = 0.5
position = [1, 10]
[[joint]]
name = "pivot"
kind = "hinge"
a = "hook"
b = "bob"
anchor = [0, 10]
"""


class ReadsLogs(unittest.TestCase):
    def setUp(self):
        self.log = seam.read(LOG)

    def test_names_the_session(self):
        log = self.log
        self.assertEqual((log.scene, log.mode, log.seed, log.tick_hz), ("crossing", "buffer", 3, 60))
        self.assertEqual(log.players, ["ann", "bob"])
        self.assertEqual(log.peers, [0, 1, 2])
        self.assertEqual(log.time[-1], log.ticks[-1] / 60)
        self.assertEqual(log.missing, 0)

    def test_poses_are_those_of_the_export(self):
        compared = 0
        views = {peer: self.log._view(peer, errors=True) for peer in ("server", "ann", "bob")}
        with open(CSV, newline="") as file:
            for row in csv.DictReader(file):
                view = views[row["view"]]
                at, column = int(row["tick"]) - self.log.ticks[0], view.index(row["body"])
                pose = [float(row[name]) for name in ("x", "y", "angle")]
                np.testing.assert_allclose(view.poses[at, column], pose, rtol=1e-6, atol=1e-6)
                error = float(row["error_m"])  # of the tick; ours of the one that is shown
                if view.ages[at, column] == 0:
                    np.testing.assert_allclose(view.errors[at, column], error, rtol=1e-4,
                                               atol=1e-6)
                compared += 1
        self.assertGreater(compared, 1000)
        shown = sum(np.count_nonzero(~np.isnan(view.poses[:, :, 0])) for view in views.values())
        self.assertEqual(shown, compared)

    def test_error_over_time_has_the_measured_mean(self):
        measures = self.log.measure()
        squared = []
        for peer in self.log.peers:
            view = self.log._view(peer, errors=True)
            squared.append(view.errors[~np.isnan(view.errors)] ** 2)
        rms = np.sqrt(np.concatenate(squared).mean())
        self.assertAlmostEqual(rms, measures["shown_error_rms_m"], places=9)
        by_tick = self.log.error()
        self.assertEqual(by_tick.shape, self.log.ticks.shape)
        one = self.log.error("ann", "car")
        self.assertEqual(one.shape, self.log.ticks.shape)
        self.assertGreater(np.nanmax(self.log.error()), 0)

    def test_the_oracle_is_a_world_with_the_same_inputs(self):
        with tempfile.TemporaryDirectory() as folder:
            session = seam.Session("crossing", mode="strict", drive="script", record=f"{folder}/s.lcm")
            session.step(ticks=150)
            del session
            log = seam.read(f"{folder}/s.lcm")
        world = seam.World("crossing")
        inputs = {player: log.inputs(player) for player in log.players}
        for tick in range(1, int(log.ticks[-1]) + 1):
            now = {}
            for player, given in inputs.items():
                for at in np.flatnonzero(given["tick"] == tick):
                    bits = int(given["buttons"][at])
                    now[player] = seam.Input(int(given["drive"][at]) / 127, int(given["lift"][at]) / 127,
                                             [b for b in range(15) if bits >> b & 1])
            state = world.step(now)
            if tick >= log.ticks[0]:
                np.testing.assert_array_equal(state.poses, log.oracle.poses[tick - log.ticks[0]])

    def test_mistakes_raise_one_clear_error(self):
        for call in (lambda: seam.read("/nowhere/x.lcm"), lambda: seam.read(__file__),
                     lambda: self.log.views["carl"], lambda: self.log.views[7],
                     lambda: self.log.views["ann"]["bridge"], lambda: self.log.error("ann", 999),
                     lambda: self.log.inputs("carl"), lambda: self.log.inputs(9),
                     lambda: self.log.inputs(-1), lambda: self.log.views[1.7],
                     lambda: self.log.views[10**30], lambda: seam.read(LOG, room="other"),
                     lambda: seam.read(LOG, session="9")):
            with self.assertRaises(seam.Error) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))
            self.assertGreater(len(str(caught.exception)), 10)


class StepsScenes(unittest.TestCase):
    def test_a_pendulum_keeps_its_energy_and_its_length(self):
        world = seam.World(text=PENDULUM)
        before = world.energy
        for _ in range(120):
            state = world.step()
            self.assertAlmostEqual(float(np.hypot(state["bob"][0], state["bob"][1] - 10)), 1, places=2)
        self.assertAlmostEqual(world.energy, before, delta=0.05 * abs(before))
        self.assertEqual(state.tick, 120)
        self.assertEqual(world.dt, 1 / 60)

    def test_equal_calls_give_equal_bits_and_reset_begins_anew(self):
        one, other = seam.World("crossing"), seam.World("crossing")
        other.step({"bob": seam.Input(drive=-1, buttons=[0, 3])}, ticks=33)
        other.reset()
        for world in (one, other):
            world.step({"ann": seam.Input(drive=0.5)}, ticks=50)
            world.step({"ann": seam.Input()}, ticks=50)
        np.testing.assert_array_equal(one.state.poses, other.state.poses)
        np.testing.assert_array_equal(one.state.velocities, other.state.velocities)

    def test_a_saved_state_continues_with_the_same_bits(self):
        world, other = seam.World("crossing"), seam.World("crossing")
        world.step({"ann": seam.Input(drive=1)}, ticks=90)
        other.load(world.save())
        np.testing.assert_array_equal(world.step(ticks=90).poses, other.step(ticks=90).poses)

    def test_writes_a_body(self):
        world = seam.World(text=PENDULUM.split("[[joint]]")[0])
        world.write("bob", (3, 4, 0.5), (1, 0, 0))
        self.assertEqual(world.state["bob"].tolist(), [3, 4, 0.5])
        self.assertEqual(world.state.velocity("bob").tolist(), [1, 0, 0])
        self.assertEqual(list(world.state), ["bob"])

    def test_mistakes_raise_one_clear_error_and_end_nothing(self):
        world = seam.World("crossing")
        nan, big = float("nan"), 1e30
        for call in (lambda: seam.World("nothing-of-that-name"), lambda: seam.World(),
                     lambda: seam.World("crossing", text=PENDULUM), lambda: seam.World(text="part = 1"),
                     lambda: world.step(ticks=-1), lambda: world.step(ticks=1.5),
                     lambda: world.step({"ann": (1, 0)}), lambda: world.step({"carl": seam.Input()}),
                     lambda: world.step({7: seam.Input()}), lambda: world.step({"ann": seam.Input(drive=2)}),
                     lambda: world.step({"ann": seam.Input(lift=nan)}),
                     lambda: world.step({"ann": seam.Input(buttons=[15])}),
                     lambda: world.write("car", (nan, 0, 0)), lambda: world.write("car", (0, 0, 0), (big, 0, 0)),
                     lambda: world.write("car", (0, 0)), lambda: world.write("moon", (0, 0, 0)),
                     lambda: world.load(b""), lambda: world.load(b"x" * 1000), lambda: world.state["moon"]):
            with self.assertRaises(seam.Error) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))
        world.step(ticks=5)


class RunsSessions(unittest.TestCase):
    def test_two_clients_are_driven_seen_and_measured(self):
        session = seam.Session("crossing", seed=5)
        self.assertEqual(session.players, ["ann", "bob"])
        self.assertEqual(session.step({"ann": seam.Input(drive=1)}, ticks=60), 60)
        views = [session.state(peer) for peer in ("server", "ann", "bob")]
        for view in views:
            self.assertIn("car", view)
        np.testing.assert_array_equal(session.state(1).poses, views[1].poses)
        measures = session.measure()
        self.assertGreater(measures["compared"], 500)
        self.assertLess(measures["error_rms_m"], 10)

    def test_equal_sessions_give_equal_logs(self):
        with tempfile.TemporaryDirectory() as folder:
            texts = []
            for i in range(2):
                path = f"{folder}/{i}.lcm"
                session = seam.Session("crossing", drive="script", record=path, keep=False)
                session.step(ticks=90)
                del session
                with open(path, "rb") as file:
                    texts.append(file.read())
                self.assertGreaterEqual(int(seam.read(path).ticks[-1]), 80)
            self.assertEqual(texts[0], texts[1])

    def test_mistakes_raise_one_clear_error(self):
        session = seam.Session("crossing", drive="bot", keep=False)
        session.step(ticks=2)
        for call in (lambda: seam.Session("crossing", mode="bufer"), lambda: seam.Session("crossing", impair="5g"),
                     lambda: seam.Session("crossing", drive="keyboard"), lambda: seam.Session("crossing", seed=-1),
                     lambda: seam.Session("crossing", send_hz=0), lambda: seam.Session("crossing", record="/no/x"),
                     lambda: session.step({"ann": seam.Input()}), lambda: session.state("carl"),
                     lambda: session.state(9), lambda: seam.Session("crossing", seed=2**63),
                     lambda: seam.Session("crossing", record="/tmp"), lambda: session.step(ticks=-3), lambda: session.measure(),
                     lambda: seam.Session("crossing", impair="loss=100%").step()):
            with self.assertRaises(seam.Error) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))


def generated(files, folder):
    """The classes that lcm-gen makes of .lcm files, by name, with their fingerprints."""
    subprocess.run(["lcm-gen", "--python", "--ppath", folder, *map(str, files)], check=True)
    classes = {}
    for file in files:
        path = pathlib.Path(f"{folder}/seam/{file.stem}.py")
        path.write_text(path.read_text().replace("self.pass", "self.pass_"))  # of join_t: a word of Python
        spec = importlib.util.spec_from_file_location(file.stem, f"{folder}/seam/{file.stem}.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        classes[file.stem] = getattr(module, file.stem)
    return classes


def hash_of(made):
    return int.from_bytes(made._get_packed_fingerprint(), "big")


class KnowsLcmTypes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.files = sorted(pathlib.Path("lcmtypes").glob("*.lcm"))
        self.types = generated(self.files, self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def test_fingerprints_are_those_of_lcm_gen(self):
        self.assertGreater(len(self.types), 40)
        self.assertEqual(seam.lcm.fingerprints(), {name: hash_of(made) for name, made in self.types.items()})
        printed = subprocess.run([BIN / "seam-log", "types"], check=True, capture_output=True, text=True)
        rows = [line.split() for line in printed.stdout.splitlines()[1:]]
        self.assertEqual({row[0]: int(row[1], 16) for row in rows}, seam.lcm.fingerprints())
        # Without the line of the session; view_t and event_t have grown since that form was made.
        bare = {row[0]: row[2] for row in rows if row[2] != "-" and row[0] not in ("view_t", "event_t")}
        self.assertGreater(len(bare), 5)
        cut = pathlib.Path(self.folder.name) / "cut"
        cut.mkdir()
        for name in bare:
            text = pathlib.Path(f"lcmtypes/{name}.lcm").read_text()
            (cut / f"{name}.lcm").write_text(re.sub(r"(?m)^ *int64_t session;.*\n", "", text))
        made = generated(sorted(cut.glob("*.lcm")), f"{self.folder.name}/made")
        for name, text in bare.items():
            self.assertEqual(int(text, 16), hash_of(made[name]), name)

    def test_messages_have_the_bytes_of_lcm_gen(self):
        drive = self.types["drive_t"]()
        drive.utime, drive.drive, drive.lift, drive.buttons = 7, -0.5, 0.25, 5
        self.assertEqual(seam.lcm.Drive(-0.5, 0.25, 5, 7).encode(), drive.encode())
        self.assertEqual(seam.lcm.Drive.decode(drive.encode()), seam.lcm.Drive(-0.5, 0.25, 5, 7))
        message = self.types["message_t"]()
        message.utime, message.name, message.count, message.value, message.text = 3, "gate", 2, (1.5, 2), "near"
        ours = seam.lcm.Message("gate", [1.5, 2], "near", 3)
        self.assertEqual(ours.encode(), message.encode())
        self.assertEqual(seam.lcm.Message.decode(message.encode()), ours)
        ours = seam.lcm.Pose("rover", 1, 2, 3, 4, 5, 6, tick=9, peer=1, utime=11)
        pose = self.types["pose_t"].decode(ours.encode())
        self.assertEqual((pose.name, pose.x, pose.spin, pose.tick, pose.peer, pose.utime), ("rover", 1, 6, 9, 1, 11))
        self.assertEqual(seam.lcm.Pose.decode(pose.encode()), ours)

    def test_mistakes_raise_one_clear_error(self):
        nan = float("nan")
        for call in (lambda: seam.lcm.Drive(2).encode(), lambda: seam.lcm.Drive(nan).encode(),
                     lambda: seam.lcm.Drive(buttons=1 << 15).encode(),
                     lambda: seam.lcm.Drive(buttons=1 << 40).encode(), lambda: seam.lcm.Pose("a", nan).encode(),
                     lambda: seam.lcm.Message("").encode(), lambda: seam.lcm.Message("a\nb").encode(),
                     lambda: seam.lcm.Message("a", [nan]).encode(), lambda: seam.lcm.Message("a", [0] * 65).encode(),
                     lambda: seam.lcm.Drive.decode(b""), lambda: seam.lcm.Pose.decode(seam.lcm.Drive().encode()),
                     lambda: seam.lcm.Message.decode(b"x" * 40), lambda: seam.lcm.Bus("nonsense://")):
            with self.assertRaises(seam.Error) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))


class JoinsServers(unittest.TestCase):
    def setUp(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
            free.bind(("127.0.0.1", 0))
            self.at = f"127.0.0.1:{free.getsockname()[1]}"
        self.server = None

    def tearDown(self):
        if self.server is not None:
            self.stop()

    def serve(self, scene):
        self.server = subprocess.Popen([BIN / "seam-server", scene, "--bind", "127.0.0.1", "--port",
                                        self.at.split(":")[1], "--lcm-url", "none", "--duration", "0"],
                                       stderr=subprocess.PIPE, text=True)
        for line in self.server.stderr:
            if "Ctrl-C" in line:
                return

    def stop(self):
        self.server.send_signal(signal.SIGINT)
        self.server.communicate(timeout=20)
        self.server = None

    def test_drives_and_sees_until_the_room_ends(self):
        self.serve("scenes/rover.toml")
        with seam.Client(self.at, "ann") as client:
            begin = client.join()["rover"][0]
            self.assertTrue(client.running)
            tick = client.tick
            state = client.step(seam.Input(drive=1), ticks=90)
            self.assertGreaterEqual(client.tick, tick + 90)
            self.assertGreater(state["rover"][0], begin + 1)
            self.assertEqual(client.peer, 1)
            self.stop()
            while client.running:
                client.step(seam.Input())
            with self.assertRaises(seam.Error):
                client.step()

    def test_mistakes_raise_one_clear_error(self):
        self.serve("scenes/crossing.toml")
        for call, says in ((lambda: seam.Client(self.at, "carl").join(), "carl"),
                           (lambda: seam.Client(self.at, "ann").join(2), "bob"),
                           (lambda: seam.Client("127.0.0.1:9", "ann").join(1), "no answer"),
                           (lambda: seam.Client(self.at, "a b"), "a name has"),
                           (lambda: seam.Client(self.at, "ann").step(ticks=-1), "ticks -1"),
                           (lambda: seam.Client(self.at, "ann").step(ticks=1.5), "whole number"),
                           (lambda: seam.Client(self.at, "ann").state, "has not come"),
                           (lambda: seam.Client(self.at, "ann", impair="5g"), "5g"),
                           (lambda: seam.Client(self.at, "ann", server_key="12"), "64 digits"),
                           (lambda: seam.Client(self.at, "ann", lcm_url="no"), "LCM url"),
                           (lambda: seam.Client("nowhere.invalid:1", "ann"), "nowhere.invalid")):
            with self.assertRaises(seam.Error) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))
            self.assertIn(says, str(caught.exception))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
