// SPDX-License-Identifier: Apache-2.0
// Do the figures agree with what they state? Fits, sums, defects and percentiles are derived again from their numbers.

// Numbers that this script computes another way than the program: sums of no more than a million terms.
const ROUNDING = 1e-9;

function closeTo(a, b, scale) { return typeof a === "number" && Math.abs(a - b) <= ROUNDING * Math.max(Math.abs(b), scale || 0); }
function isNumbers(list) { return Array.isArray(list) && list.every(function (v) { return typeof v === "number" && isFinite(v); }); }

function unpack(text, Kind) {
  const bytes = Uint8Array.from(atob(text), function (c) { return c.charCodeAt(0); });
  return new Kind(bytes.buffer);
}

// A long list of a figure, unpacked once.
const unpacked = new WeakMap();
function listOf(figure, name) {
  if (!unpacked.has(figure)) unpacked.set(figure, {});
  const known = unpacked.get(figure);
  if (!known[name]) known[name] = unpack(figure[name], name.startsWith("f64") ? Float64Array : Float32Array);
  return known[name];
}

function fittedSlope(figure) {
  let x = 0, y = 0, xx = 0, xy = 0;
  figure.sizes.forEach(function (size, i) {
    const a = Math.log10(size), b = Math.log10(figure.errors[i]);
    x += a; y += b; xx += a * a; xy += a * b;
  });
  const n = figure.sizes.length;
  return (n * xy - x * y) / (n * xx - x * x);
}

function checkConvergence(f, say) {
  if (!isText(f.size_name)) say("does not name its sizes");
  const positive = function (list) { return isNumbers(list) && list.length > 1 && list.every(function (v) { return v > 0; }); };
  if (!positive(f.sizes) || !positive(f.errors) || f.sizes.length !== f.errors.length) return say("has no points");
  for (let i = 1; i < f.sizes.length; ++i) if (!(f.sizes[i] < f.sizes[i - 1])) say("sizes do not fall");
  const slope = fittedSlope(f);
  if (!closeTo(f.fitted, slope)) say("states the slope " + f.fitted + ", its points have " + slope);
  const offsets = f.sizes.map(function (size, i) { return Math.log10(f.errors[i]) - slope * Math.log10(size); });
  const mean = offsets.reduce(function (a, b) { return a + b; }, 0) / offsets.length;
  const misfit = offsets.reduce(function (a, b) { return Math.max(a, Math.abs(b - mean)); }, 0);
  if (!(typeof f.misfit === "number" && Math.abs(f.misfit - misfit) <= ROUNDING)) say("states another distance from its line");
  if (!(f.tolerance > 0 && f.tolerance < 1)) say("no tolerance of the slope");
  if (!(Math.abs(slope - f.expected) <= f.tolerance)) say("its slope is not the expected one");
}

function checkHistogram(f, say) {
  if (!isText(f.unit) || !(f.width > 0)) say("names no unit");
  if (!Array.isArray(f.counts) || f.counts.length === 0 || !f.counts.every(isCount)) return say("has no counts");
  if (f.counts.reduce(function (a, b) { return a + b; }, 0) !== f.total) say("its counts do not sum to their total");
  let last = f.counts.length - 1;
  while (last > 0 && f.counts[last] === 0) --last;
  if (!(f.worst >= 0) || Math.min(Math.floor(f.worst / f.width), f.counts.length - 1) !== last) say("its worst error lies in another bin");
}

function checkWorst(f, report, say) {
  if (!/^etendue(-validate)? [\w. -]+$/.test(f.command)) say("has no command");
  const test = report.tests.find(function (t) { return t.test === f.test; });
  const known = test && test.evidence.some(function (e) { return typeof f.share === "number" && closeTo(f.share, e.worst_share); });
  if (!known) say("its share is not that of its test");
}

function defectsOf(f) {
  const n = f.areas.length, factors = listOf(f, "f64_factors"), bounds = listOf(f, "f64_bounds"), sums = [];
  const found = { closure: 0, reciprocity: 0, widest: 0, outside: 0, unequal: 0, open: 0, sums: sums };
  const covered = new Set(f.covered);
  for (let i = 0; i < n; ++i) {
    let sum = 0, slack = n * n * Number.EPSILON;
    for (let j = 0; j < n; ++j) {
      const factor = factors[i * n + j], bound = bounds[i * n + j];
      if (!(factor >= 0 && factor <= 1 && bound >= 0 && bound <= 1)) ++found.outside;
      sum += factor;
      slack += bound;
      const gap = Math.abs(f.areas[i] * factor - f.areas[j] * factors[j * n + i]);
      found.reciprocity = Math.max(found.reciprocity, gap);
      if (!(gap <= f.areas[i] * bound + f.areas[j] * bounds[j * n + i] + 8 * Number.EPSILON * f.areas[i])) ++found.unequal;
      found.widest = Math.max(found.widest, bound);
    }
    sums.push(sum);
    if (covered.has(i)) continue;
    found.closure = Math.max(found.closure, Math.abs(1 - sum));
    if (!(Math.abs(1 - sum) <= slack)) ++found.open;
  }
  return found;
}

