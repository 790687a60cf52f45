// SPDX-License-Identifier: Apache-2.0
// Does the report agree with itself? Every verdict, total and worst share is derived again from the evidence of the tests:
// a page whose data were altered, cut or damaged must not look verified.

const OUTCOMES = ["passed", "failed", "skipped", "not run"];
const KINDS = ["identity", "closed form", "table", "exact arithmetic", "metamorphic", "statistics", "independent method",
  "known render"];
const STATED = ["open", "verified", "refuted", "proved", "not testable"];

function isCount(value) { return Number.isSafeInteger(value) && value >= 0; }
function isText(value) { return typeof value === "string" && value.length > 0; }
function isTexts(value) { return Array.isArray(value) && value.every(function (v) { return typeof v === "string"; }); }
function same(a, b) { return JSON.stringify(a) === JSON.stringify(b); }

// FNV-1a, 32 bits, of the bytes of the text: finds what was altered after the run.
function fnv1a(text) {
  let hash = 0x811c9dc5;
  for (const byte of new TextEncoder().encode(text)) hash = Math.imul(hash ^ byte, 0x01000193) >>> 0;
  return hash.toString(16).padStart(8, "0");
}

// A comparison that cannot count: nothing compared, not a number, or out of bounds.
function worthless(evidence) {
  return !(evidence.comparisons > 0) || evidence.worst_share === null || evidence.worst_share > 1;
}

function checkTest(test, ids, say) {
  const name = isText(test.test) ? test.test : "a test without a name";
  if (!/^\w+\.\w+$/.test(test.test)) say(name + ": not the name of a test");
  if (!OUTCOMES.includes(test.outcome)) say(name + ": unknown outcome");
  if (test.outcome !== "passed") say(name + ": " + test.outcome);
  if (!isTexts(test.failures)) return say(name + ": its failures are missing");
  if (test.failures.length > 0 && test.outcome === "passed") say(name + ": passed with failures");
  if (!(typeof test.duration_seconds === "number" && test.duration_seconds >= 0)) say(name + ": no duration");
  if (!Array.isArray(test.evidence)) return say(name + ": its evidence is missing");
  for (const e of test.evidence) {
    if (e === null || typeof e !== "object" || !isTexts(e.claims)) return say(name + ": does not say what it proves");
    for (const id of e.claims) if (!ids.has(id)) say(name + ": proves " + id + ", which the register does not have");
    if (e.claims.length > 0 && !KINDS.includes(e.oracle_kind)) say(name + ": unknown kind of oracle");
    if (e.claims.length > 0 && !isText(e.oracle)) say(name + ": names no oracle");
    if (!isCount(e.comparisons)) say(name + ": no number of comparisons");
    if (e.worst_share !== null && !(typeof e.worst_share === "number" && e.worst_share >= 0)) say(name + ": no worst share");
    if (!(Array.isArray(e.seeds) && e.seeds.every(function (s) { return typeof s === "number" && s >= 0; })))
      say(name + ": no list of seeds");
    if (e.claims.length > 0 && worthless(e)) say(name + ": an error exceeds its tolerance, or nothing was compared");
  }
}

function proofsOf(id, tests) {
  const proofs = [];
  for (const test of tests) {
    for (const e of test.outcome === "not run" ? [] : test.evidence) {
      if (!e.claims.includes(id)) continue;
      let proof = proofs.find(function (p) { return p.oracle_kind === e.oracle_kind; });
      if (!proof) {
        proof = { oracle_kind: e.oracle_kind, oracle: e.oracle, worst_share: 0, comparisons: 0, tests: [] };
        proofs.push(proof);
      }
      if (e.worst_share === null || proof.worst_share === null) proof.worst_share = null;
      else proof.worst_share = Math.max(proof.worst_share, e.worst_share);
      proof.comparisons += e.comparisons;
      proof.tests.push(test.test);
    }
  }
  return proofs;
}

