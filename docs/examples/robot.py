"""Joins the scene `rover` as its player: drives by ROVER.DRIVE, and publishes what it sees on ROVER.SEEN."""
import sys
import seam

bus, drives = seam.lcm.Bus(), [seam.lcm.Drive()]
bus.subscribe("ROVER.DRIVE", lambda channel, drive: drives.append(drive), seam.lcm.Drive)
with seam.Client(sys.argv[1], "ann") as client:
    client.join()
    while client.running:
        bus.poll()
        state = client.step(seam.Input(drives[-1].drive, drives[-1].lift))
        pose = seam.lcm.Pose("rover", *state["rover"], *state.velocity("rover"), tick=state.tick, peer=client.peer)
        bus.publish("ROVER.SEEN", pose)