function checkFactors(f, say) {
  if (!isNumbers(f.areas) || f.areas.length === 0 || f.areas.some(function (a) { return !(a > 0); })) return say("has no areas");
  const n = f.areas.length;
  if (!Array.isArray(f.covered) || !f.covered.every(function (i) { return isCount(i) && i < n; })) return say("its covered rows are missing");
  if (listOf(f, "f64_factors").length !== n * n || listOf(f, "f64_bounds").length !== n * n) return say("is not a matrix of its size");
  const d = defectsOf(f), factors = listOf(f, "f64_factors"), bounds = listOf(f, "f64_bounds");
  for (const i of f.covered)
    if (factors.slice(i * n, i * n + n).some(function (v, j) { return v > bounds[i * n + j]; })) say("a covered row sees something");
  if (d.outside) say(d.outside + " factors or bounds are not between 0 and 1");
  if (d.unequal) say(d.unequal + " pairs are not reciprocal within their bounds");
  if (d.open) say(d.open + " rows do not sum to 1 within their bounds");
  if (!(typeof f.closure === "number" && Math.abs(f.closure - d.closure) <= n * n * Number.EPSILON)) say("states another defect of closure");
  if (!(typeof f.reciprocity === "number" && Math.abs(f.reciprocity - d.reciprocity) <= 8 * Number.EPSILON * Math.max(...f.areas)))
    say("states another defect of reciprocity");
  if (!closeTo(f.widest, d.widest)) say("states another widest bound");
}

function areaOf(f) {
  const corners = listOf(f, "f64_corners");
  let area = 0, first = 0;
  for (const size of f.sizes) {
    const sum = [0, 0, 0];
    for (let k = 0; k < size; ++k) {
      const a = 3 * (first + k), b = 3 * (first + (k + 1) % size);
      for (const c of [0, 1, 2]) sum[c] += corners[a + (c + 1) % 3] * corners[b + (c + 2) % 3] - corners[a + (c + 2) % 3] * corners[b + (c + 1) % 3];
    }
    area += Math.hypot(...sum) / 2;
    first += size;
  }
  return area;
}

function checkRadiosity(f, say) {
  const values = listOf(f, "f64_radiosity"), corners = listOf(f, "f64_corners");
  if (!Array.isArray(f.sizes) || !f.sizes.every(function (n) { return isCount(n) && n >= 3; })) return say("has no elements");
  if (values.length !== 3 * f.sizes.length) say("has not one radiosity an element and channel");
  if (corners.length !== 3 * f.sizes.reduce(function (a, b) { return a + b; }, 0)) say("its corners do not fit its elements");
  if (!corners.every(isFinite) || !values.every(function (v) { return v >= 0 && isFinite(v); })) say("holds what is no radiosity or place");
  if (!closeTo(f.sum, values.reduce(function (a, b) { return a + b; }, 0))) say("its radiosities have another sum");
  if (!closeTo(f.brightest, values.reduce(function (a, b) { return Math.max(a, b); }, 0))) say("its brightest element is another");
  if (!closeTo(f.area, areaOf(f))) say("its elements have another area");
  if (!isNumbers(f.residuals) || f.residuals.length < 2 || !f.residuals.every(function (r) { return r > 0; })) say("has no residuals");
  else if (!(f.contraction > 0 && f.contraction < 1)) say("its steps do not contract");
  else for (let i = 1; i < f.residuals.length; ++i)
    if (!(f.residuals[i] <= f.contraction * f.residuals[i - 1] * (1 + ROUNDING))) say("its residual falls too slowly in step " + (i + 1));
  if (!isNumbers(f.residuals) || !closeTo(f.reduction, f.residuals[f.residuals.length - 1] / f.residuals[0])) say("states another reduction");
  if (!isNumbers(f.eye) || f.eye.length !== 3 || !isNumbers(f.gaze) || !closeTo(Math.hypot(...f.gaze), 1)) say("has no place to look from");
  if (!Array.isArray(f.balance) || f.balance.length !== 3) return say("has no balance of three channels");
  let emitted = 0;
  for (const b of f.balance) {
    if (!b || !isNumbers([b.emitted, b.absorbed, b.escaped, b.tolerance])) { say("a channel has no balance"); continue; }
    emitted += b.emitted;
    if (!(Math.abs(b.emitted - b.absorbed - b.escaped) <= b.tolerance && b.tolerance <= ROUNDING * b.emitted)) say("power is lost or made");
  }
  if (!closeTo(f.emitted, emitted)) say("emits another power");
}

