// One view on one panel, with the enabled layers.

const TRAIL_SECONDS = 0.75;
const SPARK_SECONDS = 0.5;

function moved(track, tick, span, pixels, scale) {
  const now = poseOf(track, tick);
  const then = poseOf(track, Math.max(0, tick - span));
  return now && then && Math.hypot(now[0] - then[0], now[1] - then[1]) * scale > pixels;
}

// Draws the trail of each mechanism's heaviest body: one dot for each tick.
function drawDots(c, viewport, view, tick) {
  const span = Math.round(TRAIL_SECONDS * view.run.hz);
  for (const body of view.worldAt(tick).moving) {
    const track = body.leads && view.tracks.bodies.get(body.id);
    if (!track || !moved(track, tick, span, 3, viewport.scale)) continue;
    for (let i = Math.max(0, Math.ceil(tick - span)); i <= tick; ++i) {
      if (!track.has[i]) continue;
      const owner = Math.floor(track.owner[i] / 3);
      c.globalAlpha = 0.25 + 0.75 * (1 - (tick - i) / span);
      c.fillStyle = mixColours(peerColour(owner), COLOURS.theme.ink, 0.35);
      c.beginPath();
      c.arc(viewport.x(track.x[i] / 1000), viewport.y(track.y[i] / 1000), 1.8, 0, 2 * Math.PI);
      c.fill();
    }
  }
  c.globalAlpha = 1;
}

function visitTruth(view, tick, visit) {
  if (!view.run.oracle) return;
  const world = view.worldAt(tick);
  for (const body of world.moving) {
    const truth = poseOf(view.run.oracle.bodies.get(body.id), view.tickShown(body.id, tick));
    const shown = poseOf(view.tracks.bodies.get(body.id), tick);
    if (truth) visit(body, truth, shown);
  }
}

// Draws the oracle's outline, stronger with the distance of the view from it.
function drawTruth(c, viewport, view, tick) {
  c.strokeStyle = COLOURS.theme.ink;
  c.lineWidth = 1.2;
  visitTruth(view, tick, (body, truth, shown) => {
    const turn = shown ? Math.abs(shown[2] - truth[2]) * body.reach / 1000 : 0;
    const apart = shown ?
        (Math.hypot(shown[0] - truth[0], shown[1] - truth[1]) + turn) * viewport.scale :
        1e3;
    const alpha = Math.min(Math.max((apart - 0.75) / 2, 0), 1);
    if (alpha === 0 || !viewport.sees(truth[0], truth[1], body.reach / 1000)) return;
    c.globalAlpha = 0.85 * alpha;
    c.setLineDash(body.reach / 1000 * viewport.scale < 10 ? [] : [4, 3]);
    strokeBody(c, viewport, body, truth);
  });
  c.setLineDash([]);
  c.globalAlpha = 1;
}

function drawArrow(c, x0, y0, x1, y1) {
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (length < 2) return;
  const ux = (x1 - x0) / length;
  const uy = (y1 - y0) / length;
  const head = Math.min(6, length / 2);
  c.beginPath();
  c.moveTo(x0, y0);
  c.lineTo(x1, y1);
  c.moveTo(x1 - head * (ux + 0.5 * uy), y1 - head * (uy - 0.5 * ux));
  c.lineTo(x1, y1);
  c.lineTo(x1 - head * (ux - 0.5 * uy), y1 - head * (uy + 0.5 * ux));
  c.stroke();
}

function drawVectors(c, viewport, view, tick) {
  c.strokeStyle = COLOURS.theme.spark;
  c.lineWidth = 1.5;
  visitTruth(view, tick, (body, truth, shown) => {
    if (!shown) return;
    drawArrow(
        c, viewport.x(truth[0]), viewport.y(truth[1]), viewport.x(shown[0]), viewport.y(shown[1]));
  });
}

function drawContacts(c, viewport, view, tick) {
  const span = SPARK_SECONDS * view.run.hz;
  for (const event of view.run.events) {
    const age = (tick + view.run.first - event.tick) / span;
    if (event.kind !== 'impact' || event.peer !== view.peer || age < 0 || age >= 1) continue;
    const strength = Math.min(Math.sqrt(event.size), 5);
    const x = viewport.x(event.at[0] / 1000);
    const y = viewport.y(event.at[1] / 1000);
    c.globalAlpha = 0.9 * (1 - age);
    c.strokeStyle = COLOURS.theme.spark;
    c.lineWidth = 1.6;
    c.beginPath();
    c.arc(x, y, 4 + 4 * strength * (0.3 + 0.7 * age), 0, 2 * Math.PI);
    c.stroke();
  }
  c.globalAlpha = 1;
}

function drawLabel(c, text, x, y, colour) {
  c.font = '600 11px system-ui, sans-serif';
  c.textAlign = 'center';
  c.lineWidth = 3;
  c.lineJoin = 'round';
  c.strokeStyle = COLOURS.theme.panel;
  c.strokeText(text, x, y);
  c.fillStyle = colour;
  c.fillText(text, x, y);
}