function verdictOf(row, report) {
  let good = false;
  for (const test of report.tests) {
    for (const e of test.outcome === "not run" ? [] : test.evidence) {
      if (!e.claims.includes(row.id)) continue;
      if (test.outcome !== "passed" || worthless(e)) return "FAILED";
      good = true;
    }
  }
  if (row.register === "not testable") return good ? "NOT PROVED" : "not testable";
  if (row.register === "open") return good ? "open, in part" : "open";
  if (good) return row.register;
  return report.full_run ? "NOT PROVED" : "not run";
}

function checkRow(row, report, errata, say, isClaim) {
  const id = isText(row.id) ? row.id : "a row without an id";
  if (!isText(row.id)) say(id);
  if (!isText(row.source)) say(id + ": names no source");
  if (!STATED.includes(row.register)) say(id + ": the register has no such verdict");
  const verdict = verdictOf(row, report);
  if (row.verdict !== verdict) say(id + ": called " + row.verdict + ", but the tests say " + verdict);
  if (verdict === "FAILED" || verdict === "NOT PROVED") say(id + ": " + verdict);
  if (!same(row.proofs, proofsOf(row.id, report.tests))) say(id + ": its proofs are not what the tests left behind");
  if (isClaim && !isTexts(row.errata)) say(id + ": its list of errata is missing");
  else if (isClaim)
    for (const erratum of row.errata) if (!errata.has(erratum)) say(id + ": names the erratum " + erratum + ", which is not there");
  if (isClaim && row.register === "not testable" && !isText(row.reason)) say(id + ": is called not testable, without a reason");
  if (isClaim && !isText(row.statement)) say(id + ": states nothing");
}

function totalsOf(report) {
  const tests = function (outcomes) { return report.tests.filter(function (t) { return outcomes.includes(t.outcome); }).length; };
  const rows = function (list, verdict) { return list.filter(function (r) { return r.verdict === verdict; }).length; };
  return { tests_passed: tests(["passed"]), tests_failed: tests(["failed", "skipped"]), tests_not_run: tests(["not run"]),
    claims_verified: rows(report.claims, "verified"), claims_refuted: rows(report.claims, "refuted"),
    claims_open: report.claims.filter(function (r) { return r.register === "open"; }).length,
    claims_not_testable: rows(report.claims, "not testable"),
    errata_proved: rows(report.errata, "proved") };
}

function findFaults(report) {
  const faults = [];
  const say = function (text) { faults.push(text); };
  if (report.schema !== "etendue-validation-report/1") say("unknown schema");
  for (const key of ["version", "compiler", "build_type", "fp_contract"])
    if (!report.build || !isText(report.build[key])) say("the build does not say its " + key);
  if (!/^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$/.test(report.date)) say("no date");
  if (!(typeof report.duration_seconds === "number" && report.duration_seconds >= 0)) say("no duration");
  for (const key of ["full_run", "stopped", "ok"]) if (typeof report[key] !== "boolean") say(key + " is missing");
  for (const key of ["tests", "claims", "errata", "problems"])
    if (!Array.isArray(report[key])) { say(key + " are missing"); return faults; }
  if (report.build && report.build.fp_contract !== "off") say("built with contraction of floating-point operations");
  if (report.stopped) say("the run was stopped");
  if (!report.ok) say("the run did not succeed");
  if (report.tests.length === 0) say("no test ran");
  for (const problem of report.problems) say(String(problem));
  const rows = report.claims.concat(report.errata);
  const ids = new Set(rows.map(function (r) { return r.id; }));
  if (ids.size !== rows.length) say("an id stands twice in the register");
  const names = new Set(report.tests.map(function (t) { return t.test; }));
  if (names.size !== report.tests.length) say("a test stands twice");
  for (const test of report.tests) checkTest(test, ids, say);
  if (report.tests.some(function (t) { return !Array.isArray(t.evidence) || !t.evidence.every(function (e) { return e && isTexts(e.claims); }); }))
    return faults;
  const errata = new Set(report.errata.map(function (r) { return r.id; }));
  for (const row of rows) checkRow(row, report, errata, say, report.claims.includes(row));
  checkFigures(report, say);
  checkHistory(report, say);
  if (!same(report.totals, totalsOf(report))) say("the totals are not the sums of the rows");
  return faults;
}
