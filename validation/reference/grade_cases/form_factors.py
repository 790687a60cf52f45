# SPDX-License-Identifier: Apache-2.0
"""Cases on form factors: plates, discs, spheres, partitions, closed rooms."""
import functools
import math

from case import RELATIVE, SINGLE, Case, Truth, box_walls, polygon, q, scene
from interval import PI, Interval, atan, log, of, sqrt
from quadrature import over_line, over_rectangle, parallel_exchange, perpendicular_exchange

SUBJECT = "form factors"


def corner_term(u, v, h):
    """Second antiderivative in both differences of h²/(π (u² + v² + h²)²): the kernel of parallel plates, integrated four times."""
    u, v, h = of(q(u)), of(q(v)), of(q(h))
    su, sv = sqrt(h * h + u * u), sqrt(h * h + v * v)
    return (v * su * atan(v / su) + u * sv * atan(u / sv) - h * h / 2 * log(u * u + v * v + h * h)) / (2 * PI)


@functools.lru_cache(maxsize=None)
def parallel(a_x, a_y, b_x, b_y, h):
    """A_1 F_12 by sixteen corner terms."""
    total = Interval(0)
    for i, x in enumerate(a_x):
        for j, y in enumerate(a_y):
            for k, s in enumerate(b_x):
                for l, t in enumerate(b_y):
                    total += corner_term(q(s) - q(x), q(t) - q(y), h) * (-1)**(i + j + k + l)
    return total


@functools.lru_cache(maxsize=None)
def perpendicular(length, w, h):
    """A_1 F_12 of w × length and h × length on a common edge (Howell's C-14)."""
    H, W = of(q(h)) / q(length), of(q(w)) / q(length)
    h2, w2 = H * H, W * W
    root, all_ = sqrt(h2 + w2), 1 + h2 + w2
    logs = log((1 + w2) * (1 + h2) / all_) + w2 * log(w2 * all_ / ((1 + w2) * (h2 + w2))) + h2 * log(h2 * all_ / ((1 + h2) * (h2 + w2)))
    return (W * atan(1 / W) + H * atan(1 / H) - root * atan(1 / root) + logs / 4) / PI * q(length) * q(length)


PARALLEL = ("A_1 F_12 = Σ ± G(x' − x, y' − y) over the four corners of each, G(u, v) = (v √(h²+u²) atan(v/√(h²+u²)) + u √(h²+v²) "
            "atan(u/√(h²+v²)) − ½ h² ln(u²+v²+h²))/2π")
PERPENDICULAR = "F_12 = (W atan 1/W + H atan 1/H − √(H²+W²) atan 1/√(H²+W²) + ¼ ln …)/πW, W = w/l, H = h/l (Howell C-14)"
BY_PARTS = "the kernel cos α₁ cos α₂/(π r²) integrated four times by parts, in intervals of 50 digits"
DIFFERENCES = "the double integral over the differences x' − x, y' − y with trapezoidal weights, Gauss' rules of two orders"


def area(p):
    return q(p[0][1] - p[0][0]) * q(p[1][1] - p[1][0])


def plates(name, title, a_x, a_y, b_x, b_y, h, extra=(), kept=None):
    """Two parallel rectangles; `kept`: the parts between which light passes, where something stands between."""
    def ring(x, y, z, front):
        v = [(x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z)]
        return v if front else v[::-1]
    pairs = kept if kept is not None else [(a_x, a_y, b_x, b_y)]
    whole = area((a_x, a_y))
    exact = sum((parallel(*p, h) for p in pairs), Interval(0)) / whole
    other = sum((parallel_exchange(*p, h) for p in pairs), Interval(0)) / whole
    return Case(SUBJECT, name, title,
                scene([polygon("lower", ring(a_x, a_y, 0, True)), polygon("upper", ring(b_x, b_y, h, False)), *extra]),
                {"kind": "form_factor", "from": "lower", "to": "upper"},
                Truth(exact, "closed form", PARALLEL, BY_PARTS + (
                    "; partitions reach from plate to plate, so that what passes is the sum over the parts that face each other" if kept else "")),
                Truth(other, "independent quadrature", "A_1 F_12 = ∬ w(u) w(v) h²/(π (u²+v²+h²)²) du dv", DIFFERENCES), RELATIVE, SINGLE)


