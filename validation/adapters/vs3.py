#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Answers cases of `etendue-validate grade` on form factors by any program that reads View3D's .vs3 and writes its .vf: names of two
files stand for {in} and {out} in its command, or follow it where neither is named, as in `View3D in.vs3 out.vf`.

usage: validation/adapters/vs3.py COMMAND [ARGUMENT …] CASE

What stands between two surfaces and has no part in the question is written as an obstruction, once each way round: View3D's hide from
one side only. Corners beyond four, curves and holes the format does not know.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

HALF_A_DIGIT = 0.5e-6  # a .vf has six decimals


class Unsupported(Exception):
    pass


def plate(o):
    if o["type"] not in ("polygon", "triangle") or "holes" in o or "transform" in o:
        raise Unsupported(f"a {o['type']}")
    if len(o["vertices"]) > 4:
        raise Unsupported(f"{len(o['vertices'])} corners")
    return o["vertices"]


def written(objects, surfaces):
    """The text of a .vs3: `surfaces` by their names in this order, all else as obstructions."""
    points, records = [], []

    def numbers(vertices):
        for v in vertices:
            points.append(v)
        indices = range(len(points) - len(vertices) + 1, len(points) + 1)
        return " ".join(map(str, [*indices, 0][:4]))
    by_name = {o["name"]: o for o in objects}
    for n, name in enumerate(surfaces, 1):
        records.append(f"S {n} {numbers(plate(by_name[name]))} 0 0 0.9 s{n}")
    for o in objects:
        if o["name"] in surfaces:
            continue
        for turned in (plate(o), plate(o)[::-1]):
            records.append(f"O {len(records) + 1} {numbers(turned)}")
    lines = [f"V {n} {' '.join(repr(float(x)) for x in p)}" for n, p in enumerate(points, 1)]
    return "\n".join(["T a case of etendue-validate grade", "C encl=0 eps=1e-7 out=0", "F 3", *lines, *records, "End of data"]) + "\n"


def factors(text):
    """Rows of a .vf in text form: a header that ends with the number of surfaces, areas, rows, emittances."""
    header, _, rest = text.partition("\n")
    n = int(header.split()[-1])
    numbers = [float(word) for word in rest.split()]
    if len(numbers) < n + n * n:
        sys.exit(f"the .vf names {n} surfaces and has {len(numbers)} numbers")
    return [numbers[n + i * n:n + (i + 1) * n] for i in range(n)]


def answer(case, command, folder):
    question, objects = case["question"], case.get("scene", {}).get("objects", [])
    if question["kind"] == "form_factor":
        surfaces = [question["from"], question["to"]]
    elif question["kind"] == "form_factor_sum":
        surfaces = [question["from"]] + [o["name"] for o in objects if o["name"] != question["from"]]
        if len(surfaces) * HALF_A_DIGIT > case["tolerance"]:
            raise Unsupported("a sum of numbers of six decimals is not exact enough")
    else:
        raise Unsupported(f"questions of kind {question['kind']}: .vs3 has form factors")
    given, made = pathlib.Path(folder) / "case.vs3", pathlib.Path(folder) / "case.vf"
    given.write_text(written(objects, surfaces))
    words = [w.replace("{in}", str(given)).replace("{out}", str(made)) for w in command]
    if words == command:
        words += [str(given), str(made)]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if not made.exists():
        sys.exit(f"{command[0]} ended with {done.returncode} and wrote no .vf: {(done.stderr or done.stdout).strip()[-200:]}")
    row = factors(made.read_text())[0]
    return sum(row) if question["kind"] == "form_factor_sum" else row[1]


def main():
    *command, path = sys.argv[1:] or [""]
    if not command:
        sys.exit(__doc__)
    with open(path, encoding="utf-8") as file:
        case = json.load(file)
    try:
        with tempfile.TemporaryDirectory() as folder:
            print(json.dumps({"value": answer(case, command, folder)}))
    except Unsupported as reason:
        print(json.dumps({"unsupported": str(reason)}))


main()
