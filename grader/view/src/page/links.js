// Turns file names in texts into links that open the editor at the right line.

let sources = [];

/** Sets where the files of both parts are. Files that cannot be opened are left out. */
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
  if (sources.length === 0) return [text];
  const files = sources.flatMap((source) => source.files);
  const names = files.map((name) => name.replaceAll(".", "\\.")).join("|");
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
  const source = sources.find(({ files }) => files.includes(file));
  const path = encodeURI(source.folder + file).replaceAll("#", "%23").replaceAll("?", "%3F");
  const made = document.createElement("a");
  made.href = `${source.editor}${path}:${line}:${column ?? 1}`;
  made.textContent = source.shown + mention;
  return made;
}