def upright(name, x, y, h):
    """A partition across all y, from plate to plate."""
    return polygon(name, [(x, y[0], 0), (x, y[1], 0), (x, y[1], h), (x, y[0], h)])


def parallel_cases():
    for x, y, h, words in ((1, 1, 1, "two opposite faces of a cube"), (1, 1, 0.1, "squares ten times as wide as apart"),
                           (1, 1, 10, "squares ten times as far apart as wide"), (2, 1, 0.5, "rectangles 2 × 1 at distance one half"),
                           (4, 0.25, 1, "strips 4 × 0.25"), (0.1, 0.1, 1, "small squares: closed forms begin to cancel")):
        yield plates(f"parallel-{x}-{y}-{h}", f"Parallel, equal, opposite: {words}", (0, x), (0, y), (0, x), (0, y), h)
    yield plates("parallel-shifted", "Parallel squares, one shifted by its side", (0, 1), (0, 1), (1, 2), (0, 1), 1)
    yield plates("parallel-diagonal", "Parallel squares, shifted along the diagonal", (0, 1), (0, 1), (2, 3), (2, 3), 1)
    yield plates("parallel-unequal", "A unit square below a plate of 3 × 2", (0, 1), (0, 1), (-1, 2), (-0.5, 1.5), 0.75)
    y = (0, 1)
    yield plates("partition-middle", "Opposite squares, a partition in the middle", (0, 1), y, (0, 1), y, 1, [upright("wall", 0.5, y, 1)],
                 [((0, 0.5), y, (0, 0.5), y), ((0.5, 1), y, (0.5, 1), y)])
    yield plates("partition-aside", "Opposite squares, a partition at one quarter", (0, 1), y, (0, 1), y, 1, [upright("wall", 0.25, y, 1)],
                 [((0, 0.25), y, (0, 0.25), y), ((0.25, 1), y, (0.25, 1), y)])
    yield plates("partition-three", "Opposite squares, four stalls", (0, 1), y, (0, 1), y, 1,
                 [upright(f"wall {k}", k / 4, y, 1) for k in (1, 2, 3)],
                 [((k / 4, (k + 1) / 4), y, (k / 4, (k + 1) / 4), y) for k in range(4)])


def l_shaped():
    """A square below an L: the sum over the two rectangles that make it."""
    h = 1
    parts = (((0, 2), (0, 1)), ((0, 1), (1, 2)))
    exact = sum((parallel((0, 1), (0, 1), *p, h) for p in parts), Interval(0))
    other = sum((parallel_exchange((0, 1), (0, 1), *p, h) for p in parts), Interval(0))
    shape = [(0, 0, h), (0, 2, h), (1, 2, h), (1, 1, h), (2, 1, h), (2, 0, h)]
    return Case(SUBJECT, "parallel-l-shape", "A unit square below an L of three unit squares: a concave polygon",
                scene([polygon("lower", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]), polygon("upper", shape)]),
                {"kind": "form_factor", "from": "lower", "to": "upper"},
                Truth(exact, "closed form", PARALLEL, "factors add over the parts of the receiver; " + BY_PARTS),
                Truth(other, "independent quadrature", "A_1 F_12 = Σ ∬ w(u) w(v) h²/(π (u²+v²+h²)²) du dv", DIFFERENCES), RELATIVE, SINGLE)


