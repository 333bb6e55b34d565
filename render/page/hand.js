// A hand that drags a body on a panel: by a spring the server pulls the grabbed point to the
// pointer.

const HAND_MS = 50;        // between two commands while the pointer moves
const HAND_HELD_MS = 250;  // a hand that rests is told again, or the server lets go
const HAND_REACH_PX = {
  mouse: 6,
  pen: 10,
  touch: 18
};

// Returns the distance of a point from an outline, all in millimetres of the body; 0 inside.
function distanceTo([kind, radius, ...points], x, y) {
  if (kind === 1) return Math.max(0, Math.hypot(x - points[0], y - points[1]) - radius);
  let [nearest, inside] = [Infinity, false];
  const count = points.length / 2;
  for (let i = 0; i < count - (kind === 0 ? 0 : 1); ++i) {
    const [ax, ay] = [points[2 * i], points[2 * i + 1]];
    const j = (i + 1) % count;
    const [dx, dy] = [points[2 * j] - ax, points[2 * j + 1] - ay];
    const along = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1);
    const share = Math.min(Math.max(along, 0), 1);
    nearest = Math.min(nearest, Math.hypot(x - ax - share * dx, y - ay - share * dy));
    const crosses = (ay > y) !== (ay + dy > y) && x < ax + dx * (y - ay) / dy;
    if (kind === 0 && crosses) inside = !inside;
  }
  return inside ? 0 : nearest;
}

// Returns a place of the world in the frame of a pose, m.
function inFrame([px, py, angle], x, y) {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return [cos * (x - px) + sin * (y - py), cos * (y - py) - sin * (x - px)];
}

class Hand {
  constructor(page, control) {
    this.page = page;
    this.control = control;
    this.held = null;
    setInterval(() => this.tell(), HAND_MS);
    for (const name of ['blur', 'pagehide']) window.addEventListener(name, () => this.letGo());
  }
  // Returns the panel under a point of the canvas: its view and its viewport.
  panelAt(x, y) {
    const {page} = this;
    const views = page.views();
    const inside = (r) => x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
    const i = state.mode === 'side' ? page.rects.findIndex(inside) :
        state.mode === 'wipe' && x > state.wipe * page.rects[0].width ? 1 :
                                                                        0;
    if (i < 0) return null;
    const rect = state.mode === 'side' ? page.rects[i] : page.rects[0];
    return {rect, view: views[i] || views[0]};
  }
  // Takes hold of the body under the pointer, if there is one; returns true if it does.
  take(x, y, kind) {
    if (this.held) {  // a second finger
      this.letGo();
      return false;
    }
    const panel = state.live && this.control.values ? this.panelAt(x, y) : null;
    if (!panel) return false;
    const viewport = new Viewport(panel.rect, this.page.camera);
    const [wx, wy] = [viewport.worldX(x), viewport.worldY(y)];
    const reach = HAND_REACH_PX[kind] || HAND_REACH_PX.mouse;
    let best = null;
    for (const body of panel.view.worldAt(state.tick).moving) {
      const pose = poseOf(panel.view.tracks.bodies.get(body.id), state.tick);
      if (!pose) continue;
      const point = inFrame(pose, wx, wy);
      const [mx, my] = point.map((metres) => 1000 * metres);
      const far = Math.min(...body.shapes.map((shape) => distanceTo(shape, mx, my)));
      if (far / 1000 * viewport.scale > reach || (best && far > best.far)) continue;
      best = {body, far, point};
    }
    if (!best) return false;
    this.held = {...panel, ...best, x, y, told: '', told_ms: 0};
    this.tell();
    return true;
  }
  move(x, y) {
    if (this.held) Object.assign(this.held, {x, y});
    this.page.changed();
  }
  // Returns the pointer's place in the world: the camera may follow a body meanwhile.
  target() {
    const {rect, x, y} = this.held;
    const viewport = new Viewport(rect, this.page.camera);
    return [viewport.worldX(x), viewport.worldY(y)];
  }
  tell() {
    if (!this.held || this.control.busy) return;
    const {body, point} = this.held;
    const numbers = [...point, ...this.target()].map((metres) => metres.toFixed(3));
    const command = `drag ${body.name} ${numbers.join(' ')}`;
    const now = performance.now();
    if (command === this.held.told && now - this.held.told_ms < HAND_HELD_MS) return;
    Object.assign(this.held, {told: command, told_ms: now});
    const held = this.held;
    this.control.send(command).then((why) => {
      this.control.text.textContent = why === '' ? `Dragging ${body.name}.` : why;
      if (why !== '' && this.held === held) this.held = null;
    });
  }
  letGo() {
    if (!this.held) return;
    const {name} = this.held.body;
    this.held = null;
    this.control.send(`release ${name}`).then(() => (this.control.text.textContent = ''));
    this.page.changed();
  }
  // Draws the spring in its panel.
  draw(c) {
    if (!this.held) return;
    const {rect, view, body, point, x, y} = this.held;
    const pose = poseOf(view.tracks.bodies.get(body.id), state.tick);
    if (!pose) return;
    const viewport = new Viewport(rect, this.page.camera);
    const [cos, sin] = [Math.cos(pose[2]), Math.sin(pose[2])];
    const px = viewport.x(pose[0] + cos * point[0] - sin * point[1]);
    const py = viewport.y(pose[1] + sin * point[0] + cos * point[1]);
    c.save();
    c.beginPath();
    c.rect(rect.x, rect.y, rect.width, rect.height);
    c.clip();
    c.strokeStyle = c.fillStyle = COLOURS.theme.accent;
    c.lineWidth = 2;
    c.beginPath();
    c.moveTo(px, py);
    c.lineTo(x, y);
    c.stroke();
    c.beginPath();
    c.arc(px, py, 4, 0, 2 * Math.PI);
    c.fill();
    c.restore();
  }
}

// Lets the pointer drag bodies on the panels.
function wireHand(page, control) {
  page.hand = new Hand(page, control);
  $('keys').append(
      element('dt', 'press on a body'),
      element('dd', 'while it is live: drag the body by a spring, for all players'));
}
