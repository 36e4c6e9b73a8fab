// The page: shows each new state, and sends what the user chooses.
import { follow, send } from "./server.js";
import { showTests } from "./legend.js";
import { linked, setSources, withLinks } from "./links.js";
import * as overlay from "./overlay.js";
import * as pixel from "./pixel.js";
import * as stage from "./stage.js";
import * as tree from "./tree.js";

const get = (id) => document.getElementById(id);

/** Creates an element with attributes and children. Strings become text, never markup. */
export function element(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** Converts a text to nodes. Code in backticks and file names with line numbers are marked up. */
export const prose = linked;

/** Formats a number with at most this many digits. */
export function number(x, digits = 5) {
  if (x === null || !Number.isFinite(x)) return String(x ?? "∞");
  return String(Number(x.toPrecision(digits)));
}

/** The maximum number of samples in the history of a pixel. */
const LISTED_SAMPLES = 64;

let last = null;

function show(state) {
  setSources(state.sources);
  showTexts(state);
  showControls(state);
  showErrors(state);
  showNotes(state);
  get("stage").classList.toggle("stale", state.is_stale || state.build === "failed");
  const waiting = waitingFor(state);
  get("waiting").hidden = waiting === "";
  setText("waiting", waiting);
  stage.showPicture(state);
  overlay.setCamera(state);
  pixel.showExplanation(state);
  tree.showTree(state);
  document.body.dataset.version = state.version;
  document.body.dataset.complete = state.is_picture_complete;
  last = state;
}

/** Returns what the picture is waiting for, or an empty string. */
function waitingFor(state) {
  if (state.loading) return `Loading ${state.loading} …`;
  if (state.build === "compiling") return "Compiling …";
  if (state.build === "failed") return state.picture > 0 ? "" : "No picture yet: see the errors.";
  if (state.has_stopped && state.is_stale) return "This picture was drawn by the previous version of your code, because the new one has stopped.";
  if (state.is_opening) return "Building the tree …";
  if (state.picture > 0) return "";
  return state.has_stopped ? "No picture yet." : "Drawing …";
}

function setText(id, text) {
  if (get(id).textContent !== text) get(id).textContent = text;
}

function showTexts(state) {
  setText("subject", state.subject);
  setText("about", state.about);
  const rate = state.rays_per_second >= 1e6 ? `${(state.rays_per_second / 1e6).toFixed(1)} million`
    : Math.round(state.rays_per_second).toLocaleString("en");
  const programs = state.tests ? 1 : state.programs;
  const parts = [`${state.film[0]} × ${state.film[1]}`];
  if (["shaded", "clay"].includes(state.view)) parts.push(`${state.complete_samples} of ${state.samples} samples`);
  if (state.rays_per_second > 0) parts.push(`${rate} rays per second in ${programs} ${programs === 1 ? "program" : "programs"}`);
  if (state.is_complete) parts.push(`finished in ${state.seconds.toFixed(1)} s`);
  else if (state.seconds_left !== null) parts.push(`${Math.max(1, Math.round(state.seconds_left))} s left`);
  setText("status", parts.join("; "));
  const legends = {
    clay: "dark where other shapes are near; blue where the normal points away from the camera",
    normals: "x, y and z of the normal, from −1 to 1, as red, green and blue",
    depth: "distance: the nearest hit is white, the farthest almost black",
    uv: "u and v as red and green",
  };
  const isAboutTests = showTests(state);
  if (state.view === "bvh") {
    get("legend").replaceChildren("boxes around the hit: few", element("span", { class: "ramp" }), "many");
  } else if (!isAboutTests) {
    setText("legend", legends[state.view] ?? "");
  }
  // Screen readers announce this text, so it rarely changes.
  setText("news", state.build === "compiling" ? "Compiling" : state.build === "failed" ? "The files do not compile"
    : state.is_picture_complete ? "The picture is complete" : "");
  const question = get("question");
  question.hidden = !state.question;
  get("pick-question").hidden = !state.question?.has_ray;
  if (state.question && question.dataset.of !== state.subject) {
    question.dataset.of = state.subject;
    get("question-text").replaceChildren(element("p", {}, `asked: ${state.question.asked}`),
      ...state.question.wanted.map((text) => element("p", {}, `wanted: ${text}`)));
    overlay.setLines("level", state.question.boxes.flatMap(([min, max]) =>
      overlay.boxLines(min, max, { colour: overlay.COLOURS.level, width: 2 })));
  }
}

/** Fills a list of choices if they have changed, and selects one unless the user is choosing. */
function choices(id, list, selected) {
  const select = get(id);
  const key = JSON.stringify(list);
  if (select.dataset.key !== key) {
    select.dataset.key = key;
    select.replaceChildren(...list.map(([value, text]) => element("option", { value }, text)));
  }
  if (document.activeElement !== select || last === null) select.value = selected;
}

function showControls(state) {
  const scenes = state.scenes.map((name) => [name, name]);
  if (state.question) scenes.unshift(["", state.subject]);
  choices("scene", scenes, state.loading ?? (state.question ? "" : state.subject));
  const [w, h] = state.own_film;
  const sizes = [0.25, 0.5, 1, 2].map((f) => [Math.max(1, Math.round(w * f)), Math.max(1, Math.round(h * f))]);
  if (!sizes.some(([x, y]) => x === state.film[0] && y === state.film[1])) sizes.push(state.film);
  choices("film", sizes.filter(([x, y]) => x <= 2048 && y <= 2048).map(([x, y]) => [`${x}x${y}`, `${x} × ${y}`]), state.film.join("x"));
  const counts = [...new Set([1, 4, 16, 32, 64, 256, 1024, 4096, state.samples])].sort((a, b) => a - b);
  choices("samples", counts.map((n) => [n, String(n)]), state.samples);
  if (document.activeElement !== get("exposure")) get("exposure").value = state.exposure;
  const radio = document.querySelector(`input[name=view][value=${state.view}]`);
  if (radio) radio.checked = true;
  get("pick-x").max = state.film[0] - 1;
  get("pick-y").max = state.film[1] - 1;
  if (state.pinned?.pixel && JSON.stringify(state.pinned) !== JSON.stringify(last?.pinned)) {
    [get("pick-x").value, get("pick-y").value] = state.pinned.pixel;
    get("pick-sample").value = String(state.pinned.sample ?? "");
  }
}

/** Shows a message over the picture, unfolded if it was hidden before. */
function showMessage(id, isShown) {
  const message = get(id);
  if (isShown && message.hidden) message.open = true;
  message.hidden = !isShown;
}

function showErrors(state) {
  showMessage("errors", state.build === "failed");
  const key = JSON.stringify(state.errors);
  const list = get("error-list");
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  list.replaceChildren(...state.errors.flatMap((error) => [
    element("h3", {}, ...withLinks(error.line === null ? error.file : `${error.file}:${error.line}`)),
    element("pre", { tabindex: 0 }, ...withLinks(error.text))]));
}

function showNotes(state) {
  const { notes, panics } = state;
  const key = JSON.stringify([notes, panics, state.has_stopped, state.slow_build]);
  const list = get("notes");
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  const at = (location) => location ? withLinks(` (${location})`) : [];
  const text = (note) => [...prose(note.text), ...at(note.location)];
  // The first note says why the program has stopped.
  const fault = state.has_stopped ? notes[0] : state.slow_build;
  showMessage("stopped", Boolean(fault));
  setText("stopped-title", state.has_stopped ? "Your code has stopped" : "Your code is taking a long time");
  get("stopped-text").replaceChildren(...(fault ? text(fault) : []));
  const samples = (n) => n === 1 ? "Pixel" : `${n.toLocaleString("en")} samples, the first in pixel`;
  list.replaceChildren(
    ...(state.has_stopped ? notes.slice(1) : notes).map((note) => element("li", {}, ...text(note))),
    ...panics.map((panic) => element("li", { class: "panic" },
      `${samples(panic.count)} (${panic.pixel.join(", ")}): `, ...prose(panic.message), ...at(panic.location))));
  get("messages").hidden = list.children.length === 0;
}

function listen() {
  get("pick-sample").append(...Array.from({ length: LISTED_SAMPLES }, (_, i) => element("option", { value: i }, `path ${i + 1}`)));
  const sample = () => get("pick-sample").value === "" ? null : Number(get("pick-sample").value);
  stage.listen(sample);
  stage.listenToHovering(get("hovered"));
  tree.listen();
  get("lines").addEventListener("pointermove", (event) => {
    if (event.buttons === 0) tree.nodeAt(event.offsetX, event.offsetY);
  });
  get("views").addEventListener("change", (event) => send({ view: event.target.value }));
  get("scene").addEventListener("change", (event) => event.target.value && send({ scene: event.target.value }));
  get("film").addEventListener("change", (event) => send({ film: event.target.value.split("x").map(Number) }));
  get("samples").addEventListener("change", (event) => send({ samples: Number(event.target.value) }));
  get("exposure").addEventListener("change", (event) => send({ exposure: Number(event.target.value) }));
  get("controls").addEventListener("click", (event) => {
    if ("own" in event.target.dataset) send("own_camera");
    if (event.target.dataset.side) send({ side: event.target.dataset.side });
  });
  get("pick").addEventListener("submit", (event) => {
    event.preventDefault();
    send({ pick: { pixel: [Number(get("pick-x").value), Number(get("pick-y").value)], sample: sample() } });
  });
  get("pick-question").addEventListener("click", () => send("pick_question"));
  get("unpick").addEventListener("click", () => send("unpick"));
}

listen();
follow(show, (isConnected) => { get("offline").hidden = isConnected; });
