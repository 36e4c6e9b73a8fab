// The history of a pixel: its samples one by one, with the running mean and its standard error.
import { send } from "./server.js";
import { element, number, prose } from "./main.js";

const panel = document.getElementById("history");
const summary = document.getElementById("history-summary");
const content = document.getElementById("history-content");
const WIDTH = 360;
const HEIGHT = 110;
/** The space below the plot for the labels of the axis. */
const LABELS = 16;

/** Shows the samples of an explained pixel, or hides them if `explanation` is null. */
export function showHistory(explanation) {
  const { pixel, sample, history, history_problem: problem } = explanation ?? { history: [] };
  panel.hidden = history.length === 0 && !problem;
  if (panel.hidden) {
    content.replaceChildren();
    delete content.dataset.key;
    return;
  }
  const key = JSON.stringify([pixel, history, problem]);
  if (content.dataset.key !== key) {
    content.dataset.key = key;
    summary.textContent = history.length === 0 ? "" : `: ${meanOf(history)}`;
    content.replaceChildren(...problem ? [element("p", { class: "rule" }, ...prose(`The samples cannot be listed: ${problem}`))]
      : parts(pixel, history));
  }
  content.querySelector("[aria-current]")?.removeAttribute("aria-current");
  content.querySelector(`[data-sample="${sample}"]`)?.setAttribute("aria-current", "true");
}

/** Formats a colour. Equal channels are shown once. */
export function colour(channels, digits = 4) {
  const texts = channels.map((x) => x === null ? "NaN or ∞" : number(x, digits));
  return new Set(texts).size === 1 ? texts[0] : texts.join(", ");
}

/** Returns the mean of all samples, as a text. */
function meanOf(history) {
  const last = history.at(-1);
  const samples = history.length === 1 ? "1 sample" : `the first ${history.length} samples`;
  const error = last.standard_error === null ? "" : `, luminance ${number(last.mean_luminance, 3)} ± ${number(last.standard_error, 2)}`;
  return `mean of ${samples} ${colour(last.mean, 3)}${error}`;
}

function parts(pixel, history) {
  const body = element("tbody", {}, ...history.flatMap((row, i) => rows(pixel, row, i)));
  const head = ["path", "luminance", "mean", "variance", "σ/√n", "radiance"].map((text) => element("th", { scope: "col" }, text));
  return [
    plot(history),
    element("p", {}, "Each dot is the luminance of a sample; red rings mark samples above the top edge. The line is the running mean, and the band around it is ± σ/√n. Choose a path to see its bounces."),
    element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "The samples, in order" },
      element("table", { "aria-label": "The samples, in order" }, element("thead", {}, element("tr", {}, ...head)), body)),
  ];
}

function rows(pixel, row, i) {
  const choose = element("button", { type: "button", "aria-label": `Show path ${i + 1}` }, String(i + 1));
  choose.addEventListener("click", () => send({ pick: { pixel, sample: i } }));
  const short = (x) => x === null ? "" : number(x, 3);
  const cells = [short(row.luminance), short(row.mean_luminance), short(row.variance), short(row.standard_error), colour(row.radiance, 3)];
  const all = [element("tr", { "data-sample": i }, element("td", {}, choose), ...cells.map((text) => element("td", {}, text)))];
  if (row.problems.length > 0) {
    all.push(element("tr", { class: "mark" }, element("td", { colspan: 6, class: "rule" }, ...prose(`✗ path ${i + 1}: ${row.problems.join("; ")}`))));
  }
  return all;
}

/** Draws the running mean of the luminance with its standard error. */
function plot(history) {
  const tops = history.map((row) => row.mean_luminance + (row.standard_error ?? 0));
  const top = Math.max(...tops) * 1.1 || 1;
  const x = (i) => 4 + (WIDTH - 8) * (history.length === 1 ? 0.5 : i / (history.length - 1));
  // Bright samples are drawn at the edge. Otherwise, the mean would be a flat line.
  const y = (value) => HEIGHT - 2 - (HEIGHT - 6) * Math.min(Math.max(value / top, 0), 1);
  const points = (values) => values.map((value, i) => `${x(i).toFixed(1)},${y(value).toFixed(1)}`);
  const edge = (sign) => points(history.map((row) => row.mean_luminance + sign * (row.standard_error ?? 0)));
  const label = (at, anchor, text) => {
    const made = svg("text", { x: at, y: HEIGHT + LABELS - 4, "text-anchor": anchor });
    made.append(text);
    return made;
  };
  const description = `The running mean of the luminance and its standard error: ${meanOf(history)}`;
  return svg("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT + LABELS}`, role: "img", "aria-label": description, class: "plot" },
    svg("polygon", { class: "band", points: [...edge(1), ...edge(-1).reverse()].join(" ") }),
    svg("line", { class: "axis", x1: 0, x2: WIDTH, y1: HEIGHT, y2: HEIGHT }),
    ...history.map((row, i) => svg("circle", { class: row.luminance > top ? "beyond" : "sample", cx: x(i), cy: y(row.luminance), r: 2 })),
    svg("polyline", { class: "mean", points: points(history.map((row) => row.mean_luminance)).join(" ") }),
    label(0, "start", "1"), label(WIDTH / 2, "middle", `top edge: ${number(top, 3)}`), label(WIDTH, "end", String(history.length)));
}

function svg(name, attributes, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}
