// Shows the picture, and turns mouse, touch and key events into movements of the camera.
import { load, move, request, send } from "./server.js";

const stage = document.getElementById("stage");
const pixels = document.getElementById("pixels");
let shown = -1;
let isLoading = false;
let wanted = null;

/** Shows the picture of a state, unless it is already shown. */
export async function showPicture(state) {
  // The shape of the picture is set before the first pixel arrives, so that nothing moves later.
  document.getElementById("picture").style.setProperty("--ratio", state.film[0] / state.film[1]);
  if (state.picture === 0 || state.picture === shown) return;
  wanted = state;
  if (isLoading) return;
  isLoading = true;
  while (wanted) {
    const { picture, film } = wanted;
    wanted = null;
    try {
      const answer = await request(`/picture?n=${picture}`);
      if (!answer.ok) break;
      const blob = await answer.blob();
      const bitmap = await createImageBitmap(blob);
      pixels.width = bitmap.width;
      pixels.height = bitmap.height;
      pixels.getContext("2d").drawImage(bitmap, 0, 0);
      shown = picture;
      const save = document.getElementById("save");
      if (save.href.startsWith("blob:")) URL.revokeObjectURL(save.href);
      save.href = URL.createObjectURL(blob);
      save.download = `${state.subject.replace(/[^\w.-]+/g, "-")}.png`;
      pixels.dataset.picture = picture;
    } catch {
      break;
    }
  }
  isLoading = false;
}

/** Returns the pixel at a position in the window, counted from the bottom left. */
function pixelAt(clientX, clientY) {
  const box = pixels.getBoundingClientRect();
  const x = Math.floor((clientX - box.left) / box.width * pixels.width);
  const y = pixels.height - 1 - Math.floor((clientY - box.top) / box.height * pixels.height);
  const inside = (at, length) => Math.min(Math.max(at, 0), length - 1);
  return [inside(x, pixels.width), inside(y, pixels.height)];
}

/** Explains the pixel at a position in the window. `sample` is the number of a path, or null. */
function pickAt(clientX, clientY, sample) {
  return send({ pick: { pixel: pixelAt(clientX, clientY), sample } });
}

/** Shows the value of the pixel under the mouse in the element `text`. */
export function listenToHovering(text) {
  let next = null;
  let isAsking = false;
  stage.addEventListener("pointermove", async (event) => {
    if (event.buttons !== 0) return;
    next = pixelAt(event.clientX, event.clientY);
    if (isAsking) return;
    isAsking = true;
    while (next) {
      const [x, y] = next;
      next = null;
      const value = await load(`/value?x=${x}&y=${y}`);
      text.textContent = value === null ? "" : `(${x}, ${y}): ${value}`;
    }
    isAsking = false;
  });
}

/** Listens to the mouse, to fingers and to keys. `sample` returns the path that a click explains. */
export function listen(sample) {
  const fingers = new Map();
  let start = null;
  stage.addEventListener("pointerdown", (event) => {
    stage.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    start = fingers.size === 1 ? { x: event.clientX, y: event.clientY, moved: false } : null;
  });
  stage.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = { x: event.clientX, y: event.clientY };
    const [dx, dy] = [now.x - before.x, now.y - before.y];
    if (start && Math.hypot(now.x - start.x, now.y - start.y) > 4) start.moved = true;
    const height = stage.clientHeight;
    if (fingers.size === 2) {
      const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      const spread = (at) => Math.max(1, Math.hypot(at.x - other.x, at.y - other.y));
      move("dolly", [spread(before) / spread(now)]);
      move("pan", [-dx / height / 2, dy / height / 2]);
    } else if (start?.moved) {
      if (event.shiftKey || event.buttons & 6) move("pan", [-dx / height, dy / height]);
      else move("orbit", [-dx / height * 3, dy / height * 3]);
    }
    if (!start || start.moved) fingers.set(event.pointerId, now);
  });
  const end = (event) => {
    fingers.delete(event.pointerId);
    if (event.type === "pointerup" && start && !start.moved && event.button === 0) {
      pickAt(event.clientX, event.clientY, sample());
    }
    start = null;
  };
  stage.addEventListener("pointerup", end);
  stage.addEventListener("pointercancel", end);
  stage.addEventListener("contextmenu", (event) => event.preventDefault());
  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    move("dolly", [Math.exp(Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) / 500)]);
  }, { passive: false });
  stage.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const step = 0.1;
    const turns = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (turns[key]) move(event.shiftKey ? "pan" : "orbit", turns[key]);
    else if (key === "+" || key === "=") move("dolly", [0.9]);
    else if (key === "-") move("dolly", [1 / 0.9]);
    else if (key === "w" || key === "s") move("fly", [key === "w" ? step : -step]);
    else if (key === "a" || key === "d") move("turn", [key === "a" ? -step : step, 0]);
    else if (key === "Home") send("own_camera");
    else if (key === "Enter") {
      const box = pixels.getBoundingClientRect();
      pickAt(box.left + box.width / 2, box.top + box.height / 2, sample());
    } else return;
    event.preventDefault();
  });
}
