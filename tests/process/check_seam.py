"""Checks of the Python module. python3 check_seam.py LOG CSV [CLASS...]; LOG is of `crossing`, and CSV is
its export by seam-export."""

import csv
import sys
import tempfile
import unittest

import numpy as np

import seam

LOG, CSV = sys.argv[1:3]

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
                     lambda: self.log.inputs("carl"), lambda: seam.read(LOG, room="other"),
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
                     lambda: world.step(ticks=-1), lambda: world.step({"carl": seam.Input()}),
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
                     lambda: session.state(9), lambda: session.step(ticks=-3), lambda: session.measure(),
                     lambda: seam.Session("crossing", impair="loss=100%").step()):
            with self.assertRaises(seam.Error) as caught:
                call()
            self.assertNotIn("\n", str(caught.exception))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
