// SPDX-License-Identifier: Apache-2.0
// A picture beside what it should be: both, their signed relative difference, and what a person sees of it.

const VIEWS = ["ours", "reference", "signed relative difference", "ꟻLIP"];

// Of a channel's value at 1: ours − reference, as a share of the larger of the reference and of the picture's mean.
function relativeDifference(f, k) {
  const reference = listOf(f, "f32_reference"), difference = listOf(f, "f32_difference");
  let strongest = 0;
  for (let c = k; c < k + 3; ++c) {
    const share = difference[c] / Math.max(Math.abs(reference[c]), 1e-3);
    if (Math.abs(share) > Math.abs(strongest)) strongest = share;
  }
  return strongest;
}

function imageColour(f, view, gain, column, row) {
  const k = 3 * (row * f.columns + column), reference = listOf(f, "f32_reference"), difference = listOf(f, "f32_difference");
  if (view === "ꟻLIP") return rampColour(listOf(f, "f32_flip")[k / 3]);
  if (view === "signed relative difference") return signedColour(relativeDifference(f, k) * gain);
  return [0, 1, 2].map(function (c) { return shownByte(gain * (reference[k + c] + (view === "ours" ? difference[k + c] : 0))); });
}

function drawImages(f, article) {
  const stage = article.querySelector(".stage"), tools = makeTools(stage);
  stage.classList.remove("pair");
  const canvas = makeCanvas(stage, f.columns, f.rows, "Picture of " + f.columns + " by " + f.rows + " pixels; arrow keys walk from pixel to pixel");
  const select = makeSelect(tools, "Show", VIEWS), readout = makeReadout(stage);
  const exposure = makeSlider(tools, "Exposure, in stops", -8, 8, 0);
  // A difference is shown so that the largest is full colour at exposure 0.
  let largest = 0;
  for (let k = 0; k < 3 * f.columns * f.rows; k += 3) largest = Math.max(largest, Math.abs(relativeDifference(f, k)));
  const show = function () {
    const full = select.value === "signed relative difference" && largest > 0 ? 1 / largest : 1;
    const gain = full * Math.pow(2, Number(exposure.value));
    paint(canvas, function (column, row) { return imageColour(f, select.value, gain, column, row); });
    exposure.setAttribute("aria-valuetext", exposure.value + " stops");
  };
  select.addEventListener("change", show);
  exposure.addEventListener("input", show);
  const go = followCells(canvas, [f.worst_column, f.worst_row], function (column, row) {
    const k = 3 * (row * f.columns + column), reference = listOf(f, "f32_reference"), difference = listOf(f, "f32_difference");
    const three = function (of) { return [0, 1, 2].map(of).join(" "); };
    readout.textContent = "Column " + column + ", row " + row + ": reference " + three(function (c) { return reference[k + c].toPrecision(7); }) +
      ", ours differs by " + three(function (c) { return difference[k + c].toExponential(2); }) + ", ꟻLIP " + listOf(f, "f32_flip")[k / 3].toPrecision(3);
  });
  makeControl("button", "Worst pixel", tools).addEventListener("click", function () { go(f.worst_column, f.worst_row); });
  show();
}
