#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes pair.json beside this file: two surfaces of one colour by daylight. The derivation is in README.md.

    python3 generate.py            # the same bytes each time"""
import json
import math
import pathlib
import re

HERE = pathlib.Path(__file__).resolve().parent
GREY, LEAST, MOST = 0.4, 0.02, 0.78


def rectangle(name, material, left, right):
    return {"type": "polygon", "name": name, "material": material,
            "vertices": [[left, 0, 0], [right, 0, 0], [right, 0, 2], [left, 0, 2]]}


def ball(name, material, x):
    return {"type": "sphere", "name": name, "material": material, "centre": [x, -0.5, 0.7], "radius": 0.7}


def tables():
    """x, y, z of the observer by wavelength, and daylight D65, as the program has them."""
    text = (HERE.parent.parent / "lib/etendue/optics/colour_tables.cpp").read_text()
    observer = [tuple(map(float, row)) for row in re.findall(r"\{([\d.]+), ([\d.]+), ([\d.]+)\}", text)]
    daylight = text.split("daylight_d65()")[1].split("table{")[1].split("}")[0]
    return observer, [float(value) for value in daylight.split(",") if value.strip()]


def incandescent(wavelength):
    """Illuminant A, but for its scale."""
    return (560 / wavelength) ** 5 / math.expm1(1.435e7 / 2848 / wavelength)


def dot(p, q):
    return sum(a * b for a, b in zip(p, q))


def without(vector, basis):
    """What is left of the vector across an orthogonal basis; twice, since the first time leaves rounding behind."""
    for _ in range(2):
        for axis in basis:
            share = dot(vector, axis) / dot(axis, axis)
            vector = [a - share * b for a, b in zip(vector, axis)]
    return vector


observer, daylight = tables()
wavelengths = range(380, 781, 5)
assert len(observer) == len(daylight) == len(wavelengths)

# What daylight shows of a reflectance are its products with these three, made orthogonal (Gram and Schmidt).
basis = []
for channel in range(3):
    basis.append(without([s * eye[channel] for s, eye in zip(daylight, observer)], basis))

# Of all that daylight does not show, what incandescent light shows most of, as red and no green.
red = [incandescent(w) * eye[0] for w, eye in zip(wavelengths, observer)]
green = [incandescent(w) * eye[1] for w, eye in zip(wavelengths, observer)]
black = without([x - y for x, y in zip(red, green)], basis)

scale = min((MOST - GREY) / max(black), (GREY - LEAST) / -min(black))
waves = [GREY + scale * value for value in black]
assert LEAST - 1e-12 <= min(waves) and max(waves) <= MOST + 1e-12

pair = {
    "comment": "made by generate.py: surfaces of one colour by daylight, D65, and of two by incandescent light",
    "format": "etendue-scene", "version": 1, "unit": "m",
    "materials": {
        "even": {"reflectance": [[380, GREY], [780, GREY]]},
        "waves": {"reflectance": {"from_nm": 380, "step_nm": 5, "values": [round(value, 16) for value in waves]}},
        "floor": {"k_d": 0.3}},
    "lights": [{"type": "directional", "direction": [-0.4, -1, 0.8], "intensity": 0.8}],
    "objects": [
        {"type": "plane", "name": "floor", "material": "floor", "point": [0, 0, 0], "normal": [0, 0, 1]},
        rectangle("left half", "even", -3, -1.5), rectangle("right half", "waves", -1.5, 0),
        ball("left ball", "even", 0.8), ball("right ball", "waves", 2.35)]}
lines = [f'  "{key}": {json.dumps(value)}' for key, value in pair.items()]
(HERE / "pair.json").write_text("{\n" + ",\n".join(lines) + "\n}\n")
