# SPDX-License-Identifier: Apache-2.0
"""Second opinions on integrals: Gauss' rules in double precision. Bars are estimates: four times what two rules of different order
differ by, and the rounding of as many operations as a sum has terms."""
import functools
import math

from interval import Interval

ROUNDING = 2.0**-40  # of values about one: sums of some thousand terms, each of a few roundings of 2^-53


@functools.lru_cache(maxsize=None)
def rule(n):
    """Nodes and weights on [0, 1], by Newton's method on Legendre's polynomial."""
    result = []
    for i in range(n):
        x = math.cos(math.pi * (i + 0.75) / (n + 0.5))
        for _ in range(100):
            p0, p1 = 1.0, x
            for k in range(2, n + 1):
                p0, p1 = p1, ((2 * k - 1) * x * p1 - (k - 1) * p0) / k
            slope = n * (x * p1 - p0) / (x * x - 1)
            step = p1 / slope
            x -= step
            if abs(step) < 1e-15:
                break
        result.append((0.5 + 0.5 * x, 1 / ((1 - x * x) * slope * slope)))
    return result


def enclosed(value, other, scale=1.0):
    bar = 4 * abs(value - other) + ROUNDING * max(abs(value), scale * 2.0**-10)
    return Interval(value - bar, value + bar)


def over_line(f, low, high, order=48):
    def by(n):
        return (high - low) * math.fsum(w * f(low + (high - low) * x) for x, w in rule(n))
    return enclosed(by(order + 13), by(order))


def over_rectangle(f, x_range, y_range, order=48):
    (x0, x1), (y0, y1) = x_range, y_range

    def by(n):
        return (x1 - x0) * (y1 - y0) * math.fsum(
            a * b * f(x0 + (x1 - x0) * x, y0 + (y1 - y0) * y) for x, a in rule(n) for y, b in rule(n))
    return enclosed(by(order + 13), by(order))


def overlap(a, b):
    """Pieces (low, high, f) of w(u) = length of the set of x in a with x + u in b: where it is linear, and the function."""
    knots = sorted({b[0] - a[1], b[0] - a[0], b[1] - a[1], b[1] - a[0]})

    def weight(u):
        return max(0.0, min(a[1], b[1] - u) - max(a[0], b[0] - u))
    return [(low, high, weight) for low, high in zip(knots, knots[1:])]


@functools.lru_cache(maxsize=None)
def parallel_exchange(a_x, a_y, b_x, b_y, h):
    """A_1 F_12 of two parallel rectangles at distance h: the integral over x and x' depends on x' − x alone, so four integrals become
    two, over the differences, cut where the weight bends and into strips of about h."""
    total = Interval(0)
    for x0, x1, wx in overlap(a_x, b_x):
        for y0, y1, wy in overlap(a_y, b_y):
            nx, ny = (min(8, math.ceil((b - a) / (2 * h))) for a, b in ((x0, x1), (y0, y1)))
            for i in range(nx):
                for j in range(ny):
                    total += over_rectangle(
                        lambda u, v: wx(u) * wy(v) * h * h / (math.pi * (u * u + v * v + h * h)**2),
                        (x0 + (x1 - x0) * i / nx, x0 + (x1 - x0) * (i + 1) / nx),
                        (y0 + (y1 - y0) * j / ny, y0 + (y1 - y0) * (j + 1) / ny), 24)
    return total


@functools.lru_cache(maxsize=None)
def perpendicular_exchange(length, w, h):
    """A_1 F_12 of two rectangles with a common edge: along the edge the integral is L/s³ atan(L/s) with s the distance from it; in
    polar coordinates what is left is smooth."""
    def wedge(low, high, reach):
        return over_rectangle(
            lambda t, angle: reach(angle) * math.cos(angle) * math.sin(angle) * math.atan2(length, t * reach(angle)),
            (0, 1), (low, high))
    corner = math.atan2(h, w)
    both = wedge(0, corner, lambda a: w / math.cos(a)) + wedge(corner, math.pi / 2, lambda a: h / math.sin(a))
    return both * length / Interval(math.pi - 2.0**-51, math.pi + 2.0**-51)
