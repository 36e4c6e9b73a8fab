// The legend and the sums for the views that show tests and mistakes.
import { element, number, prose } from "./main.js";

const legend = document.getElementById("legend");
const sums = document.getElementById("sums");

/** For each rule, in order: the class of its colour, and what rays that break it do. */
const RULES = [
  ["missed", "enter a node even though they miss its box"],
  ["beyond", "enter a node even though its box begins beyond the closest hit"],
  ["farther", "visit the farther child first"],
];

/** Shows the legend and the sums of a state. Returns whether its view is about tests. */
export function showTests(state) {
  const isMistakes = state.view === "mistakes";
  const isShown = isMistakes || state.view === "tests";
  sums.hidden = !isShown || !state.tests;
  if (!isShown) {
    sums.replaceChildren();
    return false;
  }
  const key = JSON.stringify([state.view, state.tests]);
  if (legend.dataset.key === key && legend.children.length > 0) return true;
  legend.dataset.key = key;
  if (isMistakes) {
    legend.replaceChildren("steps that no correct traversal makes (brighter means more); ", element("span", { class: "chip none" }), " none");
  } else {
    legend.replaceChildren("tests per ray, on a logarithmic scale: 1", element("span", { class: "ramp" }), "1000 or more");
  }
  if (state.tests) sums.replaceChildren(...lines(state.tests, isMistakes).map((line) => element("li", {}, ...line)));
  return true;
}

function lines(tests, isMistakes) {
  const before = (of, format) => tests.before ? ` (before the last save: ${format(of(tests.before))})` : "";
  const mean = [`${number(tests.mean)} tests per ray on average${before((of) => of.mean, number)}`];
  const problem = tests.problem ? [prose(tests.problem)] : [];
  if (!isMistakes) return [mean, ...problem];
  if (tests.problem) return problem;
  const broken = RULES.flatMap(([name, text], i) => {
    const isWorthALine = tests.broken[i] > 0 || tests.before?.broken[i] > 0;
    return isWorthALine ? [[element("span", { class: `chip ${name}` }),
      ` ${percent(tests.broken[i])} of rays ${text}${before((of) => of.broken[i], percent)}`]] : [];
  });
  const none = tests.marked > 0 ? [] : [["No ray makes a wrong step."]];
  return [...none, ...broken, mean];
}

/** Formats a share. A share just above 0% is never shown as 0%, or one just below 100% as 100%. */
function percent(share) {
  const rounded = 100 * share;
  if (rounded > 0 && rounded < 0.1) return "less than 0.1%";
  return `${rounded > 99.9 && rounded < 100 ? 99.9 : Number(rounded.toFixed(rounded < 10 ? 1 : 0))}%`;
}
