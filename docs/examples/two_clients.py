"""A session of two clients in virtual time, over a network with 100 ms each way, measured."""
import seam

session = seam.Session("scenes/crossing.toml", impair="delay=100ms", seed=7)
session.step({"ann": seam.Input(drive=1), "bob": seam.Input()}, ticks=60)
session.step({"bob": seam.Input(drive=-1)}, ticks=120)
for peer in ("server", "ann", "bob"):
    print(f"{peer:8} {session.state(peer)['car'][:2]}")
measures = session.measure()
print(f"error of others {1000 * measures['error_others_m']:.0f} mm, seen {measures['seen']:.3f}")
