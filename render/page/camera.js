// The camera: one for all panels.

// Maps the world (m) to a rectangle (px).
class Viewport {
  constructor(rect, camera) {
    this.rect = rect;
    this.scale = rect.height / camera.height;
    this.camera = camera;
  }
  x(metres) {
    return this.rect.x + this.rect.width / 2 + (metres - this.camera.x) * this.scale;
  }
  y(metres) {
    return this.rect.y + this.rect.height / 2 - (metres - this.camera.y) * this.scale;
  }
  worldX(px) {
    return this.camera.x + (px - this.rect.x - this.rect.width / 2) / this.scale;
  }
  worldY(px) {
    return this.camera.y - (px - this.rect.y - this.rect.height / 2) / this.scale;
  }
  sees(x, y, reach) {
    const r = reach * this.scale;
    const px = this.x(x);
    const py = this.y(y);
    return px + r > this.rect.x && px - r < this.rect.x + this.rect.width && py + r > this.rect.y &&
        py - r < this.rect.y + this.rect.height;
  }
}

// Returns a camera that shows a box in a rectangle.
function fitBox([minX, minY, maxX, maxY], rect) {
  const width = Math.max(maxX - minX, 0.5);
  const height = Math.max(maxY - minY, 0.5);
  return {
    x: (minX + maxX) / 2,
    y: (minY + maxY) / 2,
    height: Math.max(height, width * rect.height / rect.width),
  };
}

// Returns the box of bodies that move in a view within half a second of a tick, and of those with
// the ids `always`; null without any.
function actionBox(view, tick, always) {
  const span = view.run.hz / 2;
  const from = Math.max(0, Math.floor(tick - span));
  const to = Math.min(view.run.count - 1, Math.ceil(tick + span));
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (const track of view.tracks.bodies.values()) {
    const begin = poseOf(track, from);
    const end = poseOf(track, to);
    if (!begin || !end) continue;
    const still = Math.hypot(end[0] - begin[0], end[1] - begin[1]) < 0.2;
    if (still && !always.includes(track.id)) continue;
    const body = view.worldAt(tick).byId.get(track.id);
    const reach = body ? body.reach / 1000 : 0.5;
    for (const [x, y] of [begin, end, poseOf(track, tick) || end]) {
      box[0] = Math.min(box[0], x - reach);
      box[1] = Math.min(box[1], y - reach);
      box[2] = Math.max(box[2], x + reach);
      box[3] = Math.max(box[3], y + reach);
    }
  }
  if (box[0] > box[2]) return null;
  const margin = 0.08 * Math.max(box[2] - box[0], box[3] - box[1]);
  return [box[0] - margin, box[1] - margin, box[2] + margin, box[3] + margin];
}

// Returns the camera of a moment: the chosen one, or the scene's; on the followed body if any.
function cameraAt(view, tick, rect) {
  const camera = {...(state.camera || fitBox(view.run.camera, rect))};
  if (state.follow === null) return camera;
  const track = (view.run.oracle || view.tracks).bodies.get(state.follow) ||
      view.tracks.bodies.get(state.follow);
  const pose = poseOf(track, tick);
  if (pose) [camera.x, camera.y] = pose;
  return camera;
}
