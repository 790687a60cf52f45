// SPDX-License-Identifier: Apache-2.0

function showFaults(faults) {
  document.documentElement.dataset.verdict = "bad";
  document.getElementById("verdict").textContent = "NOT VERIFIED: " + faults[0] +
    (faults.length > 1 ? ", and " + (faults.length - 1) + " more" : "");
  const list = document.createElement("ul");
  list.id = "faults";
  for (const fault of faults) {
    const item = document.createElement("li");
    item.textContent = fault;
    list.appendChild(item);
  }
  document.getElementById("verdict").after(list);
}

const holder = document.getElementById("report");
let data = null;
let found = [];
try {
  data = JSON.parse(holder.textContent);
  found = findFaults(data);
  checkStaticRows(data, function (text) { found.push(text); });
  if (fnv1a(holder.textContent) !== holder.dataset.fnv1a) found.push("the data were altered after the run");
} catch (error) {
  found.push("the data cannot be read: " + error.message);
}
if (found.length > 0) showFaults(found);
document.documentElement.dataset.faults = String(found.length);
try {
  drawMargins(data, document.getElementById("margins"));
  enhanceTable(data, document.getElementById("claims-table"));
  drawFigures(data);
  openForPrint();
} catch (error) {
  if (found.length === 0) showFaults(["the page cannot be drawn: " + error.message]);
}