def corner_cases():
    for length, w, h, walls in ((1, 1, 1, 0), (1, 2, 1, 0), (3, 0.5, 1, 0), (1, 0.1, 4, 0), (10, 1, 1, 0), (1, 1, 1, 1)):
        part = q(length) / 2 if walls else q(length)
        count = 2 if walls else 1
        base = polygon("floor", [(0, 0, 0), (w, 0, 0), (w, length, 0), (0, length, 0)])
        wall = polygon("wall", [(0, 0, 0), (0, length, 0), (0, length, h), (0, 0, h)])
        stand = polygon("partition", [(0, 0.5, 0), (w, 0.5, 0), (w, 0.5, h), (0, 0.5, h)])
        name = f"corner-{length}-{w}-{h}" + ("-partition" if walls else "")
        yield Case(SUBJECT, name, f"Floor {w} × {length} to a wall of height {h} on its edge" + (", a partition across both" if walls else ""),
                   scene([base, wall] + [stand] * walls), {"kind": "form_factor", "from": "floor", "to": "wall"},
                   Truth(perpendicular(part, w, h) * count / (q(w) * q(length)), "closed form", PERPENDICULAR,
                         "Lambert's contour integral over both edges, in intervals of 50 digits" + ("; twice the half" if walls else "")),
                   Truth(perpendicular_exchange(float(part), w, h) * count / (q(w) * q(length)), "independent quadrature",
                         "A_1 F_12 = (l/π) ∬ cos φ sin φ atan(l/s) ds dφ", "the integral along the edge done by hand, the rest in polar "
                         "coordinates by Gauss' rules of two orders"), RELATIVE, SINGLE)


def disc(name, z, r, down):
    return {"type": "disc", "name": name, "material": "plain", "centre": [0, 0, z], "normal": [0, 0, -1 if down else 1], "radius": r}


def sphere(name, centre, r):
    return {"type": "sphere", "name": name, "material": "plain", "centre": list(centre), "radius": r}


def element_to_disc(x, r, h):
    """From a horizontal element at distance x from the axis to a disc above it."""
    s = x * x + h * h
    return 0.5 * (1 - (s - r * r) / math.sqrt((s + r * r)**2 - 4 * r * r * x * x))


def disc_cases():
    for a, b, h in ((1, 1, 1), (1, 2, 1), (0.5, 1, 3), (1, 1, 0.1), (2, 0.25, 1)):
        ra, rb = of(q(a)) / q(h), of(q(b)) / q(h)
        x = 1 + (1 + rb * rb) / (ra * ra)
        exact = (x - sqrt(x * x - 4 * (rb / ra) * (rb / ra))) / 2
        other = over_line(lambda s: 2 * s / (a * a) * element_to_disc(s, b, h), 0, a, 120)
        yield Case(SUBJECT, f"discs-{a}-{b}-{h}", f"Coaxial discs of radius {a} and {b} at distance {h}",
                   scene([disc("lower", 0, a, False), disc("upper", h, b, True)]), {"kind": "form_factor", "from": "lower", "to": "upper"},
                   Truth(exact, "closed form", "F_12 = ½ (X − √(X² − 4 (b/a)²)), X = 1 + (1 + (b/h)²)/(a/h)²",
                         "both discs are caps of one sphere, between whose parts factors are area fractions; solved for the discs"),
                   Truth(other, "independent quadrature", "F_12 = 1/(πa²) ∫ 2πs ½ (1 − (s²+h²−b²)/√((s²+h²+b²)² − 4 b² s²)) ds",
                         "a point's factor to a disc (inversion), integrated over the lower disc by Gauss' rules"), RELATIVE, SINGLE)


