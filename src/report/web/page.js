"use strict";

// A picture that the page shows several times is stored once; the other <img> elements copy its source.
for (const image of document.querySelectorAll("img[data-same-as]")) {
  image.src = document.getElementById(image.dataset.sameAs).src;
}

// Zoom and position, the same for all pictures: x and y are the parts of a picture that are to the left of and above
// the visible part. The style sheet reads them from the root element.
const view = { zoom: 1, x: 0, y: 0 };

function showView() {
  const most = 1 - 1 / view.zoom;
  view.x = Math.min(Math.max(view.x, 0), most);
  view.y = Math.min(Math.max(view.y, 0), most);
  const root = document.documentElement;
  for (const name of ["zoom", "x", "y"]) root.style.setProperty(`--${name}`, view[name]);
  root.classList.toggle("zoomed", view.zoom > 1);
  for (const button of document.querySelectorAll("[data-zoom]")) {
    button.setAttribute("aria-pressed", String(Number(button.dataset.zoom) === view.zoom));
  }
}

// Zooms about the point (x, y), given as fractions of the visible part: it stays where it is.
function zoomTo(zoom, x = 0.5, y = 0.5) {
  view.x += x / view.zoom - x / zoom;
  view.y += y / view.zoom - y / zoom;
  view.zoom = zoom;
  showView();
}

function moveView(x, y) {
  view.x += x / view.zoom;
  view.y += y / view.zoom;
  showView();
}

for (const button of document.querySelectorAll("[data-zoom]")) {
  button.addEventListener("click", () => zoomTo(Number(button.dataset.zoom)));
}

// Dividers

const together = document.getElementById("together");

function showSplit(range) {
  range.closest(".slider").style.setProperty("--split", `${range.value}%`);
}

function moveDivider(range) {
  showSplit(range);
  if (!together.checked) return;
  for (const other of document.querySelectorAll(".slider input")) {
    other.value = range.value;
    showSplit(other);
  }
}

for (const range of document.querySelectorAll(".slider input")) {
  showSplit(range);  // a browser may remember where it was
  range.addEventListener("input", () => moveDivider(range));
}

// A drag moves the picture when zoomed in, else the divider.
function dragTo(pane, event, last) {
  const box = pane.getBoundingClientRect();
  if (view.zoom > 1) {
    moveView((last.x - event.clientX) / box.width, (last.y - event.clientY) / box.height);
    return;
  }
  const range = pane.parentElement.querySelector("input[type=range]");
  if (!range) return;
  range.value = ((event.clientX - box.left) / box.width) * 100;
  moveDivider(range);
}

function onPointerDown(event) {
  if (event.button !== 0) return;
  const pane = event.currentTarget;
  let last = { x: event.clientX, y: event.clientY };
  if (view.zoom === 1) dragTo(pane, event, last);
  pane.setPointerCapture(event.pointerId);
  const move = (moved) => {
    dragTo(pane, moved, last);
    last = { x: moved.clientX, y: moved.clientY };
  };
  const stop = () => {
    pane.removeEventListener("pointermove", move);
    pane.removeEventListener("pointerup", stop);
    pane.removeEventListener("pointercancel", stop);
  };
  pane.addEventListener("pointermove", move);
  pane.addEventListener("pointerup", stop);
  pane.addEventListener("pointercancel", stop);
}

const steps = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
const zooms = [1, 2, 4];

function onKey(event) {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const at = zooms.indexOf(view.zoom);
  if (event.key in steps && view.zoom > 1) {
    moveView(...steps[event.key]);
  } else if (event.key === "+" || event.key === "=") {
    zoomTo(zooms[Math.min(at + 1, zooms.length - 1)]);
  } else if (event.key === "-") {
    zoomTo(zooms[Math.max(at - 1, 0)]);
  } else {
    return;
  }
  event.preventDefault();
}

function onDoubleClick(event) {
  const box = event.currentTarget.getBoundingClientRect();
  const next = zooms[(zooms.indexOf(view.zoom) + 1) % zooms.length];
  zoomTo(next, (event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height);
}

for (const pane of document.querySelectorAll(".view")) {
  pane.addEventListener("pointerdown", onPointerDown);
  pane.addEventListener("keydown", onKey);
  pane.addEventListener("dblclick", onDoubleClick);
}

// Error maps

// The error that a code of 8 bits stands for: report::error_code().
const errorOf = (code) => Math.sign(code - 128) * ((code - 128) / 127) ** 2;
const channels = (colour) => [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));