// Returns the width of a text, px: an upper bound, since SVG has no way to measure.
function textWidth(text, size) {
  return 0.62 * size * text.length;
}

// Draws the name of the view's peer, {text, colour, side}, in an upper corner of the panel.
function drawTitle(c, rect, {text, colour, side}) {
  c.save();
  c.font = '600 12px system-ui, sans-serif';
  c.textAlign = side;
  const x = side === 'left' ? rect.x + 24 : rect.x + rect.width - 24;
  c.lineWidth = 3;
  c.strokeStyle = COLOURS.theme.panel;
  c.strokeText(text, x, rect.y + 18);
  c.fillStyle = COLOURS.theme.ink;
  c.fillText(text, x, rect.y + 18);
  c.fillStyle = colour;
  c.fillRect(side === 'left' ? rect.x + 10 : rect.x + rect.width - 18, rect.y + 9, 8, 10);
  c.restore();
}

// Returns the area of a title, with its colour.
function titleBox(rect, {text, side}) {
  const width = 30 + textWidth(text, 12);
  const left = side === 'left' ? rect.x : rect.x + rect.width - width;
  return {left, top: rect.y, right: left + width, bottom: rect.y + 24};
}

// Returns the highest point of a body, m.
function topOf(body, pose) {
  const [sin, cos] = [Math.sin(pose[2]), Math.cos(pose[2])];
  let top = pose[1];
  for (const [kind, radius, ...points] of body.shapes) {
    const count = kind === 1 ? 2 : points.length;
    for (let i = 0; i < count; i += 2)
      top = Math.max(top, pose[1] + (sin * points[i] + cos * points[i + 1] + radius) / 1000);
  }
  return top;
}

// Steps aside by shares of a name's width and height, the nearest first.
const NAME_MOVES = [
  [0, 0], [0, -1], [0, 1], [-0.5, 0], [0.5, 0], [0, -2], [-1, 0], [1, 0], [0, 2], [-1, -1], [1, -1],
  [-1, 1], [1, 1]
];

// Draws names: of players' own bodies always, of all bodies on request. A name that would cover
// another text goes aside; where there is no place near, it is left out. `taken`: areas of texts.
function drawNames(c, viewport, view, seen, taken) {
  const {rect} = viewport;
  const inside = (box) => box.left >= rect.x && box.right <= rect.x + rect.width &&
      box.top >= rect.y && box.bottom <= rect.y + rect.height;
  const apart = (a, b) =>
      a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
  for (const {body, pose} of seen) {
    const followed = body.id === state.follow;
    if (!state.layers.names && !followed && body.player < 0) continue;
    const width = textWidth(body.name, 11);
    const x = viewport.x(pose[0]) - width / 2;
    const y = viewport.y(topOf(body, pose)) - 17;
    const boxes = NAME_MOVES.map(([dx, dy]) => {
      const [left, top] = [x + dx * width, y + dy * 14];
      return {left, top, right: left + width, bottom: top + 14};
    });
    const box = boxes.find((one) => inside(one) && taken.every((other) => apart(one, other)));
    if (!box) continue;
    taken.push(box);
    drawLabel(c, body.name, box.left + width / 2, box.top + 11, COLOURS.theme.ink);
  }
}

// Returns the area that it takes.
function drawHeatScale(c, rect, what) {
  const width = Math.min(160, rect.width / 3);
  const x = rect.x + 12;
  const y = rect.y + rect.height - 18;
  for (let i = 0; i < width; i += 2) {
    c.fillStyle = heatColour(i / width);
    c.fillRect(x + i, y, 2, 6);
  }
  c.strokeStyle = COLOURS.theme.frame;
  c.lineWidth = 1;
  c.beginPath();
  c.rect(x, y, width, 6);
  c.stroke();
  c.fillStyle = COLOURS.theme.faint;
  c.font = '11px system-ui, sans-serif';
  c.textAlign = 'left';
  c.fillText('1 mm', x, y - 4);
  c.textAlign = 'center';
  c.fillText(what, x + width / 2, y - 4);
  c.textAlign = 'right';
  c.fillText('1 m', x + width, y - 4);
  return {left: x, top: y - 15, right: x + width, bottom: y + 6};
}

// Draws earlier poses of bodies, every 0.15 s of the last 0.75 s, older ones paler.
function drawOnion(c, viewport, view, tick) {
  const step = Math.max(1, Math.round(TRAIL_SECONDS * view.run.hz / 5));
  for (let k = 5; k >= 1; --k) {
    const then = Math.floor(tick) - k * step;
    if (then < 0) continue;
    c.globalAlpha = 0.5 * (1 - k / 6);
    c.lineWidth = 1;
    for (const body of view.worldAt(then).moving) {
      const track = view.tracks.bodies.get(body.id);
      const pose = poseOf(track, then);
      if (!pose || !viewport.sees(pose[0], pose[1], body.reach / 1000)) continue;
      if (!moved(track, tick, k * step, 3, viewport.scale)) continue;
      c.strokeStyle = mixColours(peerColour(Math.floor(track.owner[then] / 3)), COLOURS.theme.ink, 0.4);
      strokeBody(c, viewport, body, pose);
    }
  }
  c.globalAlpha = 1;
}

