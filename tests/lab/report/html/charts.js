// Charts of the figures' data: values to hover over, curves to switch off, log or linear.

const svgNamespace = "http://www.w3.org/2000/svg";
const hiddenCurves = new Set();

function svg(parent, kind, attributes, text) {
  const element = document.createElementNS(svgNamespace, kind);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  parent.append(element);
  return element;
}

function digits(value) {
  if (value === null || value === undefined) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 1e5) return value.toExponential(2);
  return String(Number(value.toPrecision(3)));
}

function ticText(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(4)));
  const power = Math.floor(Math.log10(size) + 1e-9);
  const raised = [...String(power)].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c])).join("");
  const digit = Number((value / 10 ** power).toPrecision(2));
  return digit === 1 ? `10${raised}` : `${digit}·10${raised}`;
}

// An axis of pixels: null (infinite) lies at its far end, what a logarithm cannot show at its near
// one.
function makeScale(axis, values, log, near, far) {
  if (axis.names.length > 0) {
    const low = -0.6;
    const high = axis.names.length - 0.4;
    const down = near > far; // names are read from above
    return {
      tics: axis.names.map((name, i) => [i, name]),
      at: (v) => (down ? far + ((v - low) / (high - low)) * (near - far) : near + ((v - low) / (high - low)) * (far - near)),
    };
  }
  const finite = values.filter((v) => v !== null && (!log || v > 0));
  const edge = values.includes(null) ? 0.08 : 0;
  const floor = log && values.some((v) => v !== null && v <= 0) ? 0.08 : 0;
  const to = log ? Math.log10 : (v) => v;
  let low = finite.length ? Math.min(...finite.map(to)) : 0;
  let high = finite.length ? Math.max(...finite.map(to)) : 1;
  if (!log) low = Math.min(low, 0);
  const margin = (high - low || Math.abs(high) * 0.2 || 1) * 0.06;
  if (log || low < 0) low -= margin;
  high += margin;
  const from = near + (far - near) * floor;
  const end = far - (far - near) * edge;
  const at = (v) => {
    if (v === null) return far;
    if (log && v <= 0) return near;
    return from + ((to(v) - low) / (high - low)) * (end - from);
  };
  const tics = (log ? logTics(low, high) : linearTics(low, high)).map((v) => [v, ticText(v)]);
  const given = axis.tics.filter((v) => (!log || v > 0) && to(v) >= low && to(v) <= high);
  const list = given.length > 1 ? given.map((v) => [v, ticText(v)]) : tics;
  if (edge) list.push([null, axis.inf]);
  if (floor) list.push([0, axis.zero]);
  return { tics: list, at };
}

function linearTics(low, high) {
  const raw = (high - low) / 5;
  const decade = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((s) => s * decade >= raw) * decade;
  const tics = [];
  for (let k = Math.ceil(low / step); k * step <= high; ++k) tics.push(Number((k * step).toPrecision(12)));
  return tics;
}

function logTics(low, high) {
  for (const steps of [[1], [1, 3], [1, 2, 5], [1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9]]) {
    const every = steps.length === 1 ? Math.max(1, Math.ceil((high - low) / 8)) : 1;
    const tics = [];
    for (let power = Math.floor(low); power <= high; power += every) {
      for (const s of steps) {
        const log = power + Math.log10(s);
        if (log >= low && log <= high) tics.push(Number((s * 10 ** power).toPrecision(3)));
      }
    }
    if (tics.length >= 3 || steps.length > 3) return tics;
  }
  return [];
}

const tip = document.createElement("div");
tip.className = "tip";
tip.hidden = true;

function showTip(event, text) {
  tip.textContent = text;
  tip.hidden = false;
  const width = tip.offsetWidth;
  tip.style.left = `${Math.min(event.clientX + 14, innerWidth - width - 8)}px`;
  tip.style.top = `${event.clientY + 14}px`;
}

function dashArray(dash) {
  return dash === "solid" ? "" : dash.replace(/[()]/g, "");
}

// Labels that would lie on each other are pushed down, one after the other.
function spread(places, least) {
  const order = places.map((y, i) => [y, i]).sort((a, b) => a[0] - b[0]);
  let last = -Infinity;
  for (const one of order) {
    one[0] = Math.max(one[0], last + least);
    last = one[0];
  }
  const out = [];
  for (const [y, i] of order) out[i] = y;
  return out;
}

