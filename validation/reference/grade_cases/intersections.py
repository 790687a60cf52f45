# SPDX-License-Identifier: Apache-2.0
"""Cases on intersections: where a ray first meets a surface, in the open, grazing, far away, at edges, or not at all."""
import fractions

from case import Case, Truth, polygon, q, qs, scene
from interval import Interval, dot, of, sqrt

SUBJECT = "intersections"
ORDINARY = 1e-9
WHY = ("{share:.1e} of the distance (or of the surface's size, if that is more), times the condition {condition:.3g}, what grazing incidence makes of an "
       "error: {roundings:.0f} roundings of 2^-53, so that {judged}")
NONE = "no surface is met"
SIGNS = "the polynomial of the surface along the ray changes its sign between the two numbers, and nowhere before: decided in rational numbers"


class Polynomial:
    """In one variable, with rational coefficients, lowest first."""

    def __init__(self, *c):
        self.c = [q(x) for x in c]

    def __add__(self, other):
        a, b = self.c, other.c if isinstance(other, Polynomial) else [q(other)]
        n = max(len(a), len(b))
        return Polynomial(*[(a[i] if i < len(a) else 0) + (b[i] if i < len(b) else 0) for i in range(n)])

    def __mul__(self, other):
        b = other.c if isinstance(other, Polynomial) else [q(other)]
        r = [fractions.Fraction(0)] * (len(self.c) + len(b) - 1)
        for i, x in enumerate(self.c):
            for j, y in enumerate(b):
                r[i + j] += x * y
        return Polynomial(*r)

    __radd__, __rmul__ = __add__, __mul__

    def __sub__(self, other):
        return self + other * -1

    def __call__(self, t):
        value = fractions.Fraction(0)
        for x in reversed(self.c):
            value = value * t + x
        return value

    def trimmed(self):
        c = list(self.c)
        while len(c) > 1 and c[-1] == 0:
            c.pop()
        return Polynomial(*c)

    def sturm(self):
        chain = [self.trimmed(), Polynomial(*[k * x for k, x in enumerate(self.c)][1:] or [0]).trimmed()]
        while len(chain[-1].c) > 1 or chain[-1].c[0] != 0:
            a, b = list(chain[-2].c), chain[-1].c
            while len(a) >= len(b) and any(a):
                share = a[-1] / b[-1]
                for k in range(1, len(b) + 1):
                    a[-k] -= share * b[-k]
                a.pop()
            rest = Polynomial(*([-x for x in a] or [0])).trimmed()
            if rest.c == [0]:
                break
            chain.append(rest)
        return chain

    def first_root(self, low, high):
        """An interval around the first root in (low, high], at most 2^-70 of its range wide, or None: by Sturm's theorem."""
        chain = self.sturm()

        def changes(t):
            signs = [s for s in ((p(t) > 0) - (p(t) < 0) for p in chain) if s]
            return sum(a != b for a, b in zip(signs, signs[1:]))
        start = changes(low)
        if start - changes(high) == 0:
            return None
        for _ in range(90):
            middle = (low + high) / 2
            if start - changes(middle) > 0:
                high = middle
            else:
                low = middle
        return Interval(low, high)


def along(origin, d):
    """The ray's coordinates as polynomials of its parameter t, d not made a unit vector."""
    return [Polynomial(o, v) for o, v in zip(qs(origin), qs(d))]


def exact(polynomial, d, reach, start=0):
    """Second truth: the first root behind `start`, times |d|."""
    root = polynomial.first_root(q(start), q(reach))
    return "none" if root is None else root * sqrt(dot(qs(d), qs(d)))


def quadratic(a, b, c, d):
    """The smaller positive root of a t² + 2 b t + c = 0, times |d|."""
    a, b, c = of(a), of(b), of(c)
    inner = b * b - a * c
    if inner.high < 0:
        return "none"
    root = sqrt(inner)
    first, last = (-b - root) / a, (-b + root) / a
    t = first if first.low > 0 else last
    return "none" if t.high <= 0 else t * sqrt(dot(qs(d), qs(d)))


def case(name, title, objects, origin, d, truth, second, condition=1.0, size=1.0, share=ORDINARY, formula="", derivation="", how=SIGNS):
    reach = 0 if truth == "none" else float(truth.high)
    tolerance = share * max(reach, size) * condition
    kinds = ("exact arithmetic", "exact arithmetic") if truth == "none" else ("closed form", "exact arithmetic")
    return Case(SUBJECT, name, title, scene(objects), {"kind": "hit", "origin": list(origin), "direction": list(d)},
                Truth(truth, kinds[0], formula, derivation), Truth(second, kinds[1], "f(o + t d) = 0", how),
                tolerance, WHY.format(share=share, condition=condition, roundings=share * 2.0**53,
                                      judged="formulas are judged" if share == ORDINARY else "it is the roundings that are judged"))


