// Explains one pixel: shows the tests of its rays as a table, and step by step in the picture.
import { load } from "./server.js";
import { boxLines, COLOURS, setLines } from "./overlay.js";
import { showHistory } from "./history.js";
import { element, number, prose } from "./main.js";
import { pathParts } from "./path.js";

const content = document.getElementById("explanation");
const FIRST_ROWS = 400;
const MAX_MARKED = 20;

// The outcomes as shown in the table, where each step takes one line.
const SHORT_OUTCOMES = {
  entered: "entered",
  not_entered: "not entered",
  skipped_beyond: "behind",
  outside_times: "outside times",
  missed: "missed",
  closest: "closest",
  farther: "farther",
  no_hit: "no hit",
};
// The outcomes as sentences. `AT` is replaced with the part of the ray inside the box, or with the
// distance.
const OUTCOMES = {
  entered: "hit from AT: entered",
  not_entered: "hit from AT: not entered",
  skipped_beyond: "hit from AT: not entered because it begins beyond the closest hit",
  outside_times: "hit from AT, but outside the times that were passed: skipped",
  missed: "missed",
  closest: "hit at AT: the closest so far",
  farther: "hit at AT, which is not the closest",
  no_hit: "not hit",
};
const RULES = {
  missed_box: (node) => `node ${node} is entered, even though the ray misses its box`,
  beyond_closest_hit: (node) => `node ${node} is entered, even though its box begins beyond the closest hit`,
  farther_child_first: (node) => `node ${node} is visited before the other child, even though the ray enters the other child's box first`,
};
const SHORT_RULES = { missed_box: "misses the box", beyond_closest_hit: "behind the hit", farther_child_first: "farther first" };
const COLOUR_OF = { entered: COLOURS.entered, not_entered: COLOURS.skipped, skipped_beyond: COLOURS.skipped,
  outside_times: COLOURS.skipped, missed: COLOURS.missed, closest: COLOURS.primitive, farther: COLOURS.primitive,
  no_hit: COLOURS.missed };

let shown = null;

/** Shows the explanation of a state, unless it is already shown. */
export async function showExplanation(state) {
  document.getElementById("unpick").hidden = !state.pinned;
  document.getElementById("pixel-hint").hidden = Boolean(state.pinned);
  const problem = document.getElementById("pixel-problem");
  problem.textContent = !state.pinned || state.explanation !== null ? ""
    : state.explanation_fault ?? "Recording the tests …";
  if (state.explanation === null) {
    // While the files are being compiled, the previous explanation stays.
    if (!state.pinned || state.explanation_fault) clear();
    return;
  }
  if (state.explanation === shown) return;
  shown = state.explanation;
  const explanation = await load(`/explanation?n=${shown}`);
  if (explanation) show(explanation, state);
}

function clear() {
  shown = null;
  content.replaceChildren();
  showHistory(null);
  delete content.dataset.version;
  setLines("steps", []);
  setLines("path", []);
}

function show(explanation, state) {
  content.replaceChildren();
  content.dataset.version = shown;
  const { pixel, sample, rays, panic, radiance } = explanation;
  const title = pixel ? `Pixel (${pixel.join(", ")})` : "The exam's ray";
  const path = sample === null ? "" : `, path ${sample + 1}`;
  content.append(element("h3", {}, title + path));
  if (radiance) content.append(element("p", {}, `Radiance of the path: ${radiance.map((x) => number(x)).join(", ")}`));
  if (panic) content.append(element("p", { class: "rule" }, ...prose(`Panicked: ${panic[0]} (${panic[1]})`)));
  content.append(...pathParts(explanation));
  showHistory(explanation);
  // All rays of a path are drawn, no matter which of them is being stepped through.
  setLines("path", rays.length > 1 ? rays.map((ray) => rayLine(ray, 1.5)) : []);
  if (rays.length === 0) content.append(element("p", {}, ...prose("No ray was passed to `Bvh::hit`.")));
  rays.forEach((ray, i) => {
    const parent = rays.length === 1 ? content
      : content.appendChild(element("details", i === 0 ? { open: "" } : {}));
    const marks = ray.rows.reduce((sum, row) => sum + row.marks.length, 0);
    const summary = `${i + 1}. ${ray.kind}: ${result(ray)}; ${ray.boxes} box and ${ray.primitives} primitive tests`
      + (marks > 0 ? `, ${marks} marked` : "");
    if (rays.length === 1) {
      parent.append(element("p", {}, `${ray.kind[0].toUpperCase()}${ray.kind.slice(1)}: ${result(ray)}. `
        + `${ray.boxes} box tests, ${ray.primitives} primitive tests.`));
      fill(parent, ray, 1, state.traversal);
    } else {
      parent.append(element("summary", {}, summary));
      const once = () => { if (parent.open && parent.children.length === 1) fill(parent, ray, i + 1, state.traversal); };
      parent.addEventListener("toggle", once);
      if (i === 0) fill(parent, ray, i + 1, state.traversal);
    }
  });
}