function drawPanel(holder, figure, panel, scaleWish) {
  const width = figure.width;
  const height = figure.height;
  const box = { left: figure.left, right: width - 20, top: 30, bottom: height - 44 };
  const plot = svg(holder, "svg", { viewBox: `0 0 ${width} ${height}`, class: "plot", width: "100%" });
  const curves = panel.curves.filter((c) => !hiddenCurves.has(c.name));
  const xs = [...curves.flatMap((c) => c.p.map((p) => p[0])), ...panel.uprights.map((u) => u[0])];
  const ys = [...curves.flatMap((c) => c.p.flatMap((p) => p.slice(1))), ...panel.levels.map((l) => l[0])];
  const yLog = scaleWish === "as made" ? panel.y.log : scaleWish === "log";
  const x = makeScale(panel.x, xs, panel.x.log, box.left, box.right);
  const y = makeScale(panel.y, ys, yLog, box.bottom, box.top);
  svg(plot, "text", { x: 8, y: 16, class: "label" }, panel.y.label);
  svg(plot, "text", { x: (box.left + box.right) / 2, y: height - 8, class: "label", "text-anchor": "middle" }, panel.x.label);
  drawTics(plot, box, x, y);
  drawLevels(plot, box, panel, x, y);
  for (const curve of curves) drawCurve(plot, curve, x, y);
  drawNotes(plot, box, panel, x, y);
  hoverOf(plot, panel, curves, x, y, width, height);
}

function drawTics(plot, box, x, y) {
  let last = -Infinity;
  for (const [value, text] of x.tics) {
    const at = x.at(value);
    svg(plot, "line", { x1: at, x2: at, y1: box.top, y2: box.bottom, stroke: "#e4e4e0" });
    if (at - last < 7 * String(text).length + 6) continue;
    last = at;
    svg(plot, "text", { x: at, y: box.bottom + 16, "text-anchor": "middle" }, text);
  }
  for (const [value, text] of y.tics) {
    const at = y.at(value);
    svg(plot, "line", { x1: box.left, x2: box.right, y1: at, y2: at, stroke: "#e4e4e0" });
    svg(plot, "text", { x: box.left - 6, y: at + 4, "text-anchor": "end" }, text);
  }
  svg(plot, "path", { d: `M${box.left} ${box.top}V${box.bottom}H${box.right}`, fill: "none", stroke: "#555" });
}

function drawLevels(plot, box, panel, x, y) {
  const places = spread(panel.levels.map((l) => y.at(l[0]) - 4), 13);
  panel.levels.forEach(([value, name], i) => {
    const at = y.at(value);
    svg(plot, "line", { x1: box.left, x2: box.right, y1: at, y2: at, stroke: "#888", "stroke-dasharray": "4 4" });
    svg(plot, "text", { x: box.right - 4, y: Math.min(places[i], box.bottom - 2), "text-anchor": "end" }, name);
  });
  for (const [value, name] of panel.uprights) {
    const at = x.at(value);
    svg(plot, "line", { x1: at, x2: at, y1: box.top, y2: box.bottom, stroke: "#888", "stroke-dasharray": "4 4" });
    svg(plot, "text", { x: at + 4, y: box.top + 11 }, name);
  }
}

// Names of points, where there is room beside them; the others are said when one points at them.
function drawNotes(plot, box, panel, x, y) {
  const taken = panel.curves.flatMap((c) => (c.point === 0 ? [] : c.p.map((p) => [x.at(p[0]) - 3, y.at(p[1]) - 3, 6, 6])));
  const free = (r) => r[0] >= box.left && r[0] + r[2] <= box.right + 18 && r[1] >= box.top && r[1] + r[3] <= box.bottom
    && taken.every((t) => r[0] > t[0] + t[2] || t[0] > r[0] + r[2] || r[1] > t[1] + t[3] || t[1] > r[1] + r[3]);
  for (const [nx, ny, text] of panel.notes) {
    const [px, py, width] = [x.at(nx), y.at(ny), 6.6 * text.length];
    const corners = [[6, 4], [6, -15], [-6 - width, -15], [-6 - width, 4], [7, -6], [-7 - width, -6]];
    const room = corners.map(([dx, dy]) => [px + dx, py + dy, width, 11]).find(free);
    if (room === undefined) continue;
    taken.push(room);
    svg(plot, "text", { x: room[0], y: room[1] + 9 }, text);
  }
}

