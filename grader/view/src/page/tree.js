// The tree: boxes over the picture, a strip with a row for each level, and the worst nodes.
import { load } from "./server.js";
import { boxLines, COLOURS, covered, setLines } from "./overlay.js";
import { costOf, showDefects } from "./defects.js";
import { element, number } from "./main.js";

const strip = document.getElementById("strip");
const level = document.getElementById("level");
const isOn = document.getElementById("boxes-on");
const below = document.getElementById("below");
let shown = "";
let summary = null;
/** The number of levels in the strip. */
let rows = 1;
let boxes = [];
let selected = null;

/** Shows the tree of a state, unless it is already shown. */
export async function showTree(state) {
  const has = state.has_tree && state.tree_number !== shown;
  // While the tree is being rebuilt, the previous one stays, so that nothing moves.
  const isPending = summary !== null && (state.build !== "ready" || !state.is_complete);
  document.getElementById("tree-content").hidden = !state.has_tree && !isPending;
  document.getElementById("tree-hint").hidden = state.has_tree || isPending;
  if (!state.has_tree) {
    shown = "";
    if (boxes.length > 0) setLines("level", boxes = []);
    selected = null;
    setLines("node", []);
    showDefects(null);
    return;
  }
  if (!has) return;
  shown = state.tree_number;
  summary = await load("/tree");
  if (!summary) return;
  // If the nodes do not form a tree, their costs are all 0.
  summary.cost ||= 1;
  level.max = summary.levels - 1;
  rows = 1 + summary.bars.reduce((most, bar) => Math.max(most, bar.level), 0);
  document.getElementById("tree-facts").textContent =
    `${count(summary.primitives, "primitive")}, ${count(summary.nodes, "node")}, ${count(summary.levels, "level")}; `
    + costOf(summary.checkup)
    + (rows < summary.levels ? ` Only the first ${rows} levels are in the strip.` : "");
  showDefects(summary.checkup, goTo);
  showTable("worst", summary.worst);
  document.getElementById("node-index").max = summary.nodes - 1;
  drawStrip();
  // The tree may have been built again.
  if (selected) await goTo(selected.node);
  await showLevel();
}

function count(n, word) {
  return `${n.toLocaleString("en")} ${word}${n === 1 ? "" : "s"}`;
}

async function showLevel() {
  document.getElementById("level-value").textContent = level.value;
  const text = document.getElementById("boxes-count");
  if (!isOn.checked || !summary) {
    boxes = [];
    document.getElementById("drawn").hidden = true;
    text.textContent = "";
    setLines("level", []);
    return;
  }
  const found = await load(`/boxes?level=${level.value}&below=${below.checked}`);
  if (!found) return;
  boxes = found.boxes;
  document.getElementById("drawn").hidden = false;
  showTable("drawn-boxes", boxes);
  const rest = found.count > boxes.length ? `, of which the ${boxes.length} largest are drawn` : "";
  text.textContent = count(found.count, "box").replace("boxs", "boxes") + rest;
  setLines("level", boxes.flatMap((node) =>
    boxLines(node.min, node.max, { colour: node.leaf ? COLOURS.entered : COLOURS.level })));
}

function facts(node) {
  const share = (x) => `${(100 * x).toFixed(1)}%`;
  const overlap = node.overlap === null ? "" : `; ${node.overlap.toFixed(2)} children hit on average`;
  return `${node.leaf ? "Leaf" : "Node"} ${node.node}, level ${node.level}: ${count(node.primitives, "primitive")}, `
    + `${share(node.area)} of the root's area, ${share(node.cost / summary.cost)} of the SAH cost${overlap}.`;
}

function select(node) {
  selected = node;
  document.getElementById("node").textContent = node ? facts(node) : "";
  setLines("node", node ? boxLines(node.min, node.max, { colour: COLOURS.node, width: 3 }) : []);
  if (node) document.getElementById("node-index").value = node.node;
  for (const [id, of] of relatives) document.getElementById(id).disabled = (of(node) ?? null) === null;
  drawStrip();
}

