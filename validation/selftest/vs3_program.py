#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Stands for a program that reads .vs3 and writes .vf, as View3D does: vertices and surfaces of four corners that see all of each other,
their factors by Gauss' rule of eight points in each of four directions. Knows no obstructions."""
import math
import sys

NODES = [(0.1834346424956498, 0.362683783378362), (0.525532409916329, 0.3137066458778873), (0.7966664774136267, 0.2223810344533745),
         (0.9602898564975363, 0.1012285362903763)]
RULE = [(0.5 + s * x / 2, w / 2) for x, w in NODES for s in (-1, 1)]


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def samples(corners):
    """Points with their normals times area, of a parallelogram."""
    u, v = sub(corners[1], corners[0]), sub(corners[3], corners[0])
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    return [([c + s * a + t * b for c, a, b in zip(corners[0], u, v)], [ws * wt * x for x in n]) for s, ws in RULE for t,
            wt in RULE], math.hypot(*n)


def main():
    points, surfaces = {}, []
    for line in open(sys.argv[1], encoding="ascii"):
        kind, *words = line.split()
        if kind == "V":
            points[int(words[0])] = [float(w) for w in words[1:4]]
        elif kind == "S":
            surfaces.append([points[int(w)] for w in words[1:5]])
        elif kind == "O":
            sys.exit("obstructions are too much for this program")
    patches = [samples(s) for s in surfaces]
    factors = [[0.0 if i == j else sum(-dot(n, sub(q, p)) * dot(m, sub(q, p)) / (math.pi * dot(sub(q, p), sub(q, p))**2) for p,
                                       n in a for q, m in b) / area
                for j, (b, _) in enumerate(patches)] for i, (a, area) in enumerate(patches)]
    with open(sys.argv[2], "w", encoding="ascii") as out:
        out.write(f"stand-in 1.0 0 0 0 {len(surfaces)}".ljust(30) + "\n" + " ".join(f"{area:g}" for _, area in patches) + "\n")
        out.writelines(" ".join(f"{f:.6f}" for f in row) + "\n" for row in factors)
        out.write(" ".join("0.900" for _ in surfaces) + "\n")


main()
