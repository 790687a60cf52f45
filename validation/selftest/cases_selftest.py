#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Judges the cases of `etendue-validate grade`: each fits its schema, has two truths of different kinds that overlap, both far narrower
than its tolerance, and is what its generator writes. Shows first that the schema and the comparison see what is wrong."""
import copy
import json
import pathlib
import subprocess
import sys
import tempfile

import jsonschema

sys.dont_write_bytecode = True
from demand import complaints, demand  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASES = ROOT / "validation/cases"
MAKE = ROOT / "validation/reference/grade_cases/make.py"
NARROW = 1 / 50  # of the tolerance: an enclosure's width hardly moves a verdict
SUBJECTS = {"form factors": 30, "radiosity": 30, "refraction": 30, "intersections": 30, "images": 25}


def ends(truth):
    low, high = truth["low"], truth["high"]
    return list(zip(low, high)) if isinstance(low, list) else [(low, high)]


def unlike(case):
    """What is wrong with the two truths of a case."""
    one, two, most = case["truth"], case["second"], NARROW * case["tolerance"]["value"]
    if "none" in one or "none" in two:
        return [] if "none" in one and "none" in two else ["one truth is none"]
    wrong = [] if one["kind"] != two["kind"] or one["derivation"] != two["derivation"] else ["both truths are one"]
    if len(ends(one)) != len(ends(two)):
        return ["truths of different shapes"]
    for (a, b), (c, d) in zip(ends(one), ends(two)):
        wrong += ["the truths do not overlap"] * (max(a, c) > min(b, d)) + ["an enclosure is wide"] * (max(b - a, d - c) > most)
    return wrong


def check(validator, files):
    findings = []
    for path in files:
        case = json.loads(path.read_text(encoding="utf-8"))
        findings += [f"{path.name}: {e.message[:120]}" for e in validator.iter_errors(case)]
        findings += [f"{path.name}: {w}" for w in unlike(case)]
        if case["id"] + ".json" != path.relative_to(CASES).as_posix():
            findings.append(f"{path.name}: called {case['id']}")
    return findings


def planted(validator, case):
    """Faults that must be seen: by the schema, then by the comparison of truths."""
    def changed(change):
        other = copy.deepcopy(case)
        change(other)
        return other
    schema_faults = {
        "no second truth": lambda c: c.pop("second"), "a text as a bound": lambda c: c["truth"].update(low="0"),
        "an unknown key": lambda c: c.update(answer=1), "an unknown question": lambda c: c["question"].update(kind="colour"),
        "a tolerance of nothing": lambda c: c["tolerance"].update(value=0),
                     "a tolerance from nowhere": lambda c: c["tolerance"].pop("from"),
        "an unknown kind of truth": lambda c: c["second"].update(kind="a guess"),
                     "both none and numbers": lambda c: c["truth"].update(none=True),
        "a truth without derivation": lambda c: c["truth"].pop("derivation"), "no provenance": lambda c: c.pop("provenance")}
    for name, change in schema_faults.items():
        demand(f"the schema sees {name}", not validator.is_valid(changed(change)))
    low, high = case["truth"]["low"], case["truth"]["high"]
    most = case["tolerance"]["value"]
    for name, change in {"truths apart": lambda c: c["second"].update(low=high + most, high=high + most),
                         "a wide enclosure": lambda c: c["truth"].update(low=low - most),
                         "one truth given twice": lambda c: c.update(second=c["truth"]),
                         "one truth that is none": lambda c: c.update(second={"none": True})}.items():
        demand(f"the comparison sees {name}", bool(unlike(changed(change))))


def rewritten():
    """The generator's own output, and that --check sees a changed number."""
    with tempfile.TemporaryDirectory() as folder:
        made = subprocess.run([sys.executable, MAKE, folder], capture_output=True, text=True, check=False)
        demand("the generator runs", made.returncode == 0, made.stderr)
        theirs = {p.relative_to(folder).as_posix(): json.loads(p.read_text()) for p in pathlib.Path(folder).glob("*/*.json")}
    ours = {p.relative_to(CASES).as_posix(): json.loads(p.read_text()) for p in CASES.glob("*/*.json")}
    demand("the generator writes these cases and no other", theirs.keys() == ours.keys(), str(theirs.keys() ^ ours.keys())[:300])
    different = [n for n in theirs.keys() & ours.keys() if not same(theirs[n], ours[n])]
    demand("each is what it writes", not different, " ".join(different[:5]))


def same(a, b):
    """All but quadratures are exact; those are sums of the C library's functions, which may round otherwise elsewhere."""
    quadrature = [t["kind"] == "independent quadrature" or "quadrature" in t["derivation"] for t in (a["second"], b["second"])]
    if all(quadrature) and len(ends(a["second"])) == len(ends(b["second"])):
        slack = NARROW * a["tolerance"]["value"]
        if any(abs(x - y) > slack for p, q in zip(ends(a["second"]), ends(b["second"])) for x, y in zip(p, q)):
            return False
        a, b = ({**c, "second": {**c["second"], "low": 0, "high": 0}} for c in (a, b))
    return a == b


def main():
    schema = json.loads((CASES / "case.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.Draft202012Validator.check_schema(json.loads((CASES / "answer.schema.json").read_text()))
    validator = jsonschema.Draft202012Validator(schema)
    files = sorted(CASES.glob("*/*.json"))
    findings = check(validator, files)
    demand(f"{len(files)} cases fit their schema, their truths overlap and are narrow", not findings, "; ".join(findings[:5]))
    subjects = [json.loads(p.read_text())["subject"] for p in files]
    for subject, least in SUBJECTS.items():
        demand(f"at least {least} cases on {subject}", subjects.count(subject) >= least)
    planted(validator, json.loads((CASES / "form-factors/parallel-1-1-1.json").read_text()))
    rewritten()
    sys.exit(bool(complaints))


main()
