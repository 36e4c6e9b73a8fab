// Turns file names in texts into links that open the editor at the right line.

let sources = null;

/** Sets where the submission's files are, or null if they cannot be opened. */
export function setSources(found) {
  sources = found;
}

/** Converts a text to nodes. Code in backticks and file names with line numbers are marked up. */
export function linked(text) {
  const parts = text.split("`");
  return parts.flatMap((part, i) => {
    if (i % 2 === 0) return withLinks(part);
    const code = document.createElement("code");
    code.append(...withLinks(part));
    return [code];
  });
}

/** Converts a text to nodes with links, but without code. */
export function withLinks(text) {
  if (!sources) return [text];
  const names = sources.files.map((name) => name.replaceAll(".", "\\.")).join("|");
  // A name that is part of a longer path refers to a different file.
  const mention = new RegExp(`(?<![\\w./\\\\-])(${names}):(\\d+)(?::(\\d+))?`, "g");
  const nodes = [];
  let end = 0;
  for (const found of text.matchAll(mention)) {
    nodes.push(text.slice(end, found.index), link(found));
    end = found.index + found[0].length;
  }
  return [...nodes, text.slice(end)].filter((node) => node !== "");
}

function link([mention, file, line, column]) {
  const path = encodeURI(sources.folder + file).replaceAll("#", "%23").replaceAll("?", "%3F");
  const made = document.createElement("a");
  made.href = `${sources.editor}${path}:${line}:${column ?? 1}`;
  made.textContent = sources.shown + mention;
  return made;
}
