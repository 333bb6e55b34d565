// One chapter at a time, the filter by scene, and which curves are drawn.

let scaleWish = "as made";

function chapters() {
  return [...document.querySelectorAll(".chapter")];
}

function shownChapter() {
  return document.querySelector(".chapter.shown");
}

function drawShown() {
  const shown = shownChapter();
  if (shown === null) return;
  for (const holder of shown.querySelectorAll("figure[data-title]")) {
    if (!holder.hidden) drawFigure(holder, scaleWish);
  }
}

function showChapter() {
  const all = chapters();
  const wanted = decodeURIComponent(location.hash.slice(1));
  const chosen = all.find((c) => c.id === wanted) ?? all[0];
  for (const chapter of all) chapter.classList.toggle("shown", chapter === chosen);
  for (const link of document.querySelectorAll("nav a")) {
    if (link.hash === `#${chosen.id}`) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
  drawShown();
  scrollTo(0, 0);
}

function toggleCurve(name) {
  if (!hiddenCurves.delete(name)) hiddenCurves.add(name);
  for (const box of document.querySelectorAll(".methods input")) {
    if (box.value === name) box.checked = !hiddenCurves.has(name);
  }
  drawShown();
}

function filterScenes(scene) {
  for (const item of document.querySelectorAll("[data-scene]")) {
    item.hidden = scene !== "" && item.dataset.scene !== scene;
  }
  for (const chapter of chapters()) {
    const items = [...chapter.querySelectorAll("[data-scene]")];
    const none = items.length > 0 && items.every((item) => item.hidden);
    const link = document.querySelector(`nav a[href="#${CSS.escape(chapter.id)}"]`);
    if (link !== null) link.style.opacity = none ? 0.4 : "";
  }
  drawShown();
}

function fillControls() {
  const scenes = unique([...document.querySelectorAll("[data-scene]")].map((i) => i.dataset.scene));
  const select = document.querySelector("#scene-filter");
  fillSelect(select, scenes, (v) => v, "");
  select.addEventListener("input", () => filterScenes(select.value));
  const scale = document.querySelector("#scale");
  scale.addEventListener("input", () => {
    scaleWish = scale.value;
    drawShown();
  });
  const methods = JSON.parse(document.querySelector("#methods-known").textContent);
  const list = document.querySelector(".methods");
  for (const [name, colour] of methods) {
    const label = document.createElement("label");
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = true;
    box.value = name;
    box.addEventListener("input", () => toggleCurve(name));
    const key = document.createElement("i");
    key.style.borderColor = colour;
    label.append(box, key, name);
    list.append(label);
  }
}

document.body.classList.add("live");
document.body.append(tip);
fillControls();
startAnswers();
addEventListener("hashchange", showChapter);
showChapter();
