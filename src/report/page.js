"use strict";
// Tables are complete without this: it lets columns be sorted and rows be filtered.
for (const table of document.querySelectorAll("table.sortable")) {
  const body = table.tBodies[0];
  const heads = [...table.tHead.rows[0].cells];
  const key = (row, column) => {
    const text = row.cells[column].textContent.trim();
    const number = Number(text.replace("\u2212", "-").replace(/\s*%.*$/, ""));
    return text !== "" && Number.isFinite(number) ? number : text;
  };
  const compare = (a, b) => {
    if (typeof a === "number" && typeof b === "number") return a - b;
    if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
    return a.localeCompare(b);
  };
  heads.forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      heads.forEach((other) => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const rows = [...body.rows].map((row) => [key(row, column), row]);
      rows.sort((a, b) => (down ? compare(b[0], a[0]) : compare(a[0], b[0])));
      body.append(...rows.map((pair) => pair[1]));
    });
  });
}
for (const table of document.querySelectorAll("table.filtered")) {
  const rows = [...table.tBodies[0].rows];
  const words = [...new Set(rows.map((row) => row.cells[0].textContent.trim()))].sort();
  const bar = document.createElement("div");
  bar.className = "filter";
  const labelled = (text, field) => {
    const label = document.createElement("label");
    label.append(text + " ", field);
    bar.append(label);
    field.addEventListener("input", show);
    return field;
  };
  const choice = document.createElement("select");
  ["all", ...words].forEach((word) => choice.add(new Option(word, word)));
  const verdict = labelled("verdict", choice);
  const search = document.createElement("input");
  search.type = "search";
  const text = labelled("text", search);
  const count = document.createElement("span");
  count.setAttribute("role", "status");
  bar.append(count);
  table.parentElement.before(bar);
  function show() {
    const wanted = text.value.toLowerCase();
    let left = 0;
    for (const row of rows) {
      const fits = verdict.value === "all" || row.cells[0].textContent.trim() === verdict.value;
      const shown = fits && row.textContent.toLowerCase().includes(wanted);
      row.classList.toggle("away", !shown);
      left += shown ? 1 : 0;
    }
    count.textContent = left + " of " + rows.length;
  }
  show();
}
