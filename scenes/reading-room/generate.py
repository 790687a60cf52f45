#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes scene.json beside this file: a reading room with tables, chairs, lamps, and shelves of books.

    python3 generate.py            # the same bytes each time: chance comes from a fixed seed

All walls stand on a grid of 0.3 m, so that the pieces around windows and beams meet in corners of their elements."""
import json
import math
import pathlib
import random

CELL = 0.3
WIDTH, DEPTH, HEIGHT = 9.6, 7.2, 3.6
chance = random.Random(20021)
objects = []


def number(x):
    return round(x, 4) + 0.0  # no negative zero


def quad(name, material, corner, along, up, cell=None, patch=1):
    """A rectangle, seen from where `along` to `up` turns counter-clockwise; in cells of about `cell`, by which patches of
    patch x patch cells are shot."""
    corners = [corner, [a + b for a, b in zip(corner, along)], [a + b + c for a, b, c in zip(corner, along, up)],
               [a + c for a, c in zip(corner, up)]]
    one = {"type": "polygon", "name": name, "material": material,
           "vertices": [[number(x) for x in point] for point in corners]}
    if cell:
        counts = [max(1, round(math.hypot(*edge) / cell)) for edge in (along, up)]
        one["elements"] = counts
        one["patches"] = [n // patch if n % patch == 0 else n for n in counts]
    objects.append(one)


def box(name, material, low, high, elements=None):
    one = {"type": "box", "name": name, "material": material, "low": [number(x) for x in low],
           "high": [number(x) for x in high]}
    if elements:
        one["elements"] = elements
    return one


def group(name, children, turn, place):
    objects.append({"type": "group", "name": name, "children": children,
                    "transform": [{"rotate": {"axis": [0, 0, 1], "angle_deg": number(turn)}},
                                  {"translate": [number(x) for x in place]}]})


WINDOWS = [(0.9, 2.1), (3.0, 4.2), (5.1, 6.3)]  # from y to y in the wall x = 0
SILL, LINTEL, REVEAL = 0.9, 3.0, 0.3
BEAMS = [1.5, 3.6, 5.7, 7.8]  # from x, one cell wide
SHELVES, TALL = (1.2, 8.4), 2.4  # from x to x, before the wall y = DEPTH
RUG = (1.8, 7.8, 1.8, 5.1)  # from x to x, from y to y


def shell():
    x0, x1, y0, y1 = RUG
    quad("floor, front", "floor", [0, 0, 0], [WIDTH, 0, 0], [0, y0, 0], CELL, 2)
    quad("floor, back", "floor", [0, y1, 0], [WIDTH, 0, 0], [0, DEPTH - y1, 0], CELL, 2)
    quad("floor, left", "floor", [0, y0, 0], [x0, 0, 0], [0, y1 - y0, 0], CELL, 2)
    quad("floor, right", "floor", [x1, y0, 0], [WIDTH - x1, 0, 0], [0, y1 - y0, 0], CELL, 2)
    quad("rug, front border", "rug border", [x0, y0, 0], [x1 - x0, 0, 0], [0, CELL, 0], CELL)
    quad("rug, back border", "rug border", [x0, y1 - CELL, 0], [x1 - x0, 0, 0], [0, CELL, 0], CELL)
    quad("rug, left border", "rug border", [x0, y0 + CELL, 0], [CELL, 0, 0], [0, y1 - y0 - 2 * CELL, 0], CELL)
    quad("rug, right border", "rug border", [x1 - CELL, y0 + CELL, 0], [CELL, 0, 0], [0, y1 - y0 - 2 * CELL, 0], CELL)
    quad("rug", "rug", [x0 + CELL, y0 + CELL, 0], [x1 - x0 - 2 * CELL, 0, 0], [0, y1 - y0 - 2 * CELL, 0], CELL)
    edge = 0.0
    for beam in BEAMS + [WIDTH]:
        quad(f"ceiling from {edge:.1f}", "ceiling", [edge, 0, HEIGHT], [0, DEPTH, 0], [beam - edge, 0, 0], CELL, 2)
        edge = beam + CELL
    for beam in BEAMS:
        low = HEIGHT - 0.24
        quad("beam, below", "beam", [beam, 0, low], [0, DEPTH, 0], [CELL, 0, 0], CELL, 2)
        quad("beam, left", "beam", [beam, 0, low], [0, 0, 0.24], [0, DEPTH, 0], CELL, 2)
        quad("beam, right", "beam", [beam + CELL, 0, low], [0, DEPTH, 0], [0, 0, 0.24], CELL, 2)
    panel = 0.9  # wainscot on three walls
    for name, material, low, high, cell in (("panel", "wood", 0, panel, CELL), ("wall", "wall", panel, HEIGHT, CELL)):
        up = [0, 0, high - low]
        quad(f"front {name}", material, [WIDTH, 0, low], [-WIDTH, 0, 0], up, cell, 3)
        quad(f"right {name}", material, [WIDTH, DEPTH, low], [0, -DEPTH, 0], up, cell, 3)
    quad("back wall, above", "wall", [0, DEPTH, TALL], [WIDTH, 0, 0], [0, 0, HEIGHT - TALL], CELL, 2)
    quad("back wall, left", "wall", [0, DEPTH, 0], [SHELVES[0], 0, 0], [0, 0, TALL], CELL, 2)
    quad("back wall, right", "wall", [SHELVES[1], DEPTH, 0], [WIDTH - SHELVES[1], 0, 0], [0, 0, TALL], CELL, 2)
    quad("window wall, below", "wood", [0, 0, 0], [0, DEPTH, 0], [0, 0, SILL], CELL, 3)
    quad("window wall, above", "wall", [0, 0, LINTEL], [0, DEPTH, 0], [0, 0, HEIGHT - LINTEL], CELL, 2)
    edge = 0.0
    for low, high in WINDOWS + [(DEPTH, DEPTH)]:
        quad("window wall, pier", "wall", [0, edge, SILL], [0, low - edge, 0], [0, 0, LINTEL - SILL], CELL)
        edge = high


def windows():
    for low, high in WINDOWS:
        wide, tall = high - low, LINTEL - SILL
        quad("sky", "sky", [-REVEAL, low, SILL], [0, wide, 0], [0, 0, tall], CELL)
        quad("sill", "paint", [-REVEAL, low, SILL], [REVEAL, 0, 0], [0, wide, 0], CELL)
        quad("lintel", "paint", [-REVEAL, low, LINTEL], [0, wide, 0], [REVEAL, 0, 0], CELL)
        quad("reveal", "paint", [-REVEAL, low, SILL], [0, 0, tall], [REVEAL, 0, 0], CELL)
        quad("reveal", "paint", [-REVEAL, high, SILL], [REVEAL, 0, 0], [0, 0, tall], CELL)
        middle = (low + high) / 2
        objects.append(box("mullion", "paint", [-0.2, middle - 0.025, SILL], [-0.15, middle + 0.025, LINTEL]))
        for z in (SILL + 0.7, SILL + 1.4):
            for begin, end in ((low, middle - 0.025), (middle + 0.025, high)):
                objects.append(box("bar", "paint", [-0.19, begin, z - 0.02], [-0.16, end, z + 0.02]))


def shelves():
    """Eight bays of six boards, each compartment with a back of its own, so that nothing is half behind anything."""
    depth, bay, row = 0.3, 0.9, 0.39
    front, foot = DEPTH - depth, TALL - 6 * 0.39
    places = [SHELVES[0] + k * bay for k in range(9)]
    for x in places:
        objects.append(box("shelf, side", "shelf", [x - 0.015, front - 0.01, 0], [x + 0.015, DEPTH, TALL], [2, 6]))
    for x in places[:-1]:
        objects.append(box("shelf, plinth", "shelf", [x + 0.015, front + 0.01, 0],
                           [x + bay - 0.015, front + 0.03, foot - 0.025], [4, 1]))
        for k in range(7):
            z = foot + k * row
            objects.append(box("shelf, board", "shelf", [x + 0.015, front, z - 0.025], [x + bay - 0.015, DEPTH, z], [4, 1]))
        for k in range(6):
            z = foot + k * row
            quad("shelf, back", "shelf", [x + 0.015, DEPTH - 0.002, z], [bay - 0.03, 0, 0], [0, 0, row - 0.025], 0.2)
            books(x + 0.02, x + bay - 0.02, front, z)


def books(x, end, front, z):
    end -= chance.choice([0, 0, 0, 0.12, 0.3])
    colours = chance.sample(BOOKS, 4)
    height, colour = 0.26, colours[0]
    while True:
        if chance.random() < 0.45:  # a new series
            height, colour = chance.uniform(0.2, 0.33), chance.choice(colours)
        wide = chance.uniform(0.045, 0.1)
        if x + wide > end:
            return
        deep, y = chance.uniform(0.17, 0.24), front + chance.uniform(0.015, 0.05)
        objects.append(box("book", colour, [x, y, z], [x + wide, y + deep, z + height]))
        x += wide + 0.002


def table(x, y):
    parts = [box("top", "table", [-1.2, -0.45, 0.71], [1.2, 0.45, 0.75], [16, 6])]
    parts[0]["patches"] = [8, 3]
    for a in (-1.12, 1.12):
        for b in (-0.38, 0.38):
            parts.append(box("leg", "table", [a - 0.035, b - 0.035, 0], [a + 0.035, b + 0.035, 0.71], [1, 4]))
    for b in (-0.38, 0.38):
        parts.append(box("apron", "table", [-1.08, b - 0.012, 0.62], [1.08, b + 0.012, 0.71], [8, 1]))
    group("table", parts, 0, [x, y, 0])


def chair(x, y, turn):
    """Looks to +y."""
    parts = [box("seat", "chair", [-0.21, -0.21, 0.43], [0.21, 0.21, 0.46], [3, 3])]
    for a in (-0.185, 0.185):
        parts.append(box("leg", "chair", [a - 0.02, 0.165, 0], [a + 0.02, 0.205, 0.43], [1, 3]))
        parts.append(box("post", "chair", [a - 0.02, -0.205, 0], [a + 0.02, -0.165, 0.92], [1, 5]))
    for z in (0.58, 0.72, 0.86):
        parts.append(box("slat", "chair", [-0.165, -0.195, z - 0.035], [0.165, -0.175, z + 0.035], [3, 1]))
    group("chair", parts, turn, [x, y, 0])


def frustum(name, material, low, high, z0, z1):
    """The sides of a hood: a rectangle low = (a, b) half sides at z0, high at z1, seen from outside."""
    (a, b), (c, d) = low, high
    ring = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    sides = []
    for (i, j), (k, l) in zip(ring, ring[1:] + ring[:1]):
        sides.append({"type": "polygon", "name": name, "material": material, "elements": [3, 1],
                      "vertices": [[i * a, j * b, z0], [k * a, l * b, z0], [k * c, l * d, z1], [i * c, j * d, z1]]})
    return sides


def desk_lamp(x, y, turn):
    a, b = 0.17, 0.07
    parts = [box("foot", "brass", [-0.08, -0.05, 0], [0.08, 0.11, 0.02], [2, 2]),
             box("stem", "brass", [-0.01, 0.08, 0.02], [0.01, 0.1, 0.4], [1, 4])]  # outside the light's reach
    parts += frustum("hood", "green glass", (a, b), (a - 0.03, 0.03), 0.36, 0.46)
    parts.append({"type": "polygon", "name": "hood, top", "material": "green glass", "elements": [3, 1],
                  "vertices": [[-a + 0.03, -0.03, 0.46], [a - 0.03, -0.03, 0.46], [a - 0.03, 0.03, 0.46],
                               [-a + 0.03, 0.03, 0.46]]})
    parts.append({"type": "polygon", "name": "light", "material": "lamp", "elements": [4, 2], "patches": [4, 2],
                  "vertices": [[-a, -b, 0.36], [-a, b, 0.36], [a, b, 0.36], [a, -b, 0.36]]})
    group("desk lamp", parts, turn, [x, y, 0.75])


def lantern(x, y):
    half, z = 0.16, 2.35
    parts = [box("opal glass", "lantern", [-half, -half, z], [half, half, z + 0.36], [2, 2]),
             box("cap", "brass", [-half - 0.02, -half - 0.02, z + 0.362], [half + 0.02, half + 0.02, z + 0.392], [2, 2]),  # the rod stands on its middle
             box("rod", "brass", [-0.01, -0.01, z + 0.392], [0.01, 0.01, HEIGHT], [1, 4])]
    parts[0]["patches"] = parts[1]["patches"] = [2, 2]
    group("lantern", parts, 0, [x, y, 0])


def on_the_table(x, y, turn, kind):
    if kind == "open book":
        parts = []
        for side in (-1, 1):
            low, high = sorted((0.005 * side, 0.15 * side))
            parts.append(box("page", "paper", [low, -0.11, 0.012], [high, 0.11, 0.024], [3, 4]))
        parts.append(box("cover", BOOKS[0], [-0.16, -0.12, 0.002], [0.16, 0.12, 0.01], [4, 3]))
    elif kind == "stack":
        parts, z = [], 0.002
        for _ in range(chance.randint(2, 4)):
            tall, a, b = chance.uniform(0.025, 0.05), chance.uniform(0.08, 0.11), chance.uniform(0.11, 0.15)
            shift = chance.uniform(-0.015, 0.015)
            parts.append(box("book", chance.choice(BOOKS), [shift - a, -b, z], [shift + a, b, z + tall], [3, 3]))
            z += tall + 0.002
    else:
        parts = [box("sheet", "paper", [-0.105, -0.1485, 0.002], [0.105, 0.1485, 0.006], [3, 4])]
    group(kind, parts, turn, [x, y, 0.75])


def furniture():
    for centre in (3.15, 6.45):
        table(centre, 3.45)
        for k, x in enumerate((-0.8, 0, 0.8)):
            chair(centre + x + chance.uniform(-0.06, 0.06), 2.78 - chance.uniform(0, 0.16), chance.uniform(-14, 14))
            chair(centre + x + chance.uniform(-0.06, 0.06), 4.12 + chance.uniform(0, 0.16), 180 + chance.uniform(-14, 14))
        desk_lamp(centre - 0.55, 3.45, 0)
        desk_lamp(centre + 0.55, 3.45, 0)
    for x, y, turn, kind in ((2.35, 3.2, 8, "open book"), (3.15, 3.62, 20, "stack"), (3.5, 3.2, -12, "sheet"),
                             (4.1, 3.62, 172, "open book"), (5.6, 3.66, 185, "sheet"), (5.75, 3.2, -6, "open book"),
                             (6.45, 3.42, -25, "stack"), (7.15, 3.2, 10, "open book"), (7.4, 3.68, 160, "sheet")):
        on_the_table(x, y, turn, kind)
    lantern(3.15, 3.45)
    lantern(6.45, 3.45)
    for y, wide, tall, picture in ((1.8, 1.2, 0.9, ("book green", "picture, blue", "picture, sky")),
                                   (4.2, 0.9, 1.2, ("picture, ochre", "book brown", "picture, dusk")),
                                   (5.7, 0.9, 1.2, ("picture, blue", "book green", "picture, sky"))):
        frame = [box("frame", "brass", [-0.05, 0, 1.35], [-0.02, wide, 1.35 + tall], [4, 4])]
        low, high = 1.42, 1.28 + tall
        bands = [(low, low + 0.35 * (high - low), picture[0]), (low + 0.35 * (high - low), low + 0.6 * (high - low), picture[1]),
                 (low + 0.6 * (high - low), high, picture[2])]
        for z0, z1, material in bands:  # land, hills, sky
            frame.append({"type": "polygon", "name": "canvas", "material": material, "elements": [4, 2],
                          "vertices": [[-0.052, wide - 0.07, z0], [-0.052, 0.07, z0], [-0.052, 0.07, z1],
                                       [-0.052, wide - 0.07, z1]]})
        group("picture", frame, 0, [WIDTH, y - wide / 2, 0])


BOOKS = ["book red", "book blue", "book green", "book ochre", "book brown", "book cream", "book black", "book violet"]
MATERIALS = {
    "wall": [0.72, 0.67, 0.58], "ceiling": [0.8, 0.79, 0.76], "paint": [0.78, 0.78, 0.76], "wood": [0.36, 0.21, 0.12],
    "floor": [0.4, 0.27, 0.16], "rug": [0.42, 0.09, 0.08], "rug border": [0.12, 0.12, 0.25], "beam": [0.25, 0.16, 0.1],
    "shelf": [0.34, 0.21, 0.12], "table": [0.45, 0.27, 0.14], "chair": [0.28, 0.16, 0.09],
    "brass": [0.5, 0.4, 0.18], "green glass": [0.05, 0.3, 0.14], "paper": [0.78, 0.76, 0.7],
    "picture, sky": [0.55, 0.62, 0.68], "picture, blue": [0.12, 0.22, 0.45], "picture, ochre": [0.6, 0.42, 0.14],
    "picture, dusk": [0.68, 0.45, 0.3],
    "book red": [0.45, 0.08, 0.06], "book blue": [0.08, 0.14, 0.38], "book green": [0.08, 0.26, 0.12],
    "book ochre": [0.55, 0.38, 0.12], "book brown": [0.28, 0.15, 0.08], "book cream": [0.68, 0.62, 0.48],
    "book black": [0.06, 0.06, 0.07], "book violet": [0.26, 0.1, 0.28]}
LIGHTS = {"sky": [14, 17, 21], "lamp": [240, 180, 105], "lantern": [26, 20, 12]}


def line(one):
    return json.dumps(one, ensure_ascii=True)


def main():
    shell()
    windows()
    shelves()
    furniture()
    head = {"$schema": "../scene.schema.json", "format": "etendue-scene", "version": 1, "unit": "m",
            "name": "reading room", "comment": "Made by generate.py beside this file; see README.md.",
            "camera": {"eye": [9.2, 0.4, 1.8], "look_at": [3.4, 5.0, 1.0], "up": [0, 0, 1],
                       "horizontal_fov_deg": 72, "resolution": [960, 640]}}
    materials = [f'    "{name}": ' + line({"k_d": k_d}) for name, k_d in MATERIALS.items()]
    materials += [f'    "{name}": ' + line({"k_d": 0, "emission": emission}) for name, emission in LIGHTS.items()]
    text = "{\n" + "".join(f'  "{key}": {line(value)},\n' for key, value in head.items())
    text += '  "materials": {\n' + ",\n".join(materials) + "\n  },\n"
    text += '  "objects": [\n' + ",\n".join("    " + line(one) for one in objects) + "\n  ]\n}\n"
    pathlib.Path(__file__).with_name("scene.json").write_text(text, encoding="ascii")


if __name__ == "__main__":
    main()
