// Bodies, ground, water and regions on a panel. `c` is a canvas's context, or a recorder of the
// same calls as SVG (save.js).

function tracePolygon(c, viewport, points, pose, closed) {
  const cos = Math.cos(pose[2]);
  const sin = Math.sin(pose[2]);
  for (let i = 0; i < points.length; i += 2) {
    const x = points[i] / 1000;
    const y = points[i + 1] / 1000;
    const px = viewport.x(pose[0] + cos * x - sin * y);
    const py = viewport.y(pose[1] + sin * x + cos * y);
    if (i === 0) {
      c.moveTo(px, py);
    } else {
      c.lineTo(px, py);
    }
  }
  if (closed) c.closePath();
}

function traceOutline(c, viewport, [kind, radius, ...points], pose) {
  if (kind !== 1) return tracePolygon(c, viewport, points, pose, kind === 0);
  const cos = Math.cos(pose[2]);
  const sin = Math.sin(pose[2]);
  const x = viewport.x(pose[0] + (cos * points[0] - sin * points[1]) / 1000);
  const y = viewport.y(pose[1] + (sin * points[0] + cos * points[1]) / 1000);
  const r = radius / 1000 * viewport.scale;
  c.moveTo(x + r, y);
  c.arc(x, y, r, 0, 2 * Math.PI);
}

function traceBody(c, viewport, body, pose) {
  c.beginPath();
  for (const shape of body.shapes) traceOutline(c, viewport, shape, pose);
}

// Adds a radius to each disc, so that its rotation is visible.
function traceSpokes(c, viewport, body, pose) {
  c.beginPath();
  for (const [kind, radius, ...points] of body.shapes) {
    if (kind !== 1 || radius / 1000 * viewport.scale < 4) continue;
    const rim =
        [points[0] + 0.8 * (points[2] - points[0]), points[1] + 0.8 * (points[3] - points[1])];
    tracePolygon(c, viewport, [points[0], points[1], ...rim], pose, false);
  }
}

function traceRim(c, viewport, body, pose) {
  c.beginPath();
  for (const edge of body.rim) tracePolygon(c, viewport, edge, pose, false);
}

function strokeBody(c, viewport, body, pose) {
  if (body.rim.length > 0) {
    traceRim(c, viewport, body, pose);
  } else {
    traceBody(c, viewport, body, pose);
  }
  c.stroke();
}

// Returns a body's fill colour by authority: full in the authority's view, lighter where the body
// is followed, palest where it is only displayed.
function bodyFill(owner, role, heat) {
  if (heat !== null) return heatColour(heatOf(heat));
  const share = [0.75, 0.45, 0][role];  // remote, secondary, authority
  return mixColours(peerColour(owner), COLOURS.theme.panel, share);
}

function drawBody(c, viewport, body, pose, look) {
  c.globalAlpha = look.alpha === undefined ? 1 : look.alpha;
  c.fillStyle = look.fill;
  traceBody(c, viewport, body, pose);
  if (body.shapes.some((shape) => shape[0] < 2)) c.fill();
  c.strokeStyle = look.edge;
  c.lineWidth = look.width || 1;
  strokeBody(c, viewport, body, pose);
  traceSpokes(c, viewport, body, pose);
  c.stroke();
  c.globalAlpha = 1;
}

function drawGrid(c, viewport) {
  const least = 60 / viewport.scale;
  const decade = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((k) => k * decade).find((s) => s >= least * 0.999);
  const {rect} = viewport;
  c.strokeStyle = COLOURS.theme.grid;
  c.lineWidth = 1;
  c.beginPath();
  for (let x = Math.ceil(viewport.worldX(rect.x) / step) * step;
       viewport.x(x) < rect.x + rect.width; x += step) {
    c.moveTo(Math.round(viewport.x(x)) + 0.5, rect.y);
    c.lineTo(Math.round(viewport.x(x)) + 0.5, rect.y + rect.height);
  }
  for (let y = Math.ceil(viewport.worldY(rect.y + rect.height) / step) * step;
       viewport.y(y) > rect.y; y += step) {
    c.moveTo(rect.x, Math.round(viewport.y(y)) + 0.5);
    c.lineTo(rect.x + rect.width, Math.round(viewport.y(y)) + 0.5);
  }
  c.stroke();
  return step;
}

