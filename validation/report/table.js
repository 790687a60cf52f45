// SPDX-License-Identifier: Apache-2.0
// The table of claims stands in the page without a script; this adds filter, order and CSV.

function makeControl(tag, label, tools) {
  const control = document.createElement(tag);
  if (tag === "button") {
    control.type = "button";
    control.textContent = label;
    tools.appendChild(control);
  } else {
    const frame = document.createElement("label");
    frame.append(label, control);
    tools.appendChild(frame);
  }
  return control;
}

function csvCell(text) { return /[",\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text; }

function csvOf(report) {
  const lines = [["id", "source", "verdict", "oracle", "worst_share", "comparisons", "tests"]];
  for (const row of report.claims.concat(report.errata)) {
    if (row.proofs.length === 0) lines.push([row.id, row.source, row.verdict, "", "", "", ""]);
    for (const p of row.proofs) lines.push([row.id, row.source, row.verdict, p.oracle_kind + ": " + p.oracle,
      String(p.worst_share), String(p.comparisons), p.tests.join(" ")]);
  }
  return lines.map(function (line) { return line.map(csvCell).join(","); }).join("\r\n") + "\r\n";
}

function sortRows(table, column, descending) {
  const body = table.tBodies[0];
  const key = function (row) { return row.cells[column].dataset.key || row.cells[column].textContent; };
  const order = Array.from(body.rows).sort(function (a, b) {
    const p = key(a), q = key(b);
    const difference = isNaN(p) || isNaN(q) ? p.localeCompare(q, "en", { numeric: true }) : p - q;
    return descending ? -difference : difference;
  });
  body.append(...order);
}

function enhanceTable(report, table) {
  const tools = document.createElement("div");
  tools.className = "tools";
  table.parentNode.parentNode.insertBefore(tools, table.parentNode);
  const text = makeControl("input", "Words in the row", tools);
  text.type = "search";
  const verdict = makeControl("select", "Verdict", tools);
  const rows = Array.from(table.tBodies[0].rows);
  const words = new Set(rows.map(function (row) { return row.dataset.verdict; }));
  for (const word of ["all"].concat(Array.from(words).sort())) verdict.append(new Option(word, word));
  const csv = makeControl("button", "Save as CSV", tools);
  const count = document.createElement("output");
  tools.appendChild(count);
  const apply = function () {
    const wanted = text.value.toLowerCase();
    let shown = 0;
    for (const row of rows) {
      row.hidden = !row.textContent.toLowerCase().includes(wanted) || (verdict.value !== "all" && row.dataset.verdict !== verdict.value);
      if (!row.hidden) ++shown;
    }
    count.textContent = shown + " of " + rows.length + " rows";
  };
  text.addEventListener("input", apply);
  verdict.addEventListener("change", apply);
  csv.addEventListener("click", function () {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([csvOf(report)], { type: "text/csv" }));
    link.download = "etendue-claims.csv";
    link.click();
  });
  Array.from(table.tHead.rows[0].cells).forEach(function (cell, column) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = cell.textContent;
    cell.replaceChildren(button);
    button.addEventListener("click", function () {
      const descending = cell.getAttribute("aria-sort") === "ascending";
      for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
      cell.setAttribute("aria-sort", descending ? "descending" : "ascending");
      sortRows(table, column, descending);
    });
  });
  // A deep link must find its row, whatever the filter hides.
  window.addEventListener("hashchange", function () {
    text.value = "";
    verdict.value = "all";
    apply();
    const row = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (row) row.scrollIntoView();
  });
  apply();
}

// What the page says without a script must be what the data say.
function checkStaticRows(report, say) {
  for (const row of report.claims.concat(report.errata)) {
    const shown = document.getElementById("claim-" + row.id);
    if (!shown) say(row.id + ": has no row in the table");
    else if (shown.dataset.verdict !== row.verdict) say(row.id + ": the table says " + shown.dataset.verdict + ", the data " + row.verdict);
  }
}
