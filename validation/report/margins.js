// SPDX-License-Identifier: Apache-2.0
// Every check at log10(error/tolerance), worst first. Arrow keys walk from point to point.

const SVG = "http://www.w3.org/2000/svg";
const PLOT = { width: 1000, height: 320, left: 60, right: 10, top: 14, bottom: 34 };

function draw(parent, name, attributes, text) {
  const node = document.createElementNS(SVG, name);
  for (const key in attributes) node.setAttribute(key, attributes[key]);
  if (text) node.textContent = text;
  parent.appendChild(node);
  return node;
}

// The checks whose share is a number above zero, worst first; those that hold exactly have no logarithm.
function inexactChecks(report) {
  const checks = [];
  for (const test of report.tests) {
    for (const e of test.evidence) {
      if (e.claims.length > 0 && e.worst_share > 0) checks.push({ test: test, evidence: e, share: e.worst_share });
    }
  }
  return checks.sort(function (a, b) { return b.share - a.share; });
}

function drawMargins(report, box) {
  const checks = inexactChecks(report);
  if (checks.length === 0) return;
  const low = Math.min(-3, Math.max(-18, Math.floor(Math.log10(checks[checks.length - 1].share))));
  const high = Math.max(0.3, Math.log10(checks[0].share) + 0.2);
  const x = function (i) { return PLOT.left + (PLOT.width - PLOT.left - PLOT.right) * (i + 0.5) / checks.length; };
  const y = function (log) { return PLOT.top + (PLOT.height - PLOT.top - PLOT.bottom) * (high - Math.max(log, low)) / (high - low); };
  const svg = draw(box, "svg", { id: "plot", viewBox: "0 0 " + PLOT.width + " " + PLOT.height, role: "application", tabindex: "0",
    "aria-label": checks.length + " checks by their worst error as a share of the tolerance, worst first; arrow keys walk from check to check" });
  const step = Math.ceil(-low / 8);
  for (let log = 0; log >= low; log -= step) {
    draw(svg, "line", { x1: PLOT.left, x2: PLOT.width - PLOT.right, y1: y(log), y2: y(log), class: log === 0 ? "limit" : "grid" });
    draw(svg, "text", { x: PLOT.left - 8, y: y(log) + 4, "text-anchor": "end" }, log === 0 ? "limit 1" : "10^" + log);
  }
  draw(svg, "text", { x: PLOT.left, y: PLOT.height - 10 }, "worst error/tolerance of each check, worst first");
  checks.forEach(function (check, i) {
    draw(svg, "circle", { cx: x(i).toFixed(2), cy: y(Math.log10(check.share)).toFixed(2), r: 3, class: check.share > 1 ? "over" : "within",
      "data-share": String(check.share), "data-test": check.test.test });
  });
  const ring = draw(svg, "circle", { r: 6, class: "chosen" });
  const readout = document.createElement("p");
  readout.id = "readout";
  readout.setAttribute("aria-live", "polite");
  box.appendChild(readout);
  let chosen = 0;
  const choose = function (i) {
    chosen = Math.max(0, Math.min(checks.length - 1, i));
    const check = checks[chosen];
    ring.setAttribute("cx", x(chosen));
    ring.setAttribute("cy", y(Math.log10(check.share)));
    readout.textContent = (chosen + 1) + " of " + checks.length + ": " + check.test.test + ", error/tolerance " + check.share.toPrecision(3) +
      " in " + check.evidence.comparisons + " comparisons; proves ";
    check.evidence.claims.forEach(function (id, k) {
      if (k > 0) readout.append(", ");
      const link = document.createElement("a");
      link.href = "#claim-" + id;
      link.textContent = id;
      readout.append(link);
    });
    if (check.test.stated) readout.append(". Tolerance: " + check.test.stated.tolerance);
  };
  svg.addEventListener("keydown", function (event) {
    const step = { ArrowRight: 1, ArrowLeft: -1, PageDown: 20, PageUp: -20, Home: -checks.length, End: checks.length }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    choose(chosen + step);
  });
  svg.addEventListener("click", function (event) {
    const bounds = svg.getBoundingClientRect();
    const at = (event.clientX - bounds.left) * PLOT.width / bounds.width - PLOT.left;
    choose(Math.floor(at / (PLOT.width - PLOT.left - PLOT.right) * checks.length));
  });
  choose(0);
}
