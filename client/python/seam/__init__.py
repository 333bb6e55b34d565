"""Seam2D in Python: read logs as NumPy arrays, step scenes, run sessions, measure, join servers.

    log = seam.read("session.lcm")
    log.views["ann"]["car"]            # float32 [ticks, 3]: x, y, angle
    log.error("ann", "car")            # float64 [ticks]: m from the oracle

    world = seam.World("scenes/crossing.toml")
    state = world.step({"ann": seam.Input(drive=1)})

A mistake (no such file, scene, peer or body; a number out of range) raises `seam.Error`, a
ValueError of one line. docs/python.md is the manual.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _seam, lcm
from ._seam import Error
from .bodies import (Bodies, Body, Floats, Input, Player, State, count, input_of, log_path, some,
                     whole)
from .client import Client

__version__: str = _seam.version
__all__ = ["Bodies", "Client", "Error", "Input", "Log", "Session", "State", "View", "World", "lcm",
           "measure", "read"]


class View(Bodies):
    """A peer's view, or the oracle: arrays over the log's ticks and bodies, NaN where it has none.

    `poses`, `velocities`: float32 [ticks, bodies, 3]; `ages`: float32 [ticks, bodies], ticks by
    which a pose is older than its tick; `authority`: int16 [ticks, bodies], the peer that simulates
    the body as this one knows it, -1: unknown.
    """

    def __init__(self, data: dict[str, Any]) -> None:
        super().__init__(data["names"], data["ids"])
        self.poses: Floats = data["poses"]
        self.velocities: Floats = data["velocities"]
        self.ages: Floats = data["ages"]
        self.authority: NDArray[np.int16] = data["authority"]
        self.errors: NDArray[np.float64] | None = data.get("errors")

    def __getitem__(self, body: Body) -> Floats:
        """The poses of a body, [ticks, 3]: x, y, angle."""
        return self.poses[:, self.index(body)]


class _Views(Mapping[Player, View]):
    def __init__(self, log: Log) -> None:
        self._log = log

    def __getitem__(self, peer: Player) -> View:
        return self._log._view(peer, errors=False)

    def __iter__(self) -> Iterator[int]:
        return iter(self._log.peers)

    def __len__(self) -> int:
        return len(self._log.peers)


class Log:
    """A session's log. `ticks`: all its ticks; `time`: the same in s; `peers`: 0 is the server."""

    def __init__(self, path: str | os.PathLike[str], room: str = "", session: str = "") -> None:
        self._log = _seam.Log(os.fspath(path), room, session)
        about = self._log.room()
        self.scene: str = about["scene"]
        self.scene_text: str = about["scene_text"]
        self.mode: str = about["mode"]
        self.reconcile: str = about["reconcile"]
        self.impair: str = about["impair"]
        self.seed: int = about["seed"]
        self.tick_hz: int = about["tick_hz"]
        self.players: list[str] = about["players"]
        self.peers: list[int] = about["peers"]
        self.missing: int = about["missing"]
        self.damaged_bytes: int = about["damaged_bytes"]
        self.damage: list[str] = about["damage"]  # a line for each damaged part
        self.ticks: NDArray[np.int64] = np.arange(about["first_tick"], about["last_tick"] + 1)
        self.time: NDArray[np.float64] = self.ticks / self.tick_hz
        self.views: Mapping[Player, View] = _Views(self)
        self._kept: dict[tuple[int, bool], View] = {}
        self._oracle: View | None = None

    def peer(self, peer: Player) -> int:
        """The number of a peer: of "server", or of a player (the scene's first is 1)."""
        if isinstance(peer, str):
            if peer == "server":
                return 0
            if peer in self.players:
                return self.players.index(peer) + 1
            raise Error(f"there is no peer {peer!r}; there are: {some(['server', *self.players])}")
        return whole(peer, 0, 1023, "peer")

    def _view(self, peer: Player, errors: bool) -> View:
        number = self.peer(peer)
        for key in ((number, True), (number, errors)):
            if key in self._kept:
                return self._kept[key]
        view = View(self._log.view(number, errors))
        self._kept[number, errors] = view
        return view

    @property
    def oracle(self) -> View:
        """The truth: one world with the recorded inputs. Computed when it is first asked for."""
        if self._oracle is None:
            self._oracle = View(self._log.oracle())
        return self._oracle

    def error(self, peer: Player | None = None, body: Body | None = None) -> NDArray[np.float64]:
        """Distance of displayed positions from the oracle at the tick that is shown, m, [ticks].

        RMS over all peers if none is given, and over all bodies if none is given. NaN at ticks
        without a body to compare.
        """
        columns = []
        for each in self.peers if peer is None else [peer]:
            view = self._view(each, errors=True)
            assert view.errors is not None
            columns.append(view.errors if body is None else view.errors[:, [view.index(body)]])
        if not columns:
            raise Error("no peer has published a view")
        squared = np.concatenate(columns, axis=1) ** 2
        known = np.count_nonzero(~np.isnan(squared), axis=1)
        sums = np.nansum(squared, axis=1)
        return np.sqrt(np.divide(sums, known, out=np.full(len(sums), np.nan), where=known > 0))

    def inputs(self, player: Player) -> dict[str, NDArray[Any]]:
        """A player's inputs: arrays `tick`, `drive` and `lift` (-127 to 127), `buttons` (bits)."""
        return self._log.inputs(_player(player, self.players))

    def measure(self) -> dict[str, Any]:
        """All measures (docs/metrics.md); None where one does not apply."""
        return self._log.measure()