function drawCurve(plot, curve, x, y) {
  const group = svg(plot, "g", { stroke: curve.colour, fill: "none", "data-curve": curve.name });
  for (const [px, , low, high] of curve.p) {
    if (low === undefined) continue;
    svg(group, "line", { x1: x.at(px), x2: x.at(px), y1: y.at(low), y2: y.at(high), "stroke-width": 0.8 });
  }
  const path = curve.p.map(([px, py], i) => `${i ? "L" : "M"}${x.at(px).toFixed(1)} ${y.at(py).toFixed(1)}`).join("");
  if (curve.width > 0 && curve.p.length > 1) {
    svg(group, "path", { d: path, "stroke-width": curve.width, "stroke-dasharray": dashArray(curve.dash) });
  }
  if (curve.point === 0) return;
  for (const [px, py] of curve.p) {
    svg(group, "circle", { cx: x.at(px), cy: y.at(py), r: 3.2, fill: curve.colour, stroke: "#fff" });
  }
}

// The point nearest to the mouse, in words.
function hoverOf(plot, panel, curves, x, y, width, height) {
  const ring = svg(plot, "circle", { r: 6, fill: "none", stroke: "#000", visibility: "hidden" });
  plot.addEventListener("pointermove", (event) => {
    const frame = plot.getBoundingClientRect();
    const mx = ((event.clientX - frame.left) / frame.width) * width;
    const my = ((event.clientY - frame.top) / frame.height) * height;
    let best = null;
    for (const curve of curves) {
      if (curve.name === "" || curve.name === "front") continue;
      for (const p of curve.p) {
        const apart = Math.hypot(x.at(p[0]) - mx, y.at(p[1]) - my);
        if (apart < 40 && (best === null || apart < best.apart)) best = { apart, curve, p };
      }
    }
    ring.setAttribute("visibility", best ? "visible" : "hidden");
    tip.hidden = best === null;
    if (best === null) return;
    ring.setAttribute("cx", x.at(best.p[0]));
    ring.setAttribute("cy", y.at(best.p[1]));
    showTip(event, tipText(panel, best.curve, best.p));
  });
  plot.addEventListener("pointerleave", () => {
    ring.setAttribute("visibility", "hidden");
    tip.hidden = true;
  });
}

function valueText(axis, value) {
  if (axis.names.length > 0) return axis.names[value] ?? "";
  return `${axis.label || "value"}: ${value === null ? axis.inf : digits(value)}`;
}

function tipText(panel, curve, p) {
  const range = p.length > 2 ? ` (quartiles ${digits(p[2])} to ${digits(p[3])})` : "";
  const note = panel.notes.find((n) => n[0] === p[0] && n[1] === p[1]);
  return `${note ? `${note[2]}: ` : ""}${curve.name}\n${valueText(panel.x, p[0])}\n${valueText(panel.y, p[1])}${range}`;
}

// Replaces a figure's picture; again whenever curves or the scale were changed.
function drawFigure(holder, scaleWish) {
  const figure = (holder.data ??= JSON.parse(holder.querySelector("script").textContent));
  let panels = holder.querySelector(".panels");
  if (panels === null) {
    panels = document.createElement("div");
    panels.className = "panels";
    holder.querySelector("a.picture").replaceWith(panels);
  }
  panels.replaceChildren();
  panels.style.gridTemplateColumns = `repeat(${figure.columns}, minmax(0, 1fr))`;
  const title = document.createElement("h4");
  title.textContent = holder.dataset.title;
  panels.append(title, legendOf(figure));
  for (const panel of figure.panels) drawPanel(panels, figure, panel, scaleWish);
}

function legendOf(figure) {
  const legend = document.createElement("div");
  legend.className = "legend";
  const known = new Set([""]);
  for (const curve of figure.panels.flatMap((p) => p.curves)) {
    if (known.has(curve.name)) continue;
    known.add(curve.name);
    const button = document.createElement("button");
    button.setAttribute("aria-pressed", String(!hiddenCurves.has(curve.name)));
    button.title = "show or hide in all figures";
    const key = svg(button, "svg", { width: 26, height: 10 });
    if (curve.width === 0) svg(key, "circle", { cx: 13, cy: 5, r: 3.5, fill: curve.colour });
    else svg(key, "line", { x1: 0, x2: 26, y1: 5, y2: 5, stroke: curve.colour, "stroke-width": Math.max(curve.width, 1), "stroke-dasharray": dashArray(curve.dash) });
    button.append(curve.name);
    button.addEventListener("click", () => toggleCurve(curve.name));
    legend.append(button);
  }
  return legend;
}
