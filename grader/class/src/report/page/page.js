"use strict";
// Makes each header of a sortable table a button. Without this script, the table is in the order of
// the submissions' ids.
for (const table of document.querySelectorAll("table.sortable")) {
  const body = table.tBodies[0];
  const headers = [...table.tHead.rows[0].cells];
  headers.forEach((header, column) => {
    const button = document.createElement("button");
    button.append(...header.childNodes);
    header.append(button);
    button.addEventListener("click", () => {
      const isNumber = header.classList.contains("number");
      // Names begin with A, and points with the most.
      const first = isNumber ? "descending" : "ascending";
      const second = isNumber ? "ascending" : "descending";
      const order = header.getAttribute("aria-sort") === first ? second : first;
      headers.forEach((other) => other.removeAttribute("aria-sort"));
      header.setAttribute("aria-sort", order);
      const key = (row) => {
        const text = row.cells[column].textContent.trim();
        return isNumber ? Number.parseFloat(text) : text;
      };
      // A row without a number is last in either order.
      const isMissing = (value) => Number.isNaN(value) || value === "";
      const sign = order === "ascending" ? 1 : -1;
      const compare = (one, other) => {
        if (isMissing(one) || isMissing(other)) return isMissing(one) - isMissing(other);
        return sign * (isNumber ? one - other : one.localeCompare(other));
      };
      const rows = [...body.rows].map((row) => [key(row), row]);
      rows.sort(([one], [other]) => compare(one, other));
      body.append(...rows.map(([, row]) => row));
    });
  });
}