def ball_cases():
    for r, h, b in ((1, 2, 1), (0.5, 3, 2), (1, 1.25, 5)):
        exact = (1 - 1 / sqrt(1 + of(q(b)) * q(b) / (q(h) * q(h)))) / 2
        # From the disc: (r/d)² cos α wherever the whole sphere lies above the element's plane.
        back = over_line(lambda s: 2 * math.pi * s * r * r * h / (s * s + h * h)**1.5, 0, b, 120)
        other = back / (4 * PI * q(r) * q(r))
        objects = [sphere("ball", (0, 0, h), r), disc("disc", 0, b, False)]
        yield Case(SUBJECT, f"ball-to-disc-{r}-{h}-{b}", f"A ball of radius {r} at height {h} over the middle of a disc of radius {b}",
                   scene(objects), {"kind": "form_factor", "from": "ball", "to": "disc"},
                   Truth(exact, "closed form", "F_12 = ½ (1 − h/√(h² + b²))",
                         "a sphere sends to a surface that sees all of it the share of "
                         "the solid angle at its centre"),
                   Truth(other, "independent quadrature", "A_1 F_12 = A_2 F_21 = ∫ r² h/(s² + h²)^{3/2} 2πs ds",
                         "reciprocity: each element of the disc sees the ball under (r/d)² cos α"), RELATIVE, SINGLE)
    r, h, b = 1, 2, 1
    exact = 2 * of(q(r)) * q(r) / (q(b) * q(b)) * (1 - 1 / sqrt(1 + of(q(b)) * q(b) / (q(h) * q(h))))
    other = over_line(lambda s: 2 * s / (b * b) * r * r * h / (s * s + h * h)**1.5, 0, b, 120)
    yield Case(SUBJECT, "disc-to-ball", "The other way: from the disc to the ball",
               scene([sphere("ball", (0, 0, h), r), disc("disc", 0, b, False)]),
               {"kind": "form_factor", "from": "disc", "to": "ball"},
               Truth(exact, "closed form", "F_21 = 2 (r/b)² (1 − h/√(h² + b²))", "reciprocity and the solid angle at the centre"),
               Truth(other, "independent quadrature", "F_21 = 2/b² ∫ r² h s/(s² + h²)^{3/2} ds", "the element's factor (r/d)² cos α, "
                     "integrated by Gauss' rules"), RELATIVE, SINGLE)
    for r, h, x, y in ((0.5, 1, 1, 1), (1, 2, 3, 0.5)):
        a, b, c = of(q(x)), of(q(y)), of(q(h))
        exact = atan(a * b / (c * sqrt(a * a + b * b + c * c))) / (4 * PI)
        other = over_rectangle(lambda s, t: h / (s * s + t * t + h * h)**1.5, (0, x), (0, y)) / (4 * PI)
        plate = polygon("plate", [(0, 0, 0), (x, 0, 0), (x, y, 0), (0, y, 0)])
        yield Case(SUBJECT, f"ball-to-plate-{r}-{h}", f"A ball over the corner of a plate {x} × {y}",
                   scene([sphere("ball", (0, 0, h), r), plate]),
                   {"kind": "form_factor", "from": "ball", "to": "plate"},
                   Truth(exact, "closed form", "F_12 = 1/4π atan(x y/(h √(x² + y² + h²)))",
                         "the solid angle of a rectangle at a point above its corner"),
                   Truth(other, "independent quadrature", "F_12 = 1/4π ∬ h/(s² + t² + h²)^{3/2} ds dt", "the solid angle by Gauss' rules"),
                   RELATIVE, SINGLE)


def room_sum(a, b, c):
    """Floor to the five other walls, each by its closed form."""
    def corner(length, w, h):
        return perpendicular(length, w, h)
    return (parallel((0, a), (0, b), (0, a), (0, b), c) + 2 * corner(b, a, c) + 2 * corner(a, b, c)) / (q(a) * q(b))


def closed_cases():
    for a, b, c in ((1, 1, 1), (2, 3, 1), (1, 1, 8)):
        yield Case(SUBJECT, f"room-closes-{a}-{b}-{c}", f"All factors from the floor of a room {a} × {b} × {c} together",
                   scene(box_walls(a, b, c)),
                   {"kind": "form_factor_sum", "from": "floor"},
                   Truth(of(1), "exact arithmetic", "Σ_j F_1j = 1", "in a closed room all light arrives somewhere"),
                   Truth(room_sum(a, b, c), "interval arithmetic", "Σ_j F_1j of one parallel and four perpendicular pairs",
                         "the closed forms of the five walls, added in intervals"), RELATIVE, SINGLE)
    walls = box_walls(2, 2, 2)
    for source, target, value, formula, why in (
            ("ball", "floor", of(q(1)) / 6, "F = 1/6", "six equal faces share all that a ball in the middle of a cube sends"),
            ("floor", "ball", PI / 24, "F_21 = A_1 F_12/A_2 = 4π r²/6/4, r = ½", "reciprocity")):
        angle = over_rectangle(lambda s, t: 1 / (s * s + t * t + 1)**1.5, (-1, 1), (-1, 1)) / (4 * PI)
        other = angle if source == "ball" else angle * PI / 4
        yield Case(SUBJECT, f"cube-{source}-to-{target}", f"A ball of radius 0.5 in the middle of a cube of edge 2: {source} to {target}",
                   scene(walls + [sphere("ball", (1, 1, 1), 0.5)]), {"kind": "form_factor", "from": source, "to": target},
                   Truth(value, "exact arithmetic", formula, why),
                   Truth(other, "independent quadrature", "F = 1/4π ∬ h/(s² + t² + h²)^{3/2} ds dt, h = 1",
                         "the solid angle by Gauss' rules"),
                   RELATIVE, SINGLE)
    yield tetrahedron()