// Draws a bar with the length of a step of the grid.
// Returns the area that it takes.
function drawScaleBar(c, viewport, step) {
  const {rect} = viewport;
  const right = rect.x + rect.width - 12;
  const left = right - step * viewport.scale;
  const y = rect.y + rect.height - 12;
  const text = step >= 1 ? `${step} m` : `${Math.round(step * 100)} cm`;
  const half = 3.4 * text.length + 3;
  c.globalAlpha = 0.8;
  c.fillStyle = COLOURS.theme.panel;
  c.fillRect((left + right) / 2 - half, y - 17, 2 * half, 14);
  c.globalAlpha = 1;
  c.strokeStyle = c.fillStyle = COLOURS.theme.faint;
  c.lineWidth = 1;
  c.beginPath();
  c.moveTo(left, y - 3);
  c.lineTo(left, y);
  c.lineTo(right, y);
  c.lineTo(right, y - 3);
  c.stroke();
  c.font = '11px system-ui, sans-serif';
  c.textAlign = 'center';
  c.fillText(text, (left + right) / 2, y - 6);
  const middle = (left + right) / 2;
  return {
    left: Math.min(left, middle - half),
    top: y - 17,
    right: Math.max(right, middle + half),
    bottom: y
  };
}

function drawWaters(c, viewport, run) {
  c.fillStyle = COLOURS.theme.water;
  c.strokeStyle = COLOURS.theme['water-line'];
  for (const [x0, y0, x1, y1] of run.waters) {
    const left = viewport.x(x0 / 1000);
    const top = viewport.y(y1 / 1000);
    c.fillRect(left, top, viewport.x(x1 / 1000) - left, viewport.y(y0 / 1000) - top);
    c.beginPath();
    c.moveTo(left, top);
    c.lineTo(viewport.x(x1 / 1000), top);
    c.stroke();
  }
}

const BRICK_UNIT = 0.05;  // m

// `pad`: px more on each side.
function traceBlocks(c, viewport, blocks, pad = 0) {
  const {rect, scale} = viewport;
  c.beginPath();
  for (const [x, y, width, height] of blocks) {
    const left = viewport.x(x * BRICK_UNIT);
    const top = viewport.y((y + height) * BRICK_UNIT);
    const w = width * BRICK_UNIT * scale;
    const h = height * BRICK_UNIT * scale;
    if (left + w < rect.x || top + h < rect.y) continue;
    if (left > rect.x + rect.width || top > rect.y + rect.height) continue;
    c.rect(left - pad, top - pad, w + 2 * pad, h + 2 * pad);
  }
}

// Draws many bricks once for a camera, and keeps the picture for each run.
const brickPictures = new Map();

function drawBricks(c, viewport, run) {
  if (run.bricks.length === 0) return;
  if (!(c instanceof CanvasRenderingContext2D)) {
    traceBlocks(c, viewport, run.bricks);
    c.fill();
    return;
  }
  const {rect, camera} = viewport;
  const ratio = window.devicePixelRatio || 1;
  const key =
      [camera.x, camera.y, camera.height, rect.width, rect.height, ratio, c.fillStyle].join();
  let picture = brickPictures.get(run);
  if (!picture || picture.key !== key) {
    const canvas = document.createElement('canvas');
    canvas.width = Math.ceil(rect.width * ratio);
    canvas.height = Math.ceil(rect.height * ratio);
    const own = canvas.getContext('2d');
    own.scale(ratio, ratio);
    own.fillStyle = c.fillStyle;
    const {width, height} = rect;
    traceBlocks(own, new Viewport({x: 0, y: 0, width, height}, camera), run.bricks);
    own.fill();
    picture = {key, canvas};
    brickPictures.set(run, picture);
  }
  c.drawImage(
      picture.canvas, rect.x, rect.y, picture.canvas.width / ratio, picture.canvas.height / ratio);
}

