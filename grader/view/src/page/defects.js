// The defects of the tree: a list, and boxes over the picture.
import { boxLines, COLOURS, setLines } from "./overlay.js";
import { element, number } from "./main.js";

const list = document.getElementById("defects");

/** Returns the sentence about the cost of a checked tree. */
export function costOf({ cost, ratio }) {
  if (cost === null) return "no SAH cost, because the tree does not contain each primitive exactly once.";
  const best = ratio === null ? "" : `, ${ratio.toFixed(2)} × the cost with the best split at every node`;
  return `SAH cost ${number(cost)} (the expected number of tests per ray)${best}.`;
}

/** Lists and draws all defects of a checked tree, if there is one. `goTo` shows a node. */
export function showDefects(checkup, goTo) {
  const kinds = checkup?.kinds ?? [];
  const all = kinds.flatMap((kind) => kind.defects);
  draw(all);
  list.hidden = kinds.length === 0;
  if (list.hidden) {
    list.replaceChildren();
    return;
  }
  const isDrawn = element("input", { type: "checkbox", checked: "" });
  isDrawn.addEventListener("change", () => draw(isDrawn.checked ? all : []));
  list.replaceChildren(
    element("h3", { class: "rule" }, "Defects in the tree"),
    element("p", {}, element("label", {}, isDrawn, " Draw their boxes over the picture"), ": your boxes in red, the correct ones dashed."),
    ...kinds.map((kind, i) => element("details", i === 0 ? { open: "" } : {},
      element("summary", {}, `${kind.title}: ${kind.count.toLocaleString("en")}`),
      element("ul", {}, ...kind.defects.map(item),
        ...(kind.count > kind.defects.length ? [element("li", {}, `and ${(kind.count - kind.defects.length).toLocaleString("en")} more`)] : [])))));

  function item(defect) {
    const button = element("button", { type: "button" }, "Show");
    button.setAttribute("aria-label", `Show: ${defect.text}`);
    button.addEventListener("click", () => {
      isDrawn.checked = true;
      draw([defect], 3);
      if (defect.node !== null) goTo(defect.node);
    });
    return element("li", {}, button, ` ${defect.text}`);
  }
}

function draw(defects, width = 1.5) {
  setLines("defects", defects.flatMap(({ corners, tight }) => [
    ...(tight ? boxLines(...tight, { colour: COLOURS.bad, width, dash: [5, 4] }) : []),
    ...(corners ? boxLines(...corners, { colour: COLOURS.bad, width }) : [])]));
}