def ball(name, title, centre, r, origin, d, share=ORDINARY):
    o = [a - b for a, b in zip(qs(origin), qs(centre))]
    v, radius = qs(d), q(r)
    a, b, c = (sum(x * y for x, y in zip(p, s)) for p, s in ((v, v), (o, v), (o, o)))
    c -= radius * radius
    value = quadratic(a, b, c, d)
    incidence = 1.0 if value == "none" else float(a * radius * radius / (b * b - a * c))
    x = along(o, v)
    f = x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - radius * radius
    return case(name, title, [{"type": "sphere", "name": "ball", "material": "plain", "centre": list(centre), "radius": r}], origin, d,
                value, exact(f, d, 10**8),
                incidence, float(r), share, "t² d·d + 2 t d·(o − c) + |o − c|² − r² = 0",
                "the smaller positive root" if value != "none" else "the discriminant is negative")


def balls():
    yield ball("sphere-head-on", "A ball, straight on", (0, 0, 0), 1, (0, 0, 5), (0, 0, -1))
    yield ball("sphere-oblique", "A ball, off its centre", (1, 2, 3), 2, (-4, 0, 1), (5, 1, 2))
    yield ball("sphere-inside", "From inside a ball", (0, 0, 0), 3, (1, 1, 1), (1, -2, 0.5))
    yield ball("sphere-behind", "A ball behind the ray's origin", (0, 0, 0), 1, (0, 0, 5), (0, 0, 1))
    yield ball("sphere-grazing", "A ball, grazed within a millionth of its radius", (0, 0, 0), 1, (0.999999, 0, 5), (0, 0, -1))
    yield ball("sphere-missed", "A ball, missed by a millionth of its radius", (0, 0, 0), 1, (1.000001, 0, 5), (0, 0, -1))
    yield ball("sphere-far", "A ball of radius 1 from a million away: the discriminant cancels", (0, 0, 0), 1, (0.5, 0, 1000000),
               (0, 0, -1), 2.0**-47)
    yield ball("sphere-far-grazing", "A ball of radius 1 from a thousand away, grazed", (0, 0, 0), 1, (0.9999, 0, 1000), (0, 0, -1), 1e-12)
    yield ball("sphere-large", "A ball of radius 6,371,000 from two above it", (0, 0, 0), 6371000, (0, 0, 6371002), (1, 0, -1), 1e-12)
    yield ball("sphere-small", "A ball of radius one thousandth", (0, 0, 0), 0.001, (0.0004, 0, 1), (0, 0, -1))


def place(origin, d, t):
    return [a + t * b for a, b in zip(qs(origin), qs(d))]


def sides(a, b, p):
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def by_crossings(p, ring):
    """Is p within the outline? A line from p to x → ∞ crosses it an odd number of times."""
    return sum((a[1] > p[1]) != (b[1] > p[1]) and (sides(a, b, p) > 0) == (b[1] > a[1]) for a, b in zip(ring, ring[1:] + ring[:1])) % 2 == 1


def by_triangles(p, ring):
    """The same: an odd number of the triangles from the first corner hold p."""
    def holds(a, b, c):
        signs = [sides(*pair, p) > 0 for pair in ((a, b), (b, c), (c, a))]
        return all(signs) or not any(signs)
    return sum(holds(ring[0], b, c) for b, c in zip(ring[1:], ring[2:])) % 2 == 1


def covers(o, p, decide):
    """Does the flat object hold the point of its plane? Rational numbers throughout; outlines are seen along z."""
    if o["type"] == "plane":
        return True
    if o["type"] == "disc":
        return sum((a - b)**2 for a, b in zip(p, qs(o["centre"]))) < q(o["radius"])**2
    rings = [[qs(v) for v in ring] for ring in (o["vertices"], *o.get("holes", []))]
    return decide(p, rings[0]) and not any(decide(p, ring) for ring in rings[1:])


