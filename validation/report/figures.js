// SPDX-License-Identifier: Apache-2.0
// Makes the figures lively: each stands in the page already, as a drawing or a picture with its numbers.

function copyButtons() {
  for (const code of document.querySelectorAll("code.copy")) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = "Copy";
    button.addEventListener("click", function () {
      const range = document.createRange();
      range.selectNodeContents(code);
      getSelection().removeAllRanges();
      getSelection().addRange(range);
      button.textContent = document.execCommand("copy") ? "Copied" : "Selected";
    });
    code.after(" ", button);
  }
}

function drawFigures(report) {
  const drawers = { factors: drawMatrix, radiosity: drawRadiosity, images: drawImages };
  report.figures.forEach(function (figure, k) {
    const article = document.getElementById("figure-" + k);
    if (drawers[figure.kind]) drawers[figure.kind](figure, article);
  });
  copyButtons();
}

// Print shows what is closed.
function openForPrint() {
  let closed = [];
  window.addEventListener("beforeprint", function () {
    closed = Array.from(document.querySelectorAll("details:not([open])"));
    for (const details of closed) details.open = true;
  });
  window.addEventListener("afterprint", function () { for (const details of closed) details.open = false; });
}
