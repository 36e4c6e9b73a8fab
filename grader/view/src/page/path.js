// One path, bounce by bounce.
import { colour } from "./history.js";
import { element, number } from "./main.js";

/** Returns the table of a path's bounces and the list of its steps. */
export function pathParts({ bounces, steps }) {
  if (bounces.length === 0) return [];
  const head = ["bounce", "surface", "throughput", "pdf", "attenuation", "light found", "direct light"];
  const table = element("table", { "aria-label": "The bounces of the path" },
    element("thead", {}, element("tr", {}, ...head.map((text) => element("th", { scope: "col" }, text)))),
    element("tbody", {}, ...bounces.flatMap(rows)));
  return [
    element("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "The bounces of the path" }, table),
    element("p", {}, "The throughput is the product of the attenuations before the bounce, without Russian roulette. "
      + "Direct light is the radiance that arrives from the sampled directions. The viewer doesn't see what your code adds to the result."),
    element("details", { class: "bounces" }, element("summary", {}, "The path, step by step"),
      element("ol", { start: 0 }, ...bounces.map((bounce, i) => item(bounce, steps.slice(bounce.first_step, bounces[i + 1]?.first_step))))),
  ];
}

function rows(bounce) {
  const { number: index, surface, throughput, found, attenuation, lights, pdf } = bounce;
  const isBlack = found.every((x) => x === 0);
  const light = isBlack ? "0" : `${colour(found)} (${bounce.is_found_counted ? "counted" : "already counted as direct light"})`;
  const direct = lights.map((light) => colour(light.radiance) + (light.pdf === null ? "" : ` (light pdf ${number(light.pdf, 3)})`));
  const density = bounce.has_pdf ? colour([pdf], 3) : attenuation ? "none" : "";
  const cells = [String(index), surface, colour(throughput, 3), density, attenuation ? colour(attenuation, 3) : "", light, direct.join("; ")];
  const row = element("tr", bounce.problems.length > 0 ? { class: "mark" } : {}, ...cells.map((text) => element("td", {}, text)));
  const problems = bounce.problems.map((text) =>
    element("tr", { class: "mark" }, element("td", { colspan: cells.length, class: "rule" }, `✗ bounce ${index}: ${text}`)));
  return [row, ...problems];
}

function item({ number: index, throughput }, steps) {
  return element("li", { value: index }, `throughput ${colour(throughput)}`,
    element("ul", {}, ...steps.map((step) => element("li", {}, step))));
}