def flat(name, title, o, point, normal, origin, d, inside=True, size=1.0,
         how="in or out of the outline: counts of crossings, and of triangles that hold the point, in rational numbers"):
    n = qs(normal)
    top = sum(a * (b - c) for a, b, c in zip(n, qs(point), qs(origin)))
    down = sum(a * b for a, b in zip(n, qs(d)))
    t = top / down if down else fractions.Fraction(-1)
    for decide in (by_crossings, by_triangles):
        if t > 0 and covers(o, place(origin, d, t), decide) != inside:
            raise ValueError(f"{name}: the point is not where it should be")
    value = of(t) * sqrt(dot(qs(d), qs(d))) if inside and t > 0 else "none"
    plane = sum((c * a for a, c in zip(n, along(origin, d))), Polynomial(0)) - sum(a * b for a, b in zip(n, qs(point)))
    second = "none" if not inside else exact(plane, d, 10**9)
    condition = 1.0 if value == "none" else float(sum(x * x for x in n) * sum(x * x for x in qs(d)) / (down * down))
    return case(name, title, [o], origin, d, value, second, condition, size, formula="t = n·(p − o)/n·d",
                derivation=how if inside else NONE + ": " + how, how=SIGNS if inside else how)


def flats():
    floor = {"type": "plane", "name": "floor", "material": "plain", "point": [0, 0, 0], "normal": [0, 0, 1]}
    yield flat("plane-oblique", "An unbounded plane", floor, (0, 0, 0), (0, 0, 1), (1, 2, 3), (1, 0.5, -1))
    yield flat("plane-grazing", "A plane, met at one part in a thousand", floor, (0, 0, 0), (0, 0, 1), (0, 0, 1), (1, 0, -0.001))
    yield flat("plane-parallel", "A plane that the ray runs along", floor, (0, 0, 0), (0, 0, 1), (0, 0, 1), (1, 2, 0),
               how="n·d = 0 and n·(p − o) ≠ 0")
    yield flat("plane-averted", "A plane that the ray leaves", floor, (0, 0, 0), (0, 0, 1), (0, 0, 1), (0, 0.5, 1))
    tilted = {"type": "plane", "name": "hill", "material": "plain", "point": [1, 0, 2], "normal": [1, 2, 4]}
    yield flat("plane-tilted", "A tilted plane", tilted, (1, 0, 2), (1, 2, 4), (9, 8, 7), (-1, -2, -0.5))
    corners = [(0, 0, 0), (4, 0, 1), (1, 3, 2)]
    triangle = {"type": "triangle", "name": "sail", "material": "plain", "vertices": [list(c) for c in corners]}
    normal = (-3, -7, 12)  # (4, 0, 1) × (1, 3, 2)
    for name, title, (u, v), inside in (("triangle-inside", "A triangle, in its middle", (0.3, 0.3), True),
                                        ("triangle-edge-in", "A triangle, a millionth inside its edge", (0.5, 0.000001), True),
                                        ("triangle-edge-out", "A triangle, a millionth outside its edge", (0.5, -0.000001), False),
                                        ("triangle-corner-out", "A triangle, a millionth beyond its corner", (1.000001, 0), False)):
        p = [u * (b - a) + v * (c - a) for a, b, c in zip(*corners)]
        d = (0.5, -0.25, -2)
        origin = tuple(float(q(round(x, 9)) - 2 * q(y)) for x, y in zip(p, d))
        yield flat(name, title, triangle, corners[0], normal, origin, d, inside)
    for name, title, x, inside in (("disc-inside", "A disc, a millionth inside its rim", 0.999999, True),
                                   ("disc-outside", "A disc, a millionth outside its rim", 1.000001, False)):
        yield flat(name, title, {"type": "disc", "name": "disc", "material": "plain", "centre": [0, 0, 0], "normal": [0, 0, 1],
                                 "radius": 1}, (0, 0, 0), (0, 0, 1),
                   (x, 0, 2), (0, 0, -1), inside, how="x² ≶ r² in rational numbers")
    window = polygon("frame", [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)])
    window["holes"] = [[[1, 1, 0], [3, 1, 0], [3, 3, 0], [1, 3, 0]]]
    yield flat("polygon-hole", "Through the hole in a polygon", window, (0, 0, 0), (0, 0, 1), (2, 2.5, 3), (0, 0, -1), False)
    yield flat("polygon-frame", "The frame beside the hole", window, (0, 0, 0), (0, 0, 1), (0.5, 2.5, 3), (0.1, 0, -1))
    arrow = polygon("arrow", [(0, 0, 0), (4, 0, 0), (4, 4, 0), (2, 1, 0)])
    yield flat("polygon-notch", "The notch of a concave polygon", arrow, (0, 0, 0), (0, 0, 1), (1.75, 1.25, 3), (0, 0, -1), False)