/** The nodes that the buttons lead to. */
const relatives = [["node-parent", (node) => node?.parent], ["node-first", (node) => node?.children?.[0]],
  ["node-second", (node) => node?.children?.[1]]];

async function goTo(index) {
  const node = await load(`/node?node=${index}`);
  if (node) select(node);
  else document.getElementById("node").textContent = `The tree has no node ${index}.`;
}

function showTable(id, nodes) {
  const table = document.getElementById(id);
  const headings = ["node", "level", "primitives", "area", "share of the cost", "children hit"];
  table.replaceChildren(element("thead", {}, element("tr", {}, ...headings.map((text) =>
    element("th", { scope: "col" }, text)))));
  const body = element("tbody", {});
  for (const node of nodes) {
    const button = element("button", { type: "button", "aria-label": `Show node ${node.node}` }, String(node.node));
    button.addEventListener("click", () => select(node));
    const cells = [button, node.level, `${node.primitives}${node.leaf ? " (leaf)" : ""}`,
      `${(100 * node.area).toFixed(1)}%`, `${(100 * node.cost / summary.cost).toFixed(1)}%`,
      node.overlap === null ? "–" : number(node.overlap)];
    body.append(element("tr", {}, ...cells.map((cell) => element("td", {}, cell instanceof Node ? cell : String(cell)))));
  }
  table.append(body);
}

function drawStrip() {
  if (!summary) return;
  const scale = window.devicePixelRatio || 1;
  strip.width = Math.max(1, strip.clientWidth * scale);
  strip.height = Math.max(1, strip.clientHeight * scale);
  const context = strip.getContext("2d");
  const row = strip.height / rows;
  for (const bar of summary.bars) {
    const isLevel = isOn.checked && (bar.level === Number(level.value) || below.checked && bar.level > level.value);
    context.fillStyle = selected?.node === bar.node ? "#e08a00" : bar.leaf ? (isLevel ? "#138a4a" : "#7bbf9a") : isLevel ? "#0b57c2" : "#8fb0dd";
    const width = Math.max(1, bar.width * strip.width - scale);
    context.fillRect(bar.start * strip.width, bar.level * row, width, Math.max(1, row - scale));
  }
}

function barAt(event) {
  if (!summary) return null;
  const x = event.offsetX / strip.clientWidth;
  // On the strip's border, the offset is negative.
  const wanted = Math.floor(Math.max(0, event.offsetY) / strip.clientHeight * rows);
  return summary.bars.find((bar) => bar.level === wanted && bar.start <= x && x < bar.start + bar.width) ?? null;
}

/** Listens to the controls. */
export function listen() {
  const change = () => { showLevel(); drawStrip(); };
  level.addEventListener("input", () => { isOn.checked = true; change(); });
  isOn.addEventListener("change", change);
  below.addEventListener("change", change);
  let hovered = null;
  const point = async (event) => {
    const bar = barAt(event);
    if (!bar || bar.node === hovered) return;
    hovered = bar.node;
    const node = await load(`/node?node=${bar.node}`);
    if (node && hovered === bar.node) select(node);
  };
  strip.addEventListener("pointermove", point);
  strip.addEventListener("pointerdown", point);
  strip.addEventListener("pointerleave", () => { hovered = null; });
  document.getElementById("choose-node").addEventListener("submit", (event) => {
    event.preventDefault();
    goTo(document.getElementById("node-index").value);
  });
  for (const [id, of] of relatives) {
    document.getElementById(id).addEventListener("click", () => goTo(of(selected)));
  }
  new ResizeObserver(drawStrip).observe(strip);
}

/** Selects the node with the smallest drawn box that contains a position in the picture. */
export function nodeAt(x, y) {
  let [best, size] = [null, Infinity];
  for (const node of boxes) {
    const [left, top, right, bottom] = covered(node.min, node.max) ?? [1, 1, 0, 0];
    const area = (right - left) * (bottom - top);
    if (left <= x && x <= right && top <= y && y <= bottom && area < size) [best, size] = [node, area];
  }
  if (best && best.node !== selected?.node) select(best);
}
