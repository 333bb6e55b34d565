"""Drives the scene `rover` over LCM until its pose is that of a parked rover, as rover.cpp does."""
import seam

bus, heard = seam.lcm.Bus(), {}


def on_pose(channel, pose):
    heard[pose.name] = pose


bus.subscribe("ROVER.POSE", on_pose, seam.lcm.Pose)
while "rover" not in heard or abs(heard["rover"].x - 10) > 0.5 or abs(heard["rover"].vx) > 0.02:
    bus.poll(1)
    if "rover" in heard:
        rover, gate = heard["rover"], heard.pop("gate", None)  # no pose of it comes once it has gone
        way = (-1.5 if gate else 10) - rover.x - (0.5 if gate else 0)
        drive = max(-1.0, min(1.0, 0.4 * way - 0.2 * rover.vx))
        bus.publish("ROVER.DRIVE", seam.lcm.Drive(drive))
        bus.publish("ROVER.SENSOR", seam.lcm.Message("gate", [abs(-1.5 - rover.x)]))
print("parked")