def curved():
    def tube(name, title, origin, d, caps=False):
        """The axis is z, radius 1, height 2."""
        o, v = qs(origin), qs(d)
        a, b, c = v[0] * v[0] + v[1] * v[1], o[0] * v[0] + o[1] * v[1], o[0] * o[0] + o[1] * o[1] - 1
        x = along(origin, d)
        f = x[0] * x[0] + x[1] * x[1] - 1
        value, second = quadratic(a, b, c, d), exact(f, d, 10**6)
        if caps:
            t = (2 - o[2]) / v[2]
            value = second = of(t) * sqrt(dot(v, v))
        if value != "none":
            t = value / sqrt(dot(v, v))
            height, off = o[2] + t * v[2], dot([o[0] + t * v[0], o[1] + t * v[1]], [o[0] + t * v[0], o[1] + t * v[1]])
            if height.low < 0 or height.high > 2 and not caps or caps and off.high > 1:
                raise ValueError(f"{name}: the point is beyond the ends")
        condition = 1.0 if value == "none" or caps else float(sum(y * y for y in v) / (b * b - a * c))
        return case(name, title, [{"type": "cylinder", "name": "tube", "material": "plain", "base": [0, 0, 0], "top": [0, 0, 2],
                                   "radius": 1, "caps": caps}],
                    origin, d, value, second, condition, formula="(o + t d)_xy² = 1, 0 ≤ z ≤ 2" if not caps else "z = 2, x² + y² ≤ 1",
                    derivation="the smaller positive root; z lies between the ends" if value != "none" else "the discriminant is negative")
    yield tube("cylinder-across", "A tube, across", (-3, 0.5, 1), (1, 0, 0))
    yield tube("cylinder-oblique", "A tube, aslant", (-3, 0.25, 0.5), (2, 0.25, 0.5))
    yield tube("cylinder-grazing", "A tube, grazed within a millionth", (-3, 0.999999, 1), (1, 0, 0))
    yield tube("cylinder-missed", "A tube, missed by a millionth", (-3, 1.000001, 1), (1, 0, 0))
    yield tube("cylinder-inside", "From inside a tube", (0.25, 0, 1), (1, 1, 0.1))
    yield tube("cylinder-cap", "The cap of a tube", (0.5, 0, 5), (0.05, 0, -1), True)

    def cone(name, title, origin, d):
        """Apex at (0, 0, 2), base radius 1 at z = 0: x² + y² = (1 − z/2)²."""
        x = along(origin, d)
        height = x[2] * fractions.Fraction(-1, 2) + 1
        f = x[0] * x[0] + x[1] * x[1] - height * height
        c0, c1, c2 = (f.c + [0, 0])[:3]
        below_apex = max(0, (2 - q(origin[2])) / q(d[2])) if d[2] < 0 else 0  # above it is the other nappe
        value, second = quadratic(c2, c1 / 2, c0, d), exact(f, d, 10**6, below_apex)
        return case(name, title, [{"type": "cone", "name": "cone", "material": "plain", "base": [0, 0, 0], "top": [0, 0, 2],
                                   "base_radius": 1}], origin, d, value, second,
                    10.0, formula="x² + y² = (1 − z/2)²", derivation="the smaller positive root of the quadratic equation")
    yield cone("cone-across", "A cone, across", (-3, 0.1, 0.5), (1, 0, 0.1))
    yield cone("cone-from-above", "A cone, from above", (0.25, 0.25, 5), (0, 0, -1))

    def torus(name, title, origin, d, value, condition=1.0):
        """R = 2, r = 0.5 about z: (|x|² + R² − r²)² = 4 R² (x² + y²)."""
        x = along(origin, d)
        ring = x[0] * x[0] + x[1] * x[1]
        s = ring + x[2] * x[2] + fractions.Fraction(15, 4)
        return case(name, title, [{"type": "torus", "name": "ring", "material": "plain", "centre": [0, 0, 0], "axis": [0, 0, 1],
                                   "ring_radius": 2, "tube_radius": 0.5}],
                    origin, d, value, exact(s * s - ring * 16, d, 10**4), condition, formula="(√(x² + y²) − R)² + z² = r²",
                    derivation="in the plane of the ray a circle")
    yield torus("torus-outside", "A ring, from outside in its plane", (5, 0, 0), (-1, 0, 0), of(q(2.5)))
    yield torus("torus-hole", "Through the hole of a ring", (0.5, 0, 5), (0, 0, -1), "none")
    yield torus("torus-from-above", "A ring, from above", (2.25, 0, 5), (0, 0, -1), 5 - sqrt(of(q(0.25)) - q(0.0625)), 1.4)
    yield torus("torus-from-the-hole", "A ring, from its middle", (0, 0, 0), (3, 4, 0), of(q(1.5)))
    s = of(q(0.49999)) * q(0.49999)
    yield torus("torus-grazing", "A ring, its outer side grazed within a hundred-thousandth", (2.49999, 0, 5), (0, 0, -1),
                5 - sqrt(of(q(0.25)) - s), 25000.0)
    # A paraboloid z = x² + y² up to z = 4, from the side: x² + y² − z along the ray.
    bowl = {"type": "quadric", "name": "bowl", "material": "plain", "squares": [1, 1, 0], "linear": [0, 0, -1], "constant": 0,
            "low": [-2, -2, 0], "high": [2, 2, 4]}
    for name, origin, d in (("paraboloid-below", (0.5, 0, -1), (0.1, 0.2, 1)), ("paraboloid-side", (-5, 0.5, 1), (1, 0, 0))):
        x = along(origin, d)
        f = x[0] * x[0] + x[1] * x[1] - x[2]
        c0, c1, c2 = (f.c + [0, 0])[:3]
        yield case(name, "A paraboloid, from below" if d[2] else "A paraboloid, from its side", [bowl], origin, d,
                   quadratic(c2, c1 / 2, c0, d), exact(f, d, 10**4), 10.0,
                   formula="x² + y² = z", derivation="the smaller positive root of the quadratic equation")


