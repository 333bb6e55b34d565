"""A player's client of a real server."""

from __future__ import annotations

import os
import time

from . import _seam
from ._seam import Error
from .bodies import Input, State, count, input_of, log_path, whole


class Client:
    """A player's client of a server, over UDP and in real time. `with seam.Client(...) as client:`
    leaves at the end.

    `server`: host:port; `name`: the player to be, "" only looks on; `room`: "" is the server's
    first; `impair`: a network profile, both directions; `lcm_url`: a bus for its views ("none":
    none); `record`: a log to write. The client lives in `join` and `step`: a program that calls
    neither for 5 s has to join anew. It takes one call at a time.
    """

    def __init__(
        self,
        server: str = "127.0.0.1:7777",
        name: str = "",
        *,
        room: str = "",
        server_key: str = "",
        impair: str = "perfect",
        seed: int = 1,
        lcm_url: str = "none",
        record: str | os.PathLike[str] = "",
        force: bool = False,
    ) -> None:
        self.server = server
        self._notice = ""
        self._client = _seam.Client(
            server, name, room=room, server_key=server_key, impair=impair,
            seed=whole(seed, -2**63, 2**63 - 1, "seed"), lcm_url=lcm_url, record=log_path(record),
            force=force)

    def __enter__(self) -> Client:
        return self

    def __exit__(self, *_: object) -> None:
        self.leave()

    def join(self, timeout: float = 10.0) -> State:
        """Waits until the room runs, at most `timeout` s; returns its bodies."""
        end = time.monotonic() + timeout
        while self._client.tick() < 0:
            self._turn(timeout)
            if self._client.ended():
                raise Error(f"{self.server} has closed the room")
            if time.monotonic() > end and self._client.tick() < 0:
                why = self._notice or "are other players missing?"
                raise Error(f"the room has not begun in {timeout:g} s: {why}")
        return self.state

    def step(self, input: Input | None = None, ticks: int = 1, timeout: float = 10.0) -> State:
        """Sets the input, which is held until it is given again, and runs so many ticks of the
        room, or to its end: then `running` is False. Returns the bodies as this client displays
        them. Joins first, if need be; raises Error when the server has been silent for `timeout` s."""
        more = count(ticks)
        if self._client.ended():
            raise Error(f"{self.server} has closed the room, or this client has left it")
        if self._client.tick() < 0:
            self.join(timeout)
        if input is not None:
            self._client.input(*input_of(input, "this client")._numbers())
        goal = self._client.tick() + more
        while self._client.tick() < goal and not self._client.ended():
            self._turn(timeout)
        return self.state

    def _turn(self, timeout: float) -> None:
        self._client.turn()
        self._notice = self._client.notice() or self._notice
        if self._client.joining_s() > timeout:
            raise Error(f"no answer from {self.server} in {timeout:g} s")

    @property
    def running(self) -> bool:
        """Whether the room runs, and this client is in it."""
        return self._client.tick() >= 0 and not self._client.ended()

    @property
    def tick(self) -> int:
        """The tick of the client's world; -1 before the room runs."""
        return self._client.tick()

    @property
    def peer(self) -> int:
        """The client's number in logs; -1 before it has joined."""
        return self._client.peer()

    @property
    def state(self) -> State:
        """The bodies as this client displays them now."""
        return State(self._client.state())

    def leave(self) -> None:
        """Says goodbye."""
        self._client.leave()
