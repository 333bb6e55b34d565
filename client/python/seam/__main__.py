"""python3 -m seam LOG...: what is in logs, their measures, and the error over time."""

from __future__ import annotations

import argparse
import os
import sys

import numpy as np

import seam


def bars(values: np.ndarray, width: int = 60) -> str:
    """The values as a line of blocks, the highest as a full one."""
    pieces = [piece[~np.isnan(piece)] for piece in np.array_split(values, min(width, len(values)))]
    means = np.array([np.sqrt(np.mean(piece**2)) if len(piece) else 0 for piece in pieces])
    top = means.max(initial=0)
    if top <= 0:
        return " " * len(means)
    return "".join(" ▁▂▃▄▅▆▇█"[int(np.ceil(8 * mean / top))] for mean in means)


def read(path: str) -> seam.Log:
    """Reads a log, and names its damaged parts on stderr."""
    log = seam.read(path)
    for line in log.damage:
        print(f"python3 -m seam: warning: {path}: {line}", file=sys.stderr)
    return log


def show(log: seam.Log, path: str) -> None:
    method = log.mode + (f"/{log.reconcile}" if log.reconcile else "")
    print(f"{path}: {log.scene}, {method}, network {log.impair}, seed {log.seed}, "
          f"{len(log.ticks)} ticks of 1/{log.tick_hz} s, players {', '.join(log.players)}")
    measures = log.measure()
    if not measures["valid"]:
        print(f"  not valid: {measures['why_not_valid']}")
    for name, value in measures.items():
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            print(f"  {name:<22}{value:>12.6g}")
    for peer in log.peers:
        try:
            error = log.error(peer)
        except seam.Error as why:
            print(f"  {why}")
            break
        name = "server" if peer == 0 else log.players[peer - 1] if peer <= len(log.players) else peer
        worst = np.nanmax(error) if np.any(~np.isnan(error)) else 0
        print(f"  error {name!s:<10} |{bars(error)}| at most {worst:.3g} m")


def main() -> int:
    parser = argparse.ArgumentParser(prog="python3 -m seam", description=__doc__)
    parser.add_argument("log", nargs="+", help="recordings (LCM logs)")
    parser.add_argument("--error", action="store_true", help="print tick,error_m as CSV instead")
    parser.add_argument("--version", action="version", version=f"seam {seam.__version__}")
    options = parser.parse_args()
    status = 0
    try:
        for path in options.log:
            log = read(path)
            status = max(status, 1 if log.damage else 0)
            if not options.error:
                show(log, path)
                continue
            print("tick,error_m")
            for tick, error in zip(log.ticks, log.error()):
                print(f"{tick},{error:.6g}")
    except seam.Error as error:
        print(f"python3 -m seam: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return status


if __name__ == "__main__":
    sys.exit(main())