def tetrahedron():
    """Two faces of a regular tetrahedron: closure by symmetry, and Lambert's double contour integral."""
    corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    faces = {"one": (0, 2, 1), "two": (0, 1, 3), "three": (0, 3, 2), "four": (1, 2, 3)}
    objects = [polygon(name, [corners[i] for i in f]) for name, f in faces.items()]

    def from_one(s, t):  # from a point of face one, Lambert's polygon formula to face two
        a, b, c = (corners[i] for i in faces["one"])
        u = s * (1 - t), s * t  # the triangle as a squeezed square, its point a being singular neither
        p = [a[i] + u[0] * (b[i] - a[i]) + u[1] * (c[i] - a[i]) for i in range(3)]
        return 2 * s * point_to_polygon(p, (-1 / math.sqrt(3), -1 / math.sqrt(3), 1 / math.sqrt(3)), [corners[i] for i in faces["two"]])
    value = over_rectangle(from_one, (0, 1), (0, 1), 90)
    return Case(SUBJECT, "tetrahedron", "From one face of a regular tetrahedron to another", scene(objects),
                {"kind": "form_factor", "from": "one", "to": "two"},
                Truth(of(q(1)) / 3, "exact arithmetic", "F_12 = 1/3", "closure: the three other faces are equal by symmetry"),
                Truth(value, "independent quadrature", "F_12 = 1/A ∫ 1/2π Σ_k β_k (Γ_k · n) dA", "Lambert's polygon formula from points of "
                      "the face, integrated over it by Gauss' rules"), RELATIVE, SINGLE)


def point_to_polygon(p, normal, corners):
    """Lambert: 1/2π Σ β_k (Γ_k · n), β_k the angle of edge k from p, Γ_k the unit normal of the plane through it."""
    rays = [[c[i] - p[i] for i in range(3)] for c in corners]
    total = 0.0
    for a, b in zip(rays, rays[1:] + rays[:1]):
        n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        length = math.hypot(*n)
        if length > 0:
            total += math.atan2(length, sum(x * y for x, y in zip(a, b))) * sum(x * y for x, y in zip(n, normal)) / length
    return abs(total) / (2 * math.pi)


def hidden_cases():
    screen = polygon("screen", [(-9, -9, 0.5), (9, -9, 0.5), (9, 9, 0.5), (-9, 9, 0.5)])
    base = plates("hidden", "Opposite squares, a screen wide enough to hide one from the other", (0, 1), (0, 1), (0, 1), (0, 1), 1,
                  [screen], [])
    zero = of(0)
    base.truth = Truth(zero, "exact arithmetic", "F_12 = 0",
                       "every line between the two meets the screen: it covers the convex hull of both at its height")
    base.second = Truth(zero, "other method", "F_12 ≤ Σ over the screen's complement, which no line reaches",
                        "lines between the squares cross the screen's plane within [0, 1]², which lies inside the screen")
    yield base
    averted = plates("averted", "Two squares that show each other their backs", (0, 1), (0, 1), (0, 1), (0, 1), 1, [], [])
    for o in averted.scene["objects"]:
        o["vertices"].reverse()
    averted.truth = Truth(zero, "exact arithmetic", "F_12 = 0, cos α₁ < 0 everywhere", "neither lies in front of the other")
    averted.second = Truth(zero, "other method", "n₁ · (x₂ − x₁) = −h < 0 for all pairs of points",
                           "the sign is the same at all corners, hence everywhere")
    yield averted


def cases():
    for part in (parallel_cases(), [l_shaped()], corner_cases(), disc_cases(), ball_cases(), closed_cases(), hidden_cases()):
        yield from part
