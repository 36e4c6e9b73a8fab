// One pixel explained: the tests of its rays as a table, and step by step in the picture.
import { load } from "./server.js";
import { boxLines, COLOURS, setLines } from "./overlay.js";
import { element, number, prose } from "./main.js";

const content = document.getElementById("explanation");
const FIRST_ROWS = 400;

// The outcomes of tests. `AT` is replaced by the part of the ray in the box, or by the distance.
const OUTCOMES = {
  entered: "hit from AT: entered",
  not_entered: "hit from AT: not entered",
  skipped_beyond: "hit from AT: not entered, since it begins beyond the closest hit",
  outside_times: "hit from AT, but not within the times that were passed: skipped",
  missed: "missed",
  closest: "hit at AT: the closest so far",
  farther: "hit at AT, which is not the closest",
  no_hit: "not hit",
};
const RULES = {
  missed_box: (node) => `node ${node} is entered, although the ray misses its box`,
  beyond_closest_hit: (node) => `node ${node} is entered, although its box begins beyond the closest hit`,
  farther_child_first: (node) => `node ${node} is visited before the other child, although the ray enters its box later`,
};
const COLOUR_OF = { entered: COLOURS.entered, not_entered: COLOURS.skipped, skipped_beyond: COLOURS.skipped,
  outside_times: COLOURS.skipped, missed: COLOURS.missed, closest: COLOURS.primitive, farther: COLOURS.primitive,
  no_hit: COLOURS.missed };

let shown = null;

/** Shows the explanation of a state, unless it is shown already. */
export async function showExplanation(state) {
  document.getElementById("unpick").hidden = !state.pinned;
  document.getElementById("pixel-hint").hidden = Boolean(state.pinned);
  const problem = document.getElementById("pixel-problem");
  problem.textContent = !state.pinned || state.explanation !== null ? ""
    : state.explanation_fault ?? "Recording the tests …";
  if (state.explanation === null) {
    // While the files are compiled, the last explanation stays.
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
  if (radiance) content.append(element("p", {}, `Radiance of the path: ${radiance.map(number).join(", ")}`));
  if (panic) content.append(element("p", { class: "rule" }, `Panicked: ${panic[0]} (${panic[1]})`));
  // All rays of a path are in the picture, whichever of them is stepped through.
  setLines("path", rays.length > 1 ? rays.map((ray) => rayLine(ray, 1)) : []);
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
      fill(parent, ray, 1);
    } else {
      parent.append(element("summary", {}, summary));
      const once = () => { if (parent.open && parent.children.length === 1) fill(parent, ray, i + 1); };
      parent.addEventListener("toggle", once);
      if (i === 0) fill(parent, ray, i + 1);
    }
  });
}

function result(ray) {
  return ray.hit ? `hit at ${number(ray.hit.distance)}` : "no hit";
}

function fill(parent, ray, index) {
  const at = (list) => `(${list.map(number).join(", ")})`;
  const range = ray.range.map((end) => end === null ? "∞" : number(end)).join(" to ");
  parent.append(element("p", {}, `From ${at(ray.origin)} in direction ${at(ray.dir)}, range ${range}.`));
  for (const note of ray.notes) parent.append(element("p", { class: "note" }, ...prose(note)));
  const marked = ray.rows.flatMap((row, i) => row.marks.map(([rule, node]) => [i, RULES[rule](node)]));
  if (marked.length > 0) {
    const list = element("ul", { class: "marked" });
    for (const [i, text] of marked.slice(0, 20)) {
      const item = element("li", {}, element("button", { type: "button" }, `Step ${i + 1}`), `: ${text}`);
      item.firstChild.addEventListener("click", () => go(i, true));
      list.append(item);
    }
    if (marked.length > 20) list.append(element("li", {}, `and ${marked.length - 20} more`));
    parent.append(element("p", { class: "rule" }, "A correct traversal does not do this:"), list);
  }
  if (ray.rows.length === 0) return;

  const slider = element("input", { type: "range", min: 0, max: ray.rows.length, value: 0, "aria-label": `Step of ray ${index}` });
  const button = (text, label, step) => {
    const made = element("button", { type: "button", "aria-label": label }, text);
    made.addEventListener("click", () => go(step(), true));
    return made;
  };
  const count = element("output", {});
  parent.append(element("div", { class: "steps" },
    button("|◀", "First step", () => 0), button("◀", "Step back", () => now - 1),
    button("▶", "Step forward", () => now + 1), button("▶|", "All steps", () => ray.rows.length),
    slider, count));
  const body = element("tbody", {});
  const table = element("table", {},
    element("caption", { class: "note" }, "The tests, in order"),
    element("thead", {}, element("tr", {}, ...["step", "test", "result", "closest hit"].map((text) =>
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
    count.textContent = row ? `step ${now + 1} of ${ray.rows.length}: ${subject(row)}: ${outcomeOf(row)}`
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
  // The closest hit after this test, so a nearer one may have been found before the node's turn.
  const isLater = row.outcome === "skipped_beyond" && !(row.closest !== null && row.closest < row.at[0]);
  const text = isLater ? "hit from AT: put off, then not entered, since a hit before it was found" : OUTCOMES[row.outcome];
  return text.replace("AT", row.at.map(number).join(" to "));
}

function subject(row) {
  if (!row.is_box) return `${row.triangle ? "triangle" : "sphere"} ${row.shape}`;
  if (row.nodes.length === 0) return "a box that is not in the tree";
  const list = row.nodes.length > 4 ? [...row.nodes.slice(0, 4), "…"] : row.nodes;
  return (row.nodes.length > 1 ? `one of the nodes ${list.join(", ")}` : `node ${row.nodes[0]}`)
    + ` (level ${row.level})`;
}

function tableRow(row, i, go) {
  const step = element("button", { type: "button", "aria-label": `Show step ${i + 1}` }, String(i + 1));
  step.addEventListener("click", () => go(i, false));
  const outcome = element("td", {}, outcomeOf(row));
  if (row.again) outcome.append(element("span", {}, " (tested before)"));
  for (const [rule, node] of row.marks) outcome.append(element("span", { class: "rule" }, `✗ ${RULES[rule](node)}`));
  const inLeaf = !row.is_box && row.nodes.length > 0 ? `, in leaf ${row.nodes[0]}` : "";
  return element("tr", row.marks.length > 0 ? { class: "mark" } : {},
    element("td", {}, step), element("td", {}, subject(row) + inLeaf), outcome,
    element("td", {}, row.closest === null ? "none" : number(row.closest)));
}

/** Returns the lines for all tests up to a step, which is emphasised. */
function lines(ray, step) {
  const all = [];
  const start = Math.max(0, step - 150);
  ray.rows.slice(start, step + 1).forEach((row, i) => {
    const isNow = start + i === step;
    const style = { colour: row.marks.length > 0 ? COLOURS.bad : COLOUR_OF[row.outcome], width: isNow ? 3 : 1 };
    // Of earlier boxes, only the entered ones stay, and of earlier primitives, those that are hit.
    if (!isNow && row.outcome !== "entered" && row.outcome !== "closest" && row.marks.length === 0) return;
    if (row.triangle) all.push({ points: [...row.triangle, row.triangle[0]], fill: true, ...style });
    else if (row.corners) all.push(...boxLines(...row.corners, style));
  });
  all.push(rayLine(ray, 2.5));
  return all;
}

/** Returns the line from the start of a ray to its hit. It is dashed if there is none. */
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