class World:
    """A scene's world alone, gym-like: `reset`, `step`, `state`. Equal calls give equal bits.

    `scene`: a file, or the name of a scene as programs take it; or `text`, a scene file's text.
    Rules of the server (triggers, health, scripts) do not act.
    """

    def __init__(self, scene: str | os.PathLike[str] = "", *, text: str = "") -> None:
        self.scene = _scene(scene, text)
        self.players: list[str] = self.scene.players
        self._world = _seam.World(self.scene)

    def reset(self) -> State:
        """Goes back to tick 0; all inputs are released."""
        self._world.reset()
        return self.state

    def step(self, inputs: Mapping[Player, Input] | None = None, ticks: int = 1) -> State:
        """Sets the given inputs, which are held until they are given again, and steps."""
        _give(self._world, inputs, self.players)
        self._world.step(count(ticks))
        return self.state

    @property
    def state(self) -> State:
        """The moving bodies now."""
        return State(self._world.state())

    @property
    def dt(self) -> float:
        """Seconds of a tick."""
        return 1 / self.scene.tick_hz

    @property
    def energy(self) -> float:
        """Kinetic and potential energy of the moving bodies, J."""
        return self._world.energy()

    def write(self, body: Body, pose: Iterable[float], velocity: Iterable[float] = (0, 0, 0)) -> None:
        """Sets pose (x, y, angle) and velocity (vx, vy, spin) of a body."""
        state = self.state
        self._world.write(int(state.ids[state.index(body)]), list(pose), list(velocity))

    def save(self) -> bytes:
        """The state; a world of the same scene that loads it continues with the same bits."""
        return self._world.save()

    def load(self, saved: bytes) -> State:
        """Continues a saved state of the same scene."""
        self._world.load(saved)
        return self.state


class Session:
    """A server and a client for each player, in this process, over a simulated network, in virtual
    time. `drive`: inputs (those of `step`), script (the scene's) or bot. `record`: a log to write.
    `keep`: keep all in memory, so that `measure` works without a log.
    """

    def __init__(
        self,
        scene: str | os.PathLike[str] = "",
        *,
        text: str = "",
        mode: str = "buffer",
        reconcile: str = "",
        predict: str = "",
        impair: str = "demo",
        seed: int = 1,
        send_hz: int = 30,
        drive: str = "inputs",
        record: str | os.PathLike[str] = "",
        force: bool = False,
        keep: bool = True,
    ) -> None:
        self.scene = _scene(scene, text)
        self.players: list[str] = self.scene.players
        self._session = _seam.Session(
            self.scene, mode=mode, reconcile=reconcile, predict=predict, impair=impair,
            seed=whole(seed, -2**63, 2**63 - 1, "seed"), send_hz=whole(send_hz, 0, 2**31 - 1, "send_hz"),
            drive=drive, record=log_path(record), force=force, keep=keep)

    def step(self, inputs: Mapping[Player, Input] | None = None, ticks: int = 1) -> int:
        """Sets inputs, and runs until the server has done so many more ticks. Returns its tick."""
        _give(self._session, inputs, self.players)
        self._session.run_to(self.tick + count(ticks))
        return self.tick

    def run(self) -> int:
        """Runs to the end of the scene's duration."""
        self._session.run_to(int(self.scene.duration_s * self.scene.tick_hz))
        return self.tick

    @property
    def tick(self) -> int:
        """The server's tick."""
        return self._session.tick()

    def state(self, peer: Player = "server") -> State:
        """The bodies as a peer displays them now: "server" or 0, or a player."""
        if peer in ("server", 0):
            return State(self._session.state(0))
        number = _player(peer, self.players) + 1 if isinstance(peer, str) else whole(
            peer, 0, len(self.players), "peer")
        return State(self._session.state(number))

    def measure(self) -> dict[str, Any]:
        """All measures so far (docs/metrics.md); None where one does not apply."""
        return self._session.measure()

    def flush(self) -> None:
        """Writes the rest of the log; it is written too when the session is deleted."""
        self._session.flush()


def read(path: str | os.PathLike[str], room: str = "", session: str = "") -> Log:
    """Reads a log. `room` and `session` choose one of several, as the programs' flags do."""
    return Log(path, room, session)


def measure(path: str | os.PathLike[str]) -> dict[str, Any]:
    """All measures of a log (docs/metrics.md); None where one does not apply."""
    return Log(path).measure()


def _player(player: Player, players: list[str]) -> int:
    if isinstance(player, str):
        if player in players:
            return players.index(player)
        raise Error(f"there is no player {player!r}; there are: {some(players)}")
    return whole(player, 0, len(players) - 1, "player")


def _give(
    to: _seam.World | _seam.Session, inputs: Mapping[Player, Input] | None, players: list[str]
) -> None:
    for player, given in (inputs or {}).items():
        to.input(_player(player, players), *input_of(given, player)._numbers())


def _scene(scene: str | os.PathLike[str], text: str) -> _seam.Scene:
    word = os.fspath(scene)
    if bool(word) == bool(text):
        raise Error("give a scene's file or name, or text=, and not both")
    return _seam.parse_scene(text, "scene.toml") if text else _seam.load_scene(word)