function drawGround(c, viewport, run, world, tick) {
  c.fillStyle = COLOURS.theme.ground;
  c.strokeStyle = COLOURS.theme['ground-edge'];
  c.lineWidth = 1;
  drawBricks(c, viewport, run);
  if (world.holes.length > 0) {
    c.fillStyle = COLOURS.theme.panel;
    traceBlocks(c, viewport, world.holes, 0.7);  // also erases the antialiased edges
    c.fill();
    c.fillStyle = COLOURS.theme.ground;
  }
  for (const entry of world.anchored) {
    const pose = anchoredPose(run, entry, tick);
    if (!viewport.sees(pose[0], pose[1], entry.body.reach / 1000)) continue;
    for (const [kind, , ...points] of entry.body.shapes)
      if (kind === 2) shadeBelow(c, viewport, points, pose);
    drawBody(
        c, viewport, entry.body, pose,
        {fill: COLOURS.theme.ground, edge: COLOURS.theme['ground-edge'], width: 1.5});
  }
}

// Fills the area below ground that is a line across the panel.
function shadeBelow(c, viewport, points, pose) {
  for (let i = 4; i < points.length; i += 2)
    if ((points[i] - points[i - 2]) * (points[2] - points[0]) <= 0) return;
  const depth = Math.min(2 * viewport.scale, 36);
  c.fillStyle = COLOURS.theme.ground;
  c.beginPath();
  tracePolygon(c, viewport, points, pose, false);
  for (let i = points.length - 2; i >= 0; i -= 2)
    c.lineTo(
        viewport.x(pose[0] + points[i] / 1000), viewport.y(pose[1] + points[i + 1] / 1000) + depth);
  c.closePath();
  c.fill();
}

function drawRegions(c, viewport, view, tick) {
  for (const region of [...view.run.regions, ...heldRegions(view, tick)]) {
    const colour = peerColour(region.peer);
    c.beginPath();
    tracePolygon(c, viewport, region.corners.flat(), [0, 0, 0], true);
    c.strokeStyle = colour;
    c.lineWidth = 1.2;
    c.setLineDash(region.zone ? [6, 4] : []);
    c.stroke();
    c.setLineDash([]);
    if (!region.zone) {
      c.globalAlpha = 0.07;
      c.fillStyle = colour;
      c.fill();
      c.globalAlpha = 1;
    }
  }
}

function drawJoints(c, viewport, run, view, world, tick) {
  const at = (id, x, y) => {
    const entry = world.anchoredById.get(id);
    const pose = id < 0 ? [0, 0, 0] :
        entry           ? anchoredPose(run, entry, tick) :
                          poseOf(view.tracks.bodies.get(id), tick);
    if (!pose) return null;
    const cos = Math.cos(pose[2]);
    const sin = Math.sin(pose[2]);
    return [
      viewport.x(pose[0] + (cos * x - sin * y) / 1000),
      viewport.y(pose[1] + (sin * x + cos * y) / 1000),
    ];
  };
  c.strokeStyle = c.fillStyle = COLOURS.theme.faint;
  c.lineWidth = 1.2;
  for (const [a, ax, ay, b, bx, by, rod] of world.joints) {
    const from = at(a, ax, ay);
    if (!from || (!rod && viewport.scale < 14)) continue;
    c.beginPath();
    if (rod) {
      const to = at(b, bx, by);
      if (!to) continue;
      c.moveTo(...from);
      c.lineTo(...to);
      c.stroke();
    } else {
      c.arc(from[0], from[1], 1.5, 0, 2 * Math.PI);
      c.fill();
    }
  }
}
