"""Checks of the Python module: objects that threads share, messages behind a handler that raises,
measures that do not apply. python3 check_shared.py LOG [CLASS...]"""

import sys
import threading
import unittest

import numpy as np

import seam

LOG = sys.argv[1]


def together(*calls, times=60):
    """Runs each call so many times in a thread of its own; returns what they raised."""
    raised = []

    def run(call):
        try:
            for _ in range(times):
                call()
        except Exception as error:
            raised.append(error)

    threads = [threading.Thread(target=run, args=[call]) for call in calls]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return raised


class SharesObjects(unittest.TestCase):
    def test_a_world_takes_one_call_at_a_time(self):
        world = seam.World("wall")
        kept = world.save()
        raised = together(lambda: world.step(ticks=3), lambda: world.step(ticks=3),
                          lambda: (world.state, world.energy),
                          lambda: (world.reset(), world.load(kept)))
        self.assertEqual(raised, [])
        world.reset()
        raised = together(*4 * [lambda: world.step(ticks=2)], times=20)
        self.assertEqual(raised, [])
        alone = seam.World("wall")
        alone.step(ticks=160)
        np.testing.assert_array_equal(world.state.poses, alone.state.poses)

    def test_a_session_takes_one_call_at_a_time(self):
        session = seam.Session("wall", keep=True)
        raised = together(session.step, session.step, lambda: session.state("ann"))
        self.assertEqual(raised, [])
        self.assertGreaterEqual(session.tick, 60)

    def test_a_log_takes_one_call_at_a_time(self):
        log = seam.read(LOG)
        raised = together(*4 * [lambda: (log.error("ann"), log.oracle, log.measure())], times=2)
        self.assertEqual(raised, [])
        raised = together(*4 * [lambda: (seam.read(LOG), log.measure())], times=2)
        self.assertEqual(raised, [])


class HandlesMessages(unittest.TestCase):
    def test_a_handler_that_raises_loses_its_own_message_alone(self):
        bus, seen = seam.lcm.Bus("memq://"), []

        def handler(channel, data):
            if data == b"2":
                raise RuntimeError("the second one")
            seen.append(data)

        bus.subscribe("X", handler)
        for number in range(5):
            bus.publish("X", str(number).encode())
        with self.assertRaises(RuntimeError):
            while bus.poll(0.2):
                pass
        while bus.poll(0.2):
            pass
        self.assertEqual(seen, [b"0", b"1", b"3", b"4"])


class Measures(unittest.TestCase):
    """LOG is of a session without its beginning: there is no oracle."""

    def test_there_is_no_number_of_an_error_that_is_not_known(self):
        measures = seam.read(LOG).measure()
        self.assertFalse(measures["valid"])
        self.assertEqual(measures["compared"], 0)
        for name, value in measures.items():
            if "error" in name or "stutter" in name or name in ("seen", "backsteps"):
                self.assertIsNone(value, name)
        self.assertGreater(measures["bytes_per_s"], 0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
