"""Bodies and inputs, as worlds, sessions, clients and logs have them."""

from __future__ import annotations

import dataclasses
import operator
import os
from collections.abc import Iterable, Iterator
from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from ._seam import Error

Floats = NDArray[np.float32]
Player = Union[str, int]
Body = Union[str, int]


@dataclasses.dataclass(frozen=True)
class Input:
    """A player's input: two axes from -1 to 1, and the numbers of the buttons that are down."""

    drive: float = 0.0
    lift: float = 0.0
    buttons: Iterable[int] = ()

    def _numbers(self) -> tuple[int, int, int]:
        bits = 0
        for button in self.buttons:
            if not 0 <= button <= 14:
                raise Error(f"button {button}: buttons are numbers from 0 to 14")
            bits |= 1 << button
        for axis in (self.drive, self.lift):
            if not -1 <= axis <= 1:  # false for NaN
                raise Error(f"{axis}: drive and lift are from -1 to 1")
        return round(self.drive * 127), round(self.lift * 127), bits


class Bodies:
    """Bodies by name or id. A body is named by its root part; `names` are all of them."""

    def __init__(self, names: list[str], ids: NDArray[np.int32]) -> None:
        self.names = names
        self.ids = ids

    def index(self, body: Body) -> int:
        """The body's place in the arrays."""
        if isinstance(body, str):
            if body in self.names:
                return self.names.index(body)
        elif body in self.ids:
            return int(np.flatnonzero(self.ids == body)[0])
        raise Error(f"there is no moving body {body!r}; there are: {some(self.names)}")

    def __len__(self) -> int:
        return len(self.names)

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __contains__(self, body: object) -> bool:
        return body in self.names


class State(Bodies):
    """Bodies at one tick: `poses` and `velocities`, float32 [bodies, 3] in m, rad and seconds."""

    def __init__(self, data: dict[str, Any]) -> None:
        super().__init__(data["names"], data["ids"])
        self.tick: int = data["tick"]
        self.poses: Floats = data["poses"]
        self.velocities: Floats = data["velocities"]

    def __getitem__(self, body: Body) -> Floats:
        """The pose of a body: x, y, angle."""
        return self.poses[self.index(body)]

    def velocity(self, body: Body) -> Floats:
        """vx, vy, spin of a body."""
        return self.velocities[self.index(body)]


def whole(value: object, low: int, high: int, what: str) -> int:
    """A whole number of a range, or Error."""
    try:
        number = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise Error(f"{what} {value!r} is no whole number") from None
    if not low <= number <= high:
        raise Error(f"{what} {number} is not within {low} and {high}")
    return number


def count(ticks: object) -> int:
    """A number of ticks that one call may step."""
    return whole(ticks, 0, 100_000_000, "ticks")


def input_of(given: object, player: object) -> Input:
    """What is given as a player's input, if it is one."""
    if not isinstance(given, Input):
        raise Error(f"the input of {player!r} is a seam.Input, not {type(given).__name__}")
    return given


def log_path(record: str | os.PathLike[str]) -> str:
    """The file to record to; "": none."""
    path = os.fspath(record)
    if os.path.isdir(path):
        raise Error(f"{path}: a folder, not a log's file")
    return path


def some(names: list[str]) -> str:
    """The first names, for an error's line."""
    return ", ".join(names[:12]) + (" ..." if len(names) > 12 else "") if names else "none"