// The colour of each of the 256 codes.
function coloursFor(map, range) {
  const ramp = map.dataset.colours.split(" ").map(channels);
  const colours = [channels(map.dataset.unmeasured)];
  for (let code = 1; code < 256; ++code) {
    const share = Math.min(Math.max(errorOf(code) / range, -1), 1);
    const place = ((share + 1) / 2) * (ramp.length - 1);
    const index = Math.min(Math.floor(place), ramp.length - 2);
    colours.push(ramp[index].map((low, i) => Math.round(low + (ramp[index + 1][i] - low) * (place - index))));
  }
  return colours;
}

async function drawnErrors(map, range) {
  const codes = new Image();
  codes.src = map.dataset.codes;
  await codes.decode();
  const canvas = document.createElement("canvas");
  canvas.width = codes.naturalWidth;
  canvas.height = codes.naturalHeight;
  const context = canvas.getContext("2d");
  context.drawImage(codes, 0, 0);
  const pixels = context.getImageData(0, 0, canvas.width, canvas.height);
  const colours = coloursFor(map, range);
  for (let at = 0; at < pixels.data.length; at += 4) pixels.data.set(colours[pixels.data[at]], at);
  context.putImageData(pixels, 0, 0);
  return canvas.toDataURL();
}

// An empty range: as the page was written.
async function showErrors(map, range) {
  const image = map.querySelector(".pane img");
  image.dataset.drawn ??= image.src;
  const drawn = range === "" ? image.dataset.drawn : await drawnErrors(map, Number(range));
  if (range !== errorRange.value) return;  // another one was chosen meanwhile
  image.src = drawn;
  for (const label of map.querySelectorAll("[data-label]")) {
    label.textContent = label.dataset.label.replace("{}", range || map.dataset.range);
  }
}

const errorRange = document.getElementById("error-range");

function showAllErrors() {
  for (const map of document.querySelectorAll(".error-map")) showErrors(map, errorRange.value);
}

if (errorRange) {
  if (errorRange.value !== "") showAllErrors();  // a browser may remember the choice
  errorRange.addEventListener("change", showAllErrors);
}

// Tables

// A cell's number, or else its text; null where there is no number to sort by.
function keyOf(row, column) {
  const cell = row.cells[column];
  if (cell.dataset.value === undefined) return cell.classList.contains("number") ? null : cell.textContent;
  const value = Number(cell.dataset.value);
  return Number.isNaN(value) ? null : value;
}

function compareKeys(a, b) {
  if (typeof a === "number" && typeof b === "number") return a < b ? -1 : Number(a > b);
  return String(a).localeCompare(String(b), "en", { numeric: true });
}

// Rows without a value come last either way; equal rows stay in their order.
function sortBy(table, column, ascending) {
  const body = table.tBodies[0];
  const keyed = Array.from(body.rows, (row) => ({ row, key: keyOf(row, column) }));
  keyed.sort((a, b) => {
    if (a.key === null || b.key === null) return Number(a.key === null) - Number(b.key === null);
    return ascending ? compareKeys(a.key, b.key) : compareKeys(b.key, a.key);
  });
  body.append(...keyed.map(({ row }) => row));
}

for (const table of document.querySelectorAll("table.sortable")) {
  const heads = Array.from(table.tHead.rows[0].cells);
  for (const [column, head] of heads.entries()) {
    head.querySelector("button").addEventListener("click", () => {
      const ascending = head.getAttribute("aria-sort") !== "ascending";
      for (const other of heads) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", ascending ? "ascending" : "descending");
      sortBy(table, column, ascending);
    });
  }
}

// Copy buttons

// Where a browser gives no clipboard, the text is selected instead, so that Ctrl-C copies it.
function select(element) {
  const range = document.createRange();
  range.selectNodeContents(element);
  getSelection().removeAllRanges();
  getSelection().addRange(range);
}

for (const button of document.querySelectorAll("button.copy")) {
  button.addEventListener("click", async () => {
    const code = button.parentElement.querySelector("code");
    let done = "Copied";
    try {
      await navigator.clipboard.writeText(code.textContent);
    } catch {
      select(code);
      done = "Selected";
    }
    button.textContent = done;
    setTimeout(() => { button.textContent = "Copy"; }, 1500);
  });
}
