#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Answers cases of `etendue-validate grade` by POV-Ray 3.7: pixels, and where a ray lands after mirrors and glass. It knows pictures
only, so a place is read from colours: the wall is painted with its own coordinates, in a picture of one pixel that looks along the
ray; a second and a third picture spread a smaller piece of the wall over all colours, as a magnifying glass would.

usage: validation/adapters/povray.py CASE
"""
import importlib.machinery
import importlib.util
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
EXPORTER = str(pathlib.Path(__file__).resolve().parents[2] / "ci/against-povray")
LOADER = importlib.machinery.SourceFileLoader("against_povray", EXPORTER)
povray = importlib.util.module_from_spec(importlib.util.spec_from_loader("against_povray", LOADER))
LOADER.exec_module(povray)

WIDEST, CLOSER = 64, 1024  # the first picture shows places in [-32, 32]³; each further one a 1024th of that


def rendered(text, size, folder):
    """The picture's samples in [0, 1]: 16 bits, linear."""
    source, picture = pathlib.Path(folder) / "scene.pov", pathlib.Path(folder) / "scene.png"
    source.write_text(text)
    done = subprocess.run(["povray", f"+I{source}", f"+O{picture}", f"+W{size[0]}", f"+H{size[1]}", "+FN16", "-A", "-D", "-GA",
                           "File_Gamma=1.0", "+WT1"],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit("povray: " + done.stderr.strip()[-200:])
    return [value / 255 for value in povray.samples(picture)[1]]


def painted(wall, lows, width):
    """The wall, each channel showing one coordinate from its low on; what the average takes from each is given back."""
    maps = []
    for axis, low in zip("xyz", lows):
        full = ", ".join("3" if a == axis else "0" for a in "xyz")
        maps.append(f"[1 function {{ ({axis} - ({low:.17g})) / {width:.17g} }} color_map {{ [0 rgb 0] [1 rgb <{full}>] }}]")
    return f"{povray.shape(wall)} pigment {{ average pigment_map {{ {' '.join(maps)} }} }} finish {{ ambient 1 diffuse 0 }} }}\n"


def landing(case, folder):
    scene, question = case["scene"], case["question"]
    wall = next(o for o in scene["objects"] if o["name"] == question["on"])
    gaze = question["direction"]
    up = [0, 0, 1] if abs(gaze[0]) + abs(gaze[1]) > abs(gaze[2]) else [1, 0, 0]
    camera = {"eye": question["origin"], "gaze": gaze, "up": up, "horizontal_fov_deg": 1e-3, "resolution": [1, 1]}
    others = [o for o in scene["objects"] if o is not wall]
    text = povray.exported({**scene, "camera": camera, "objects": others, "ambient": 1})
    place, width = [0.0, 0.0, 0.0], float(WIDEST)
    for _ in range(3):
        lows = [p - width / 2 for p in place]
        place = [low + width * value for low, value in zip(lows, rendered(text + painted(wall, lows, width), (1, 1), folder))]
        width /= CLOSER
    return place


def pixel(case, folder):
    size, question = case["scene"]["camera"]["resolution"], case["question"]
    values = rendered(povray.exported(case["scene"]), size, folder)
    start = 3 * (question["row"] * size[0] + question["column"])
    return values[start:start + 3]


def main():
    path = sys.argv[1] if len(sys.argv) == 2 else sys.exit(__doc__)
    if not shutil.which("povray"):
        sys.exit("POV-Ray is not installed: apt-get install povray")
    with open(path, encoding="utf-8") as file:
        case = json.load(file)
    kind = case["question"]["kind"]
    answer = {"landing": landing, "pixel": pixel}.get(kind)
    if not answer:
        print(json.dumps({"unsupported": f"questions of kind {kind}: it makes pictures"}))
        return
    try:
        with tempfile.TemporaryDirectory() as folder:
            print(json.dumps({"value": answer(case, folder)}))
    except ValueError as error:  # the exporter refuses what POV-Ray has no equal for
        print(json.dumps({"unsupported": f"has no equal for {error}"}))


main()
