// SPDX-License-Identifier: Apache-2.0
// Colours of numbers, and controls that figures share.

// From dark blue by green to light yellow: lightness rises all the way, so that it reads in grey as well.
const RAMP = [[40, 20, 90], [45, 85, 140], [35, 140, 135], [110, 195, 90], [250, 235, 110]];

// The colour of a share from 0 to 1.
function rampColour(share) {
  const at = Math.max(0, Math.min(1, share)) * (RAMP.length - 1), i = Math.min(RAMP.length - 2, Math.floor(at));
  return [0, 1, 2].map(function (c) { return Math.round(RAMP[i][c] + (at - i) * (RAMP[i + 1][c] - RAMP[i][c])); });
}

// Red above 0, blue below, white at 0.
function signedColour(share) {
  const s = Math.max(-1, Math.min(1, share)), fade = Math.round(255 * (1 - Math.abs(s)));
  return s >= 0 ? [255 - Math.round(60 * s), fade, fade] : [fade, fade, 255 + Math.round(60 * s)];
}

// The byte of sRGB for a linear value.
function shownByte(linear) {
  const v = Math.max(0, Math.min(1, linear || 0));
  return Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * Math.pow(v, 1 / 2.4) - 0.055));
}

function makeCanvas(stage, columns, rows, label) {
  const canvas = document.createElement("canvas");
  canvas.width = columns;
  canvas.height = rows;
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-label", label);
  stage.replaceChildren(canvas);
  return canvas;
}

function paint(canvas, colourOf) {
  const context = canvas.getContext("2d"), image = context.createImageData(canvas.width, canvas.height);
  for (let row = 0, k = 0; row < canvas.height; ++row) {
    for (let column = 0; column < canvas.width; ++column, k += 4) {
      image.data.set(colourOf(column, row), k);
      image.data[k + 3] = 255;
    }
  }
  context.putImageData(image, 0, 0);
}

function makeSelect(tools, label, words) {
  const select = makeControl("select", label, tools);
  for (const word of words) select.append(new Option(word, word));
  return select;
}

function makeSlider(tools, label, low, high, value) {
  const slider = makeControl("input", label, tools);
  slider.type = "range";
  slider.min = low; slider.max = high; slider.step = 0.25; slider.value = value;
  return slider;
}

// Tells of a cell under the pointer, and of the one that arrow keys lead to.
function followCells(canvas, start, tell) {
  let at = start;
  const go = function (column, row) {
    at = [Math.max(0, Math.min(canvas.width - 1, column)), Math.max(0, Math.min(canvas.height - 1, row))];
    tell(at[0], at[1]);
  };
  canvas.addEventListener("pointermove", function (event) {
    const box = canvas.getBoundingClientRect();
    go(Math.floor((event.clientX - box.left) * canvas.width / box.width), Math.floor((event.clientY - box.top) * canvas.height / box.height));
  });
  canvas.addEventListener("keydown", function (event) {
    const step = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] }[event.key];
    if (!step) return;
    event.preventDefault();
    go(at[0] + step[0], at[1] + step[1]);
  });
  go(start[0], start[1]);
  return go;
}

// Under the stage.
function makeReadout(stage) {
  const readout = document.createElement("p");
  readout.className = "readout";
  readout.setAttribute("aria-live", "polite");
  stage.after(readout);
  return readout;
}

function makeTools(stage) {
  const tools = document.createElement("div");
  tools.className = "tools";
  stage.before(tools);
  return tools;
}
