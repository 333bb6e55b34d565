// "Your latency and loss: use this, at this cost and error", from the medians of the sweeps.

const [kScene, kLatency, kLoss, kMethod, kError, kCpu, kTraffic, kResponse] = [0, 1, 2, 3, 4, 5, 6, 7];

function unique(values) {
  return [...new Set(values)].sort((a, b) => (a < b ? -1 : 1));
}

// The measured network of a scene that is nearest to what was asked for: ten milliseconds are as
// far as one percent; of two as near the later in the table, which is the worse one.
function nearest(rows, latency, loss) {
  let best = null;
  for (const row of rows) {
    const far = Math.abs(row[kLatency] - latency) / 10 + Math.abs(row[kLoss] - loss);
    if (best === null || far <= best.far) best = { far, latency: row[kLatency], loss: row[kLoss] };
  }
  return best;
}

// Each method's figures over the scenes: medians, and the geometric mean of its errors as multiples
// of the least of each scene. A scene in which less than half as many methods ran as in another
// says nothing of the others, and is left out.
function rank(rows, scenes, latency, loss) {
  const used = [];
  const methods = new Map();
  const tried = [];
  for (const scene of scenes) {
    const of = rows.filter((r) => r[kScene] === scene);
    const place = nearest(of, latency, loss);
    if (place === null) continue;
    const here = of.filter((r) => r[kLatency] === place.latency && r[kLoss] === place.loss);
    tried.push({ scene, place, here });
  }
  const most = Math.max(0, ...tried.map((t) => t.here.length));
  for (const { scene, place, here } of tried) {
    if (2 * here.length < most) continue;
    used.push({ scene, latency: place.latency, loss: place.loss });
    const least = Math.max(1e-6, Math.min(...here.map((r) => r[kError])));
    for (const row of here) {
      if (!methods.has(row[kMethod])) methods.set(row[kMethod], []);
      methods.get(row[kMethod]).push({ row, ratio: Math.max(row[kError], 1e-6) / least });
    }
  }
  const list = [];
  for (const [method, runs] of methods) {
    if (runs.length < used.length) continue;
    const middle = (key) => median(runs.map((r) => r.row[key]).filter((v) => v !== null));
    list.push({
      method,
      ratio: Math.exp(runs.reduce((sum, r) => sum + Math.log(r.ratio), 0) / runs.length),
      error: middle(kError),
      cpu: middle(kCpu),
      traffic: middle(kTraffic),
      response: middle(kResponse),
    });
  }
  list.sort((a, b) => a.ratio - b.ratio);
  return { list, used };
}

// As the report's tables have it: of an even number the lower one.
function median(values) {
  if (values.length === 0) return null;
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.ceil(sorted.length / 2) - 1];
}

function flagsOf(method) {
  if (method === "strict") return "--mode strict";
  if (method.startsWith("central/")) return `--mode central --predict ${method.slice(8)}`;
  return `--mode buffer --reconcile ${method}`;
}

function cell(row, text) {
  const td = document.createElement(row.parentElement?.tagName === "THEAD" ? "th" : "td");
  td.textContent = text;
  row.append(td);
}

function answer(rows, form, out) {
  const latency = Number(form.latency.value);
  const loss = Number(form.loss.value);
  const scenes = form.scene.value === "" ? unique(rows.map((r) => r[kScene])) : [form.scene.value];
  const { list, used } = rank(rows, scenes, latency, loss);
  out.replaceChildren();
  if (list.length === 0) {
    out.textContent = "No method ran in all of these scenes.";
    return;
  }
  const best = list[0];
  const verdict = document.createElement("p");
  verdict.className = "verdict";
  verdict.textContent = `Use ${best.method}: error ${digits(best.error)} m, ${digits(best.cpu)} ms of CPU per second, ${digits(best.traffic)} kB/s.`;
  const flags = document.createElement("pre");
  flags.textContent = `seam-server scene.toml ${flagsOf(best.method)}`;
  const where = document.createElement("p");
  where.className = "note";
  const places = unique(used.map((u) => `${u.latency} ms, ${u.loss} % loss`));
  where.textContent = `Measured at the nearest network that was tried (each way): ${places.join("; ")}; in ${used.map((u) => u.scene).join("; ")}.`;
  out.append(verdict, flags, where, rankTable(list, used.length));
  const cheap = list.filter((m) => m.ratio <= 1.25 * best.ratio && m.cpu !== null).sort((a, b) => a.cpu - b.cpu)[0];
  if (cheap && cheap !== best) {
    const line = document.createElement("p");
    line.textContent = `Within a quarter of that error the cheapest is ${cheap.method}: ${digits(cheap.cpu)} ms of CPU per second.`;
    where.before(line);
  }
}

function rankTable(list, scenes) {
  const table = document.createElement("table");
  const head = document.createElement("tr");
  table.createTHead().append(head);
  for (const name of ["method", "times the least error", "error (m)", "CPU (ms per s)", "traffic of a client (kB/s)", "own response (ms)"]) cell(head, name);
  const body = table.createTBody();
  for (const m of list) {
    const row = body.insertRow();
    for (const text of [m.method, digits(m.ratio), digits(m.error), digits(m.cpu), digits(m.traffic), digits(m.response)]) cell(row, text);
  }
  const note = document.createElement("caption");
  note.className = "note";
  note.style.captionSide = "bottom";
  note.style.textAlign = "left";
  note.textContent = scenes > 1 ? "Medians over seeds and scenes; the second column is the geometric mean over scenes." : "Medians over seeds.";
  table.append(note);
  return table;
}

function fillSelect(select, values, text, chosen) {
  for (const value of values) {
    const option = document.createElement("option");
    option.value = value;
    option.textContent = text(value);
    option.selected = value === chosen;
    select.append(option);
  }
}

function startAnswers() {
  const holder = document.querySelector(".answers");
  if (holder === null) return;
  const rows = JSON.parse(holder.querySelector("script").textContent);
  const form = holder.querySelector("form");
  const out = holder.querySelector("output");
  fillSelect(form.scene, unique(rows.map((r) => r[kScene])), (v) => v, "");
  holder.hidden = false;
  form.addEventListener("input", () => answer(rows, form, out));
  form.addEventListener("submit", (event) => event.preventDefault());
  answer(rows, form, out);
}
