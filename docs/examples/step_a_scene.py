"""Steps a scene with one player's inputs, and goes back to a saved state."""
import seam

world = seam.World("scenes/crossing.toml")
for tick in range(60):
    state = world.step({"ann": seam.Input(drive=1 if tick < 30 else -1)})
saved = world.save()
first = world.step(ticks=60)
again = world.load(saved) and world.step(ticks=60)
print(f"tick {again.tick}: ann's car is at x = {again['car'][0]:.2f} m")
print("the same bits:", (first.poses == again.poses).all())