function imageErrors(f) {
  const reference = listOf(f, "f32_reference"), difference = listOf(f, "f32_difference");
  const found = { nan: 0, infinite: 0, worst: 0, column: 0, row: 0, mean: 0 }, each = [];
  for (let k = 0; k < difference.length; k += 3) {
    let worst = 0;
    for (let c = k; c < k + 3; ++c) {
      if (Number.isNaN(difference[c]) || Number.isNaN(reference[c])) ++found.nan;
      else if (!isFinite(difference[c]) || !isFinite(reference[c])) ++found.infinite;
      else worst = Math.max(worst, Math.abs(difference[c]));
    }
    if (k === 0 || worst > found.worst) { found.worst = worst; found.column = k / 3 % f.columns; found.row = Math.floor(k / 3 / f.columns); }
    each.push(worst);
    found.mean += worst;
  }
  found.mean /= each.length;
  each.sort(function (a, b) { return a - b; });
  const at = function (p) { return each[Math.floor((each.length - 1) * p / 100)]; };
  found.median = at(50); found.p95 = at(95); found.p99 = at(99);
  return found;
}

function checkImages(f, say) {
  const near = function (a, b) { return typeof a === "number" && Math.abs(a - b) <= ROUNDING * Math.abs(b); };
  if (!isCount(f.columns) || !isCount(f.rows) || f.columns * f.rows === 0) return say("has no size");
  const pixels = f.columns * f.rows, flip = listOf(f, "f32_flip");
  if (listOf(f, "f32_reference").length !== 3 * pixels || listOf(f, "f32_difference").length !== 3 * pixels || flip.length !== pixels)
    return say("its pixels are not those of its size");
  const e = imageErrors(f);
  for (const key of ["mean", "median", "p95", "p99", "worst"]) if (!near(f[key], e[key])) say("states another difference: " + key);
  if (f.worst_column !== e.column || f.worst_row !== e.row) say("its worst pixel is another");
  if (f.nan !== e.nan || f.infinite !== e.infinite) say("counts other NaN or infinities");
  if (e.nan + e.infinite > 0) say("has pixels that are no numbers");
  if (!(f.tolerance >= 0 && e.worst <= f.tolerance * (1 + 2e-7))) say("differs by more than its tolerance");
  if (!near(f.share, e.worst === 0 ? 0 : e.worst / f.tolerance)) say("states another share of its tolerance");
  const brightness = listOf(f, "f32_reference").reduce(function (a, b) { return a + b; }, 0) / (3 * pixels);
  if (e.nan + e.infinite === 0 && !near(f.brightness, brightness)) say("its reference has another brightness");
  if (flip.some(function (v) { return !(v >= 0 && v <= 1); })) say("its ꟻLIP is not between 0 and 1");
  if (!near(f.flip_mean, flip.reduce(function (a, b) { return a + b; }, 0) / pixels)) say("states another mean of ꟻLIP");
  if (!near(f.flip_worst, flip.reduce(function (a, b) { return Math.max(a, b); }, 0))) say("states another largest ꟻLIP");
}

const FIGURE_CHECKS = { convergence: checkConvergence, histogram: checkHistogram, factors: checkFactors, radiosity: checkRadiosity, images: checkImages };

function checkFigures(report, say) {
  if (!Array.isArray(report.figures)) return say("the figures are missing");
  report.figures.forEach(function (figure, k) {
    const name = "figure " + k + (figure && isText(figure.title) ? " (" + figure.title + ")" : "");
    const sayOf = function (text) { say(name + ": " + text); };
    if (!figure || !isText(figure.title)) return sayOf("has no title");
    const test = report.tests.find(function (t) { return t.test === figure.test; });
    if (!test || test.outcome !== "passed") sayOf("comes from no test that passed");
    try {
      if (figure.kind === "worst") checkWorst(figure, report, sayOf);
      else if (FIGURE_CHECKS[figure.kind]) FIGURE_CHECKS[figure.kind](figure, sayOf);
      else sayOf("is of no known kind");
    } catch (error) {
      sayOf("cannot be read: " + error.message);
    }
  });
}

const VERDICTS = ["FAILED", "NOT PROVED", "not run", "open", "open, in part", "not testable", "not there", "verified", "refuted", "proved"];

function checkHistory(report, say) {
  const history = report.history;
  if (!history || !Array.isArray(history.runs) || !Array.isArray(history.changes)) return say("the history is missing");
  let before = "";
  for (const run of history.runs) {
    if (!run || !/^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$/.test(run.date) || !isText(run.version)) { say("an earlier run has no date or version"); continue; }
    if (run.date < before) say("earlier runs are not in order");
    before = run.date;
    for (const key of ["tests_passed", "tests_failed", "claims_verified", "claims_refuted", "claims_open", "other_problems", "rows"])
      if (!isCount(run[key])) say("an earlier run does not say its " + key);
    if (!(run.duration_seconds >= 0) || typeof run.ok !== "boolean") say("an earlier run has no duration or outcome");
    if (run.ok !== (run.tests_failed + run.other_problems === 0)) say("an earlier run succeeded with failures, or failed without");
  }
  for (const change of history.changes) {
    const row = change && report.claims.concat(report.errata).find(function (r) { return r.id === change.id; });
    if (!row || row.verdict !== change.now || change.then === change.now || !VERDICTS.includes(change.then)) say("a change of verdict is none");
  }
}