function result(ray) {
  if (ray.is_shadow_ray) return ray.hit ? `light hidden: hit at ${number(ray.hit.distance)}` : "light visible";
  return ray.hit ? `hit at ${number(ray.hit.distance)}` : "no hit";
}

/** `traversal` is the file and line of `Bvh::hit`. */
function fill(parent, ray, index, traversal) {
  const at = (list) => `(${list.map((x) => number(x)).join(", ")})`;
  const range = ray.range.map((end) => end === null ? "∞" : number(end)).join(" to ");
  parent.append(element("p", {}, `From ${at(ray.origin)} in direction ${at(ray.dir)}, range ${range}.`));
  for (const note of ray.notes) parent.append(element("p", { class: "note" }, ...prose(note)));
  const marked = ray.rows.flatMap((row, i) => row.marks.map(([rule, node]) => [i, RULES[rule](node)]));
  if (marked.length > 0) {
    const list = element("ul", { class: "marked" });
    for (const [i, text] of marked.slice(0, MAX_MARKED)) {
      const item = element("li", {}, element("button", { type: "button" }, `Step ${i + 1}`), `: ${text}`);
      item.firstChild.addEventListener("click", () => go(i, true));
      list.append(item);
    }
    if (marked.length > MAX_MARKED) list.append(element("li", {}, `and ${marked.length - MAX_MARKED} more`));
    const where = traversal ? prose(` (${traversal})`) : [];
    parent.append(element("p", { class: "rule" }, "A correct traversal doesn't do this", ...where, ":"), list);
  }
  if (ray.rows.length === 0) return;

  const slider = element("input", { type: "range", min: 0, max: ray.rows.length, value: 0, "aria-label": `Step of ray ${index}` });
  const button = (text, label, step) => {
    const made = element("button", { type: "button", "aria-label": label }, text);
    made.addEventListener("click", () => go(step(), true));
    return made;
  };
  const count = element("output", { class: "step-text" });
  parent.append(element("div", { class: "steps" },
    button("|◀", "First step", () => 0), button("◀", "Step back", () => now - 1),
    button("▶", "Step forward", () => now + 1), button("▶|", "All steps", () => ray.rows.length),
    slider), count);
  const body = element("tbody", {});
  const table = element("table", { "aria-label": "The tests, in order" },
    element("thead", {}, element("tr", {}, ...["step", "test", "level", "distance", "result", "closest"].map((text) =>
      element("th", { scope: "col" }, text)))), body);
  parent.append(element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": `The tests of ray ${index}` }, table));
  const addRows = (until) => {
    for (let i = body.children.length; i < Math.min(until, ray.rows.length); i++) body.append(tableRow(ray.rows[i], i, go));
  };
  addRows(FIRST_ROWS);
  if (ray.rows.length > FIRST_ROWS) {
    const more = element("button", { type: "button" }, `Show all ${ray.rows.length} tests`);
    more.addEventListener("click", () => { addRows(Infinity); more.remove(); });
    parent.append(more);
  }
  let now = ray.rows.length;
  function go(step, scroll) {
    now = Math.min(Math.max(step, 0), ray.rows.length);
    slider.value = now;
    const row = ray.rows[now];
    count.textContent = row ? `step ${now + 1} of ${ray.rows.length}: ${subject(row)}${inLeaf(row)}: ${outcomeOf(row)}`
      : `all ${ray.rows.length} steps`;
    body.querySelector("[aria-current]")?.removeAttribute("aria-current");
    addRows(row ? now + 1 : 0);
    const current = row && body.children[now];
    if (current) {
      current.setAttribute("aria-current", "step");
      if (scroll) current.scrollIntoView({ block: "nearest" });
    }
    setLines("steps", lines(ray, now));
  }
  slider.addEventListener("input", () => go(Number(slider.value), true));
  go(now, false);
}

function outcomeOf(row) {
  // `row.closest` is the closest hit right after this test. A closer one may have been found later,
  // before the traversal came to the node.
  const isLater = row.outcome === "skipped_beyond" && !(row.closest !== null && row.closest < row.at[0]);
  const text = isLater ? "hit from AT: postponed, then not entered because a closer hit was found" : OUTCOMES[row.outcome];
  return text.replace("AT", row.at.map((x) => number(x)).join(" to "));
}

function subject(row) {
  const { nodes } = row;
  if (!row.is_box) return `${row.triangle ? "triangle" : "sphere"} ${row.shape}`;
  if (nodes.length === 0) return "a box that is not in the tree";
  const list = nodes.length > 4 ? [...nodes.slice(0, 4), "…"] : nodes;
  return nodes.length > 1 ? `one of the nodes ${list.join(", ")}` : `node ${nodes[0]}`;
}

/** Returns the text that names the leaf of a primitive. */
function inLeaf(row) {
  return !row.is_box && row.nodes.length > 0 ? ` in leaf ${row.nodes[0]}` : "";
}

function tableRow(row, i, go) {
  const step = element("button", { type: "button", "aria-label": `Show step ${i + 1}` }, String(i + 1));
  step.addEventListener("click", () => go(i, false));
  const rules = row.marks.map(([rule]) => `✗ ${SHORT_RULES[rule]}`);
  const outcome = rules.length > 0 ? element("td", { class: "rule" }, rules.join(", "))
    : element("td", {}, SHORT_OUTCOMES[row.outcome] + (row.again ? " (again)" : ""));
  const short = (x) => number(x, 4);
  return element("tr", row.marks.length > 0 ? { class: "mark" } : {},
    element("td", {}, step), element("td", {}, subject(row)), element("td", {}, String(row.level ?? "")),
    element("td", {}, row.at.map(short).join(" – ")), outcome,
    element("td", {}, row.closest === null ? "none" : short(row.closest)));
}

/** Returns the lines for all tests up to a step, which is emphasised. */
function lines(ray, step) {
  const all = [];
  let closest = null;
  const start = Math.max(0, step - 150);
  ray.rows.slice(start, step + 1).forEach((row, i) => {
    const isNow = start + i === step;
    const style = { colour: row.marks.length > 0 ? COLOURS.bad : COLOUR_OF[row.outcome], width: isNow ? 3.5 : 1.5 };
    // Of the earlier tests, only the entered boxes and the most recent closest hit are still drawn.
    if (row.outcome === "closest") closest = row;
    if (!isNow && row.outcome !== "entered" && row.marks.length === 0) return;
    if (row.triangle) all.push({ points: [...row.triangle, row.triangle[0]], fill: isNow, ...style });
    else if (row.corners) all.push(...boxLines(...row.corners, style));
  });
  all.push(rayLine(ray, 3));
  // The closest hit is drawn last, so that nothing hides it.
  const style = { colour: COLOURS.primitive, width: 3.5 };
  if (closest?.triangle) all.push({ points: [...closest.triangle, closest.triangle[0]], fill: true, ...style });
  else if (closest?.corners) all.push(...boxLines(...closest.corners, style));
  return all;
}

/** Returns the line from the start of a ray to its hit. The line is dashed if there is no hit. */
function rayLine(ray, width) {
  const end = ray.hit?.distance ?? ray.range[1] ?? farthest(ray);
  const along = (t) => ray.origin.map((x, i) => x + t * ray.dir[i]);
  return { points: [along(Math.max(ray.range[0] ?? 0, 0)), along(end)], colour: COLOURS.ray, width,
    dash: ray.hit ? [] : [6, 4] };
}

function farthest(ray) {
  const ends = ray.rows.flatMap((row) => row.at).filter(Number.isFinite);
  return Math.max(1, ...ends) * 1.2;
}
