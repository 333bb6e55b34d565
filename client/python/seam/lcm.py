"""The LCM bus: the channels of a scene's `[lcm]`, those of rooms, and those of other programs.

    bus = seam.lcm.Bus()
    bus.subscribe("ROVER.POSE", on_pose, seam.lcm.Pose)      # on_pose(channel, pose)
    bus.publish("ROVER.DRIVE", seam.lcm.Drive(drive=1))
    bus.poll(0.1)                                            # calls on_pose for what has come

Drive, Pose and Message are the types that rooms understand (docs/recordings.md). Types that
`lcm-gen --python` has made go likewise, and bytes go as they are.
"""

from __future__ import annotations

import collections
import dataclasses
from collections.abc import Callable, Iterable
from typing import Any, Protocol, Union

from . import _seam
from ._seam import Error
from .bodies import whole

__all__ = ["Bus", "Drive", "Message", "Pose", "fingerprints"]


@dataclasses.dataclass
class Drive:
    """drive_t: a player's inputs; axes from -1 to 1, `buttons` is a bit for each button."""

    drive: float = 0.0
    lift: float = 0.0
    buttons: int = 0
    utime: int = 0

    def encode(self) -> bytes:
        return _seam.encode_drive(_time(self.utime), self.drive, self.lift,
                                  whole(self.buttons, 0, 0x7FFF, "buttons"))

    @staticmethod
    def decode(data: bytes) -> Drive:
        utime, drive, lift, buttons = _seam.decode_drive(data)
        return Drive(drive, lift, buttons, utime)


@dataclasses.dataclass
class Pose:
    """pose_t: a part's pose in m and rad, and its velocity; `peer` 0 is the server."""

    name: str = ""
    x: float = 0.0
    y: float = 0.0
    angle: float = 0.0
    vx: float = 0.0
    vy: float = 0.0
    spin: float = 0.0
    tick: int = 0
    peer: int = 0
    utime: int = 0

    def encode(self) -> bytes:
        return _seam.encode_pose(_time(self.utime), whole(self.tick, -1, 2**62, "tick"),
                                 whole(self.peer, 0, 1023, "peer"), self.name, self.x, self.y,
                                 self.angle, self.vx, self.vy, self.spin)

    @staticmethod
    def decode(data: bytes) -> Pose:
        utime, tick, peer, name, *pose = _seam.decode_pose(data)
        return Pose(name, *pose, tick=tick, peer=peer, utime=utime)


@dataclasses.dataclass
class Message:
    """message_t: an event of a sensor or system, for `on_message` of a room's scripts."""

    name: str = ""
    value: Iterable[float] = ()
    text: str = ""
    utime: int = 0

    def encode(self) -> bytes:
        return _seam.encode_message(_time(self.utime), self.name, list(self.value), self.text)

    @staticmethod
    def decode(data: bytes) -> Message:
        utime, name, value, text = _seam.decode_message(data)
        return Message(name, value, text, utime)


class Encodes(Protocol):
    def encode(self) -> bytes: ...


class Decodes(Protocol):
    def decode(self, data: bytes) -> Any: ...


Handler = Callable[[str, Any], object]


class Bus:
    """The bus of `url` (LCM's; "": LCM_DEFAULT_URL, or LCM's default). It takes one call at a time.

    `refused`: messages that have come on a typed subscription and were of another type.
    """

    def __init__(self, url: str = "") -> None:
        self._bus = _seam.Bus(url)
        self._subscriptions: list[tuple[Handler, Decodes | None]] = []
        self._arrived: collections.deque[tuple[int, str, int, bytes]] = collections.deque()
        self.refused = 0

    def publish(self, channel: str, message: Union[bytes, bytearray, memoryview, Encodes]) -> None:
        """Sends bytes, or anything with `encode()`."""
        if isinstance(message, (bytes, bytearray, memoryview)):
            data = bytes(message)
        elif hasattr(message, "encode") and not isinstance(message, str):
            data = message.encode()
        else:
            raise Error(f"a message is bytes or has encode(), not {type(message).__name__}")
        if "\0" in channel:
            raise Error(f"channel {channel!r}: a channel's name has no zero byte")
        self._bus.publish(channel, data)

    def subscribe(self, channels: str, handler: Handler, type: Decodes | None = None) -> None:
        """Has `poll` call `handler(channel, message)` for each message on a channel that matches
        the whole regular expression: with bytes, or of `type`, if one is given."""
        self._bus.subscribe(channels, len(self._subscriptions))
        self._subscriptions.append((handler, type))

    def poll(self, timeout: float = 0.0) -> int:
        """Calls the handlers of what has come; waits at most `timeout` s for the first message.
        Returns the number of messages. When a handler raises, those behind its message are for
        the next call."""
        arrived = self._arrived
        arrived.extend(self._bus.poll(0 if arrived else round(1e6 * timeout)))
        taken = 0
        while arrived:
            number, channel, _, data = arrived.popleft()
            taken += 1
            handler, type = self._subscriptions[number]
            if type is None:
                handler(channel, data)
                continue
            try:
                message = type.decode(data)
            except ValueError:  # of ours, and of lcm-gen's types
                self.refused += 1
                continue
            handler(channel, message)
        return taken

    @property
    def warnings(self) -> list[str]:
        """Lines about a bus that will lose messages, each with a remedy."""
        return self._bus.warnings()


def _time(utime: int) -> int:
    return whole(utime, -2**63, 2**63 - 1, "utime")


def fingerprints() -> dict[str, int]:
    """The fingerprint of each LCM type of Seam2D: the first 8 bytes of its messages."""
    return _seam.fingerprints()
