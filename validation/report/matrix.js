// SPDX-License-Identifier: Apache-2.0
// Form factors as a map of n × n cells, beside it a strip of the rows' sums.

const FACTOR_DECADES = 6, DEFECT_DECADES = 18;

function decadesBelowOne(value, decades) { return value > 0 ? 1 + Math.log10(value) / decades : 0; }

function matrixColour(f, view, i, j) {
  const n = f.areas.length, factors = listOf(f, "f64_factors"), k = i * n + j;
  if (view === "factors") return rampColour(decadesBelowOne(factors[k], FACTOR_DECADES));
  if (view === "bounds") return rampColour(decadesBelowOne(listOf(f, "f64_bounds")[k], DEFECT_DECADES));
  return rampColour(decadesBelowOne(Math.abs(f.areas[i] * factors[k] - f.areas[j] * factors[j * n + i]), DEFECT_DECADES));
}

function sumColour(f, i) { return rampColour(decadesBelowOne(Math.abs(1 - defectsOf(f).sums[i]), DEFECT_DECADES)); }

function drawMatrix(f, article) {
  const stage = article.querySelector(".stage"), n = f.areas.length, tools = makeTools(stage);
  const canvas = makeCanvas(stage, n, n, "Map of " + n + " by " + n + " pairs; arrow keys walk from pair to pair");
  const strip = document.createElement("canvas");
  strip.className = "strip";
  strip.width = 1;
  strip.height = n;
  strip.setAttribute("role", "img");
  strip.setAttribute("aria-label", "What each row's sum misses 1 by; the readout has the numbers");
  stage.append(strip);
  const select = makeSelect(tools, "Map of", ["factors", "bounds", "reciprocity"]), readout = makeReadout(stage);
  const sums = defectsOf(f).sums;
  const colours = sums.map(function (_, i) { return sumColour(f, i); });
  paint(strip, function (_, row) { return colours[row]; });
  const show = function () {
    paint(canvas, function (column, row) { return matrixColour(f, select.value, row, column); });
    const decades = select.value === "factors" ? FACTOR_DECADES : DEFECT_DECADES;
    note.textContent = "Dark is 1e-" + decades + " and less, light is 1, by logarithm; rows shoot, columns receive. " +
      "The strip: what a row's sum misses 1 by, dark 1e-" + DEFECT_DECADES + ".";
  };
  const note = document.createElement("p");
  note.className = "note";
  stage.nextSibling.after(note);
  select.addEventListener("change", show);
  show();
  followCells(canvas, [0, 0], function (j, i) {
    const factors = listOf(f, "f64_factors"), bounds = listOf(f, "f64_bounds");
    readout.textContent = "From " + i + " to " + j + ": " + factors[i * n + j] + ", bound " + bounds[i * n + j].toPrecision(3) +
      "; back " + factors[j * n + i] + ". Row " + i + " sums to " + sums[i] + ".";
  });
}
