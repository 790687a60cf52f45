#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the cases of `etendue-validate grade` into validation/cases, or with --check says how they differ from what lies there.

usage: validation/reference/grade_cases/make.py [--check] [FOLDER]
"""
import argparse
import json
import pathlib
import sys

import form_factors
import images
import intersections
import radiosity
import refraction

MODULES = [form_factors, radiosity, refraction, intersections, images]
HOME = pathlib.Path(__file__).resolve().parents[2] / "cases"


def text_of(data):
    """JSON, one key a line on the outer levels, short things in one line."""
    def lines(value, indent):
        flat = json.dumps(value, ensure_ascii=False)
        if not isinstance(value, (dict, list)) or len(flat) + indent <= 110 and indent > 0:
            return flat
        pad = " " * (indent + 2)
        if isinstance(value, dict):
            inner = [f"{pad}{json.dumps(k)}: {lines(v, indent + 2)}" for k, v in value.items()]
            return "{\n" + ",\n".join(inner) + "\n" + " " * indent + "}"
        return "[\n" + ",\n".join(pad + lines(v, indent + 2) for v in value) + "\n" + " " * indent + "]"
    return lines(data, 0) + "\n"


def all_files():
    files = {}
    for module in MODULES:
        for case in module.cases():
            data = case.data(module.__name__)
            name = data["id"] + ".json"
            if name in files:
                sys.exit(f"make.py: two cases are called {data['id']}")
            files[name] = text_of(data)
    return files


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing; end with 1 where a file differs")
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=HOME)
    given = parser.parse_args()
    files = all_files()
    there = {p.relative_to(given.folder).as_posix(): p for p in given.folder.glob("*/*.json")}
    if given.check:
        wrong = [n for n in sorted(files.keys() | there.keys())
                 if n not in files or n not in there or there[n].read_text(encoding="utf-8") != files[n]]
        print("\n".join([f"{n}: not what the generator writes" for n in wrong] + [f"{len(files)} cases, {len(wrong)} differ"]))
        sys.exit(bool(wrong))
    for name in there.keys() - files.keys():
        there[name].unlink()
    for name, text in files.items():
        (given.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (given.folder / name).write_text(text, encoding="utf-8")
    print(f"{len(files)} cases written to {given.folder}")


main()