def several():
    box = {"type": "box", "name": "box", "material": "plain", "low": [0, 0, 0], "high": [1, 2, 3]}
    for name, title, origin, d, t in (("box-face", "A box", (-2, 1, 1), (4, 0.5, 1), 0.5),
                                      ("box-inside", "From inside a box", (0.5, 0.5, 0.5), (1, 0, 0), 0.5),
                                      ("box-near-edge", "A box, a millionth inside its edge", (-1, 0.000001, 1), (1, 0, 0), 1)):
        value = of(q(t)) * sqrt(dot(qs(d), qs(d)))
        x = along(origin, d)[0]
        yield case(name, title, [box], origin, d, value, exact(x if origin[0] < 0 else x - 1, d, 100), 1.3,
                   formula="t = (x_wall − o_x)/d_x", derivation="the slab that is entered last, or left first")
    yield case("box-past-edge", "A box, a millionth outside its edge", [box], (-1, -0.000001, 1), (1, 0, 0), "none", "none",
               formula="y < 0 all along", derivation=NONE, how="y is constant and negative")
    stack = [{"type": "sphere", "name": f"ball {k}", "material": "plain", "centre": [0, 0, 2 * k], "radius": 0.5} for k in range(5)]
    f = along((0.3, 0, 20), (0, 0, -1))
    yield case("nearest-of-five", "The nearest of five balls in a row", stack, (0.3, 0, 20), (0, 0, -1), 12 - sqrt(of(q(0.25)) - q(0.09)),
               exact((f[2] - 8) * (f[2] - 8) + q(0.09) - q(0.25), (0, 0, -1), 100), 1.6, formula="t = 12 − √(r² − x²)",
               derivation="the first ball hides the others")
    mesh = {"type": "mesh", "name": "pyramid", "material": "plain", "vertices": [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 2]],
            "triangles": [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]], "quads": [[0, 3, 2, 1]]}
    for name, title, origin, value, f in (
            ("mesh-face", "A face of a pyramid", (0.5, 1.25, 5), of(4), along((0.5, 1.25, 5), (0, 0, -1))[2] - 1),
            ("mesh-crease", "The edge between two faces of a pyramid, exactly", (0.5, 0.5, 5), of(4),
             along((0.5, 0.5, 5), (0, 0, -1))[2] - 1),
            ("mesh-apex", "The apex of a pyramid, exactly", (1, 1, 5), of(3), along((1, 1, 5), (0, 0, -1))[2] - 2)):
        yield case(name, title, [mesh], origin, (0, 0, -1), value, exact(f, (0, 0, -1), 100), 5.0, formula="z = 2 min(x, y, 2 − x, 2 − y)",
                   derivation="a closed mesh has no gaps along edges")


def cases():
    for part in (balls(), flats(), curved(), several()):
        yield from part
