// Draws lines over the picture: boxes, rays and primitives, seen from the camera.

const canvas = document.getElementById("lines");
let camera = null;
let layers = { level: [], defects: [], node: [], path: [], steps: [] };
let pixel = null;
let film = [1, 1];

export const COLOURS = { level: "#4aa3ff", node: "#ffffff", ray: "#ffd21f", entered: "#3ddc84", skipped: "#ffb020",
  missed: "#ff6b6b", primitive: "#ff7bff", bad: "#ff2020" };

/** Sets the camera of the picture, and the marked pixel, counted from the bottom left. */
export function setCamera(state) {
  camera = state.camera;
  film = state.film;
  pixel = state.pinned?.is_here ? state.pinned.pixel : null;
  draw();
}

/** Replaces the lines of one layer: { points: [[x, y, z], …], colour, width, fill }. */
export function setLines(layer, lines) {
  layers = { ...layers, [layer]: lines };
  draw();
}

/** Returns the twelve edges of a box as lines. */
export function boxLines(min, max, style) {
  const corner = (i) => [i & 1 ? max[0] : min[0], i & 2 ? max[1] : min[1], i & 4 ? max[2] : min[2]];
  const edges = [];
  for (let i = 0; i < 8; i++) {
    for (const bit of [1, 2, 4]) if (!(i & bit)) edges.push({ points: [corner(i), corner(i | bit)], ...style });
  }
  return edges;
}

/** Returns a point in the camera's space: to the right, up, and forward. */
function toCamera(point) {
  const from = point.map((x, i) => x - camera.position[i]);
  const along = (axis) => axis.reduce((sum, x, i) => sum + x * from[i], 0);
  const [right, up, backward] = camera.axes.map(along);
  return [right, up, -backward];
}

/** Cuts off the part of a line behind the camera. Returns null if nothing is left. */
function clip(a, b) {
  const near = 1e-3 * Math.max(1e-3, Math.abs(a[2]), Math.abs(b[2]));
  if (a[2] < near && b[2] < near) return null;
  const cut = (from, to) => {
    if (from[2] >= near) return from;
    const t = (near - from[2]) / (to[2] - from[2]);
    return from.map((x, i) => x + t * (to[i] - x));
  };
  return [cut(a, b), cut(b, a)];
}

function toCanvas([right, up, forward]) {
  const y = up / forward / camera.half_height;
  const x = right / forward / camera.half_height / camera.aspect_ratio;
  return [(x + 1) / 2 * canvas.width, (1 - y) / 2 * canvas.height];
}

/** Returns the part of the picture that a box covers, [left, top, right, bottom] in CSS pixels, or null. */
export function covered(min, max) {
  if (!camera) return null;
  const parts = boxLines(min, max, {}).map(({ points }) => clip(...points.map(toCamera))).filter(Boolean);
  if (parts.length === 0) return null;
  const ends = parts.flat().map(toCanvas);
  const scale = canvas.clientWidth / canvas.width;
  const [xs, ys] = [0, 1].map((axis) => ends.map((end) => end[axis] * scale));
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

function draw() {
  const scale = window.devicePixelRatio || 1;
  canvas.width = Math.max(1, Math.round(canvas.clientWidth * scale));
  canvas.height = Math.max(1, Math.round(canvas.clientHeight * scale));
  const context = canvas.getContext("2d");
  context.clearRect(0, 0, canvas.width, canvas.height);
  if (!camera) return;
  for (const line of [...layers.level, ...layers.defects, ...layers.path, ...layers.steps, ...layers.node]) drawLine(context, line, scale);
  if (pixel) {
    const [w, h] = [canvas.width / film[0], canvas.height / film[1]];
    const [x, y] = [(pixel[0] + 0.5) * w, (film[1] - 0.5 - pixel[1]) * h];
    for (const [colour, width] of [["#000", 4], ["#fff", 2]]) {
      context.strokeStyle = colour;
      context.lineWidth = width * scale;
      context.beginPath();
      context.arc(x, y, 7 * scale, 0, 2 * Math.PI);
      context.stroke();
    }
  }
}

function drawLine(context, { points, colour, width = 1.5, fill = false, dash = [] }, scale) {
  const seen = points.map(toCamera);
  context.fillStyle = colour;
  context.setLineDash(dash.map((length) => length * scale));
  if (fill && seen.every((point) => point[2] > 0)) {
    context.beginPath();
    for (const point of seen) context.lineTo(...toCanvas(point));
    context.closePath();
    context.globalAlpha = 0.6;
    context.fill();
    context.globalAlpha = 1;
  }
  const parts = seen.slice(1).map((end, i) => clip(seen[i], end)).filter(Boolean);
  // A dark border makes lines visible on bright surfaces.
  for (const [style, more] of [["rgb(0 0 0 / 60%)", 2], [colour, 0]]) {
    context.strokeStyle = style;
    context.lineWidth = (width + more) * scale;
    for (const [from, to] of parts) {
      context.beginPath();
      context.moveTo(...toCanvas(from));
      context.lineTo(...toCanvas(to));
      context.stroke();
    }
  }
}

new ResizeObserver(draw).observe(canvas);