function drawStrands(c, viewport, view, tick) {
  for (const strand of view.strands) {
    const row = strand.rowOf.get(Math.floor(tick) + view.run.first);
    if (row === undefined) continue;
    const track = view.tracks.bodies.get(strand.part);
    const owner = track ? Math.floor(track.owner[Math.floor(tick)] / 3) : 0;
    c.strokeStyle = mixColours(peerColour(owner), COLOURS.theme.ink, 0.5);
    const at = (k) => strand.columns[k][row] / 1000;
    for (let i = 1; i < strand.points; ++i) {
      const thin = 1 - 0.8 * (i - 1) / strand.points;
      c.lineWidth = Math.max(strand.width * viewport.scale, 1.2) * thin;
      c.beginPath();
      c.moveTo(viewport.x(at(2 * i - 2)), viewport.y(at(2 * i - 1)));
      c.lineTo(viewport.x(at(2 * i)), viewport.y(at(2 * i + 1)));
      c.stroke();
    }
  }
}

// Returns the distance of a body in two views, m; null where a view lacks it.
function apartOf(id, first, second, tick) {
  const from = poseOf(first.tracks.bodies.get(id), tick);
  const to = poseOf(second.tracks.bodies.get(id), tick);
  return from && to ? Math.hypot(from[0] - to[0], from[1] - to[1]) : null;
}

// Draws the bodies of a view. `errorOf`: error for a body's colour, or nothing.
function drawBodies(c, viewport, view, tick, alpha, errorOf) {
  const seen = [];
  for (const body of view.worldAt(tick).moving) {
    const track = view.tracks.bodies.get(body.id);
    const pose = poseOf(track, tick);
    if (!pose || !viewport.sees(pose[0], pose[1], body.reach / 1000)) continue;
    const code = track.owner[Math.floor(tick)];
    const heat = errorOf  ? errorOf(body.id) :
        state.layers.heat ? view.errorOf(body.id, tick) :
                            null;
    const fill = bodyFill(Math.floor(code / 3), code % 3, heat);
    const own = mixColours(peerColour(Math.floor(code / 3)), COLOURS.theme.ink, 0.5);
    const followed = body.id === state.follow;
    drawBody(
        c, viewport, body, pose,
        {fill, edge: followed ? COLOURS.theme.accent : own, width: followed ? 2.2 : 1, alpha});
    seen.push({body, pose});
  }
  return seen;
}

// Draws the second view pale, and the first over it, coloured by distance and joined by arrows.
function drawDifference(c, viewport, first, second, tick) {
  drawBodies(c, viewport, second, tick, 0.35);
  const seen = drawBodies(
      c, viewport, first, tick, 0.85, (id) => apartOf(id, first, second, tick));
  c.strokeStyle = COLOURS.theme.spark;
  c.lineWidth = 1.5;
  for (const [id, track] of first.tracks.bodies) {
    const from = poseOf(track, tick);
    const to = poseOf(second.tracks.bodies.get(id), tick);
    if (!from || !to) continue;
    drawArrow(c, viewport.x(to[0]), viewport.y(to[1]), viewport.x(from[0]), viewport.y(from[1]));
  }
  return seen;
}

// Draws a panel. `titles`: of its upper corners; `heat`: the word for the colours' scale; `second`:
// the view to take the difference from, or nothing.
function drawPanel(c, rect, camera, view, tick, titles, heat, second) {
  const viewport = new Viewport(rect, camera);
  const world = view.worldAt(tick);
  c.save();
  c.beginPath();
  c.rect(rect.x, rect.y, rect.width, rect.height);
  c.clip();
  c.fillStyle = COLOURS.theme.panel;
  c.fillRect(rect.x, rect.y, rect.width, rect.height);
  const step = drawGrid(c, viewport);
  drawWaters(c, viewport, view.run);
  if (state.layers.regions) drawRegions(c, viewport, view, tick);
  drawGround(c, viewport, view.run, world, tick);
  if (state.layers.onion) drawOnion(c, viewport, view, tick);
  const seen = second ? drawDifference(c, viewport, view, second, tick) :
                        drawBodies(c, viewport, view, tick, 1);
  drawStrands(c, viewport, view, tick);
  drawJoints(c, viewport, view.run, view, world, tick);
  if (state.layers.truth) drawTruth(c, viewport, view, tick);
  if (state.layers.dots) drawDots(c, viewport, view, tick);
  if (state.layers.vectors) drawVectors(c, viewport, view, tick);
  if (state.layers.contacts) drawContacts(c, viewport, view, tick);
  const taken = titles.map((title) => titleBox(rect, title));
  if (state.layers.heat || second) taken.push(drawHeatScale(c, rect, heat));
  taken.push(drawScaleBar(c, viewport, step));
  drawNames(c, viewport, view, seen, taken);
  for (const title of titles) drawTitle(c, rect, title);
  c.restore();
  return viewport;
}
