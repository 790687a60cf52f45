# SPDX-License-Identifier: Apache-2.0
"""Cases on images: what pixels of lit surfaces hold, mirrors, shadows, glass; direct illumination by small and by large sources, on and
off the axis, with and without blockers."""
import math

from case import Case, Truth, polygon, q, qs, scene
from interval import PI, acos, atan, cos, degrees, dot, of, plus, scaled, sin, sqrt, unit
from form_factors import point_to_polygon
from quadrature import over_rectangle
from refraction import meet, reflect

SUBJECT = "images"
HALF_A_STEP = 1 / 510
PIXELS = "half a step of a picture of 8 bits (1/510): whatever a program renders can be written in such a picture"
ENERGY = 1e-5
WATTS = ("one hundred-thousandth of what the source emits for each square metre: twelve times the rounding of single precision (2^-24) on each of a dozen terms; "
         "a program that samples needs some 10^10 samples, and says with its score how far it is")
MODEL = "I = k_a I_a + Σ k_d I_p max(0, N·L)"
SIZE = (9, 9)
EYE = dict(eye=(0, -8, 0), look_at=(0, 0, 0), fov=20, size=SIZE)


def eye_ray(column, row, eye, fov, size, gaze=(0, 1, 0), right=(1, 0, 0), up=(0, 0, 1)):
    """Through the centre of a pixel: half the picture's width is tan(fov/2). fov's tangent by the interval's own sine."""
    half = sin(degrees(fov) / 2) / cos(degrees(fov) / 2)
    x = half * (2 * q(column) + 1 - size[0]) / size[0]
    y = half * (size[1] - 1 - 2 * q(row)) / size[0]
    return [of(e) for e in qs(eye)], unit(plus(plus([of(g) for g in gaze], scaled(x, [of(v) for v in right])),
                                               scaled(y, [of(v) for v in up])))


def on_ball(o, d, r=1):
    b, c = dot(o, d), dot(o, o) - q(r) * q(r)
    return plus(o, scaled(-b - sqrt(b * b - c), d))


def lambert(n, l):
    value = dot(n, l)
    if value.low < 0 < value.high:
        raise ValueError("on the terminator")
    return value if value.low >= 0 else of(0)


def by_angles(n, l):
    """The same by the law of cosines: N·L = 1 − |N − L|²/2."""
    apart = plus(n, scaled(-1, l))
    value = 1 - dot(apart, apart) / 2
    return value if value.low >= 0 else of(0)


def pixel(name, title, objects, materials, column, row, value, second, formula, derivation, how, lights=None, **camera):
    return Case(SUBJECT, name, title, scene(objects, materials, lights, **{**EYE, **camera}),
                {"kind": "pixel", "column": column, "row": row},
                Truth(value, "closed form", formula, derivation), Truth(second, "interval arithmetic", formula, how), HALF_A_STEP, PIXELS)


BALL = [{"type": "sphere", "name": "ball", "material": "clay", "centre": [0, 0, 0], "radius": 1}]
CLAY = {"clay": {"k_d": [0.8, 0.5, 0.25]}}
COLOUR = (0.8, 0.5, 0.25)
BY_COSINES = "the pixel's ray meets the surface; N·L by coordinates"
BY_CHORD = "N·L = 1 − |N − L|²/2"


def tinted(share, colour=COLOUR):
    return [share * q(c) for c in colour]


def matt():
    towards = unit(qs((1, -1, 1)))
    lamp = [{"type": "directional", "direction": [1, -1, 1], "intensity": 1}]
    for column, row in ((4, 4), (6, 3), (2, 5), (5, 1), (3, 6), (0, 0)):
        o, d = eye_ray(column, row, (0, -8, 0), 20, SIZE)
        hit = reaches(o, d, (0, 0, 0), 1)
        n = on_ball(o, d) if hit else None
        value = tinted(lambert(n, towards)) if hit else [of(0)] * 3
        second = tinted(by_angles(n, towards)) if hit else [of(0)] * 3
        yield pixel(f"matt-ball-{column}-{row}", "A matt ball in parallel light" + ("" if hit else ": beside it"), BALL, CLAY, column, row,
                    value, second, MODEL,
                    BY_COSINES if hit else "the ray's distance from the centre exceeds the radius", BY_CHORD if hit else "nothing is met",
                    lamp)
    for column, row in ((4, 3), (5, 5)):
        o, d = eye_ray(column, row, (0, -8, 0), 20, SIZE)
        n = on_ball(o, d)
        two = [unit(plus([of(x) for x in p], scaled(-1, n))) for p in qs2(((3, -4, 5), (-6, -3, 0)))]
        lamps = [{"type": "point", "position": [3, -4, 5], "intensity": 0.7},
                 {"type": "point", "position": [-6, -3, 0], "intensity": [0, 0.2, 0.3]}]

        def sums(cosine):
            a, b = cosine(n, two[0]), cosine(n, two[1])
            return [q(0.1) * q(k) + q(k) * (a * q(0.7) + b * q(i)) for k, i in zip(COLOUR, (0, 0.2, 0.3))]
        yield pixel(f"two-lamps-{column}-{row}", "A matt ball by two small lamps, white and blue, in ambient light", BALL, CLAY, column,
                    row, sums(lambert), sums(by_angles),
                    MODEL, BY_COSINES, BY_CHORD, lamps, ambient=0.1)


def qs2(rows):
    return [qs(r) for r in rows]


FLOOR = {"type": "plane", "name": "floor", "material": "clay", "point": [0, 0, -1], "normal": [0, 0, 1]}


def small_source():
    """A floor below a small lamp: on its axis, off it, and behind a blocker."""
    camera = dict(eye=(0, -8, 1), look_at=(0, 0, 1), fov=60, size=SIZE)
    lamp = [{"type": "point", "position": [0, 0, 2], "intensity": 1}]
    for name, column, row, blocked in (("near-axis", 4, 5, None), ("off-axis", 1, 6, None), ("far-off", 8, 8, None),
                                       ("blocked", 4, 6, True), ("beside-blocker", 1, 6, False)):
        o, d = eye_ray(column, row, (0, -8, 1), 60, SIZE)
        p = meet(o, d, [0, 0, -1], [of(0), of(0), of(1)])
        towards = plus([of(0), of(0), of(2)], scaled(-1, p))
        cosine = 3 / sqrt(dot(towards, towards))
        value = [of(0)] * 3 if blocked else tinted(cosine)
        second = [of(0)] * 3 if blocked else tinted(cos(atan(sqrt(towards[0] * towards[0] + towards[1] * towards[1]) / 3)))
        objects = [FLOOR]
        if blocked is not None:
            centre, radius = (0, -0.1, 0.5), 0.5
            objects.append({"type": "sphere", "name": "blocker", "material": "clay", "centre": list(centre), "radius": radius})
            if reaches(p, unit(towards), centre, radius) != blocked or reaches(o, d, centre, radius):
                raise ValueError(f"{name}: the blocker does not stand where it should")
        yield pixel(f"small-lamp-{name}", f"A floor below a small lamp: {name.replace('-', ' ')}", objects, CLAY, column, row, value,
                    second, "I = k_d I_p cos θ",
                    "the line to the lamp passes through the blocker" if blocked else "cos θ = h/√(h² + s²)",
                    "the same line" if blocked else "cos atan(s/h)", lamp, **camera)


def reaches(o, d, centre, r):
    """Does the line meet the ball? Decided, or refused."""
    from_centre = plus(o, scaled(-1, qs(centre)))
    inner = dot(from_centre, d) * dot(from_centre, d) - dot(from_centre, from_centre) + q(r) * q(r)
    if inner.low <= 0 <= inner.high:
        raise ValueError("grazing")
    return inner.low > 0


def mirrored():
    """A ball's image in a mirror behind it; two mirrors; a mirror that halves."""
    towards = unit(qs((1, -1, 1)))
    lamp = [{"type": "directional", "direction": [1, -1, 1], "intensity": 1}]
    camera = dict(eye=(0, -8, 0), look_at=(0, 0, 0), fov=40, size=SIZE)
    mirror = {"type": "plane", "name": "mirror", "material": "mirror", "point": [0, 3, 0], "normal": [0, -1, 0]}
    ball = {"type": "sphere", "name": "ball", "material": "clay", "centre": [2, 0, 0], "radius": 1.5}
    # Light hits neither the back of the ball nor, through the mirror, anything: shadows alone count. Ambient light shows the back.
    for share, column, row in ((1, 5, 4), (0.5, 5, 4), (0.5, 6, 4)):
        o, d = eye_ray(column, row, (0, -8, 0), 40, SIZE)
        centre = [of(2), of(0), of(0)]
        direct = plus(o, scaled(-1, centre))
        seen_direct = reaches(o, d, (2, 0, 0), 1.5)
        if seen_direct:
            n = scaled(1 / of(q(1.5)), on_ball(direct, d, 1.5))
            value = [x + q(0.2) * q(c) for x, c in zip(tinted(lambert(n, towards)), COLOUR)]
            second = [x + q(0.2) * q(c) for x, c in zip(tinted(by_angles(n, towards)), COLOUR)]
        else:
            image = plus(o, [of(-2), of(-6), of(0)])  # the ball's image stands at y = 6
            back = reaches(o, d, (2, 6, 0), 1.5)
            turned_normal = scaled(1 / of(q(1.5)), on_ball(image, d, 1.5))
            if back and lambert([turned_normal[0], -turned_normal[1], turned_normal[2]], towards).high > 0:
                raise ValueError("the lamp lights what the mirror shows")
            value = [q(share) * q(0.2) * q(c) for c in COLOUR] if back else [of(0)] * 3
            turned = reflect(d, [of(0), of(-1), of(0)])
            on = meet(o, d, [0, 3, 0], [of(0), of(1), of(0)])
            second_hit = reaches(on, turned, (2, 0, 0), 1.5)
            second = [q(share) * q(0.2) * q(c) for c in COLOUR] if second_hit else [of(0)] * 3
        yield pixel(f"mirror-{share}-{column}-{row}",
                    f"A ball before a mirror that reflects {share}: " + ("itself" if seen_direct else "its image from behind"),
                    [ball, mirror],
                    {**CLAY, "mirror": {"k_r": share}}, column, row, [of(v) for v in value], [of(v) for v in second], "I = k_r I_R",
                    "the ball's image in the plane y = 3",
                    "the reflected ray meets the ball", lamp, **camera, ambient=0.2)
    corridor = [{"type": "plane", "name": "near", "material": "mirror", "point": [0, -9, 0], "normal": [0, 1, 0]},
                {"type": "plane", "name": "far", "material": "mirror",
                "point": [0, 1, 0], "normal": [0, -1, 0]}, {"type": "plane", "name": "ceiling", "material": "glow", "point": [0, 0, 12],
                                                            "normal": [0, 0, -1]}]
    # Straight forward and up: the ceiling is met after k reflections.
    for row in (0, 2):
        o, d = eye_ray(4, row, (0, -8, 0), 60, SIZE)
        rises = d[2] / d[1]
        way = 12 / rises  # along y until the ceiling
        k = math.floor((float(way.low) - 9) / 10) + 1
        if k != math.floor((float(way.high) - 9) / 10) + 1:
            raise ValueError("between two counts")
        value = of(q(0.8)**k)
        point, direction, count, share = o, d, 0, of(1)
        while True:
            wall = 1 if direction[1].low > 0 else -9
            there = meet(point, direction, [0, wall, 0], [of(0), of(1), of(0)])
            if there[2].low > 12:
                break
            point, direction, share, count = there, reflect(direction, [of(0), of(1), of(0)]), share * q(0.8), count + 1
        yield pixel(f"corridor-{row}", f"Between two mirrors of 0.8: {count} reflections", corridor,
                    {"mirror": {"k_r": 0.8}, "glow": {"k_d": 0.5, "k_a": 1}}, 4, row,
                    [value] * 3, [share] * 3, "I = 0.8^k", "k from the way unfolded by the mirrors", "followed from mirror to mirror", None,
                    eye=(0, -8, 0), look_at=(0, 0, 0), fov=60, size=SIZE, ambient=1)


def irradiance(name, title, objects, materials, at, normal, value, second, formula, derivation, how, kind="closed form"):
    return Case(SUBJECT, name, title, scene(objects, materials), {"kind": "irradiance", "at": list(at), "normal": list(normal)},
                Truth(value, kind, formula, derivation), Truth(second, "independent quadrature", "H = ∬ E cos α₁ cos α₂/(π r²) dA", how),
                ENERGY, WATTS)


def corner(a, b, h):
    """From a horizontal element to a rectangle a × b above it, a corner over the element."""
    a, b, h = of(q(a)), of(q(b)), of(q(h))
    u, v = sqrt(a * a + h * h), sqrt(b * b + h * h)
    return (a / u * atan(b / u) + b / v * atan(a / v)) / (2 * PI)


def signed(f, x, y):
    return (1 if x * y > 0 else -1 if x * y < 0 else 0) * (f(abs(x), abs(y)) if x * y else of(0))


def parallel_light(x_range, y_range, h):
    (x0, x1), (y0, y1) = x_range, y_range
    return sum((sign * signed(lambda a, b: corner(a, b, h), x, y) for x, y, sign in ((x1, y1, 1), (x0, y1, -1), (x1, y0, -1), (x0, y0, 1))),
               of(0))


def large_source():
    """A square lamp that emits 1 W/m², seen from points below it: on the axis, off it, outside; with half of it hidden; from the side."""
    lamp = {"lamp": {"emission": 1, "rho": 0}, "dark": {"rho": 0}}

    def square(x, y, z):
        return polygon("lamp", [(x[0], y[0], z), (x[0], y[1], z), (x[1], y[1], z), (x[1], y[0], z)], "lamp")

    def below(x, y, h):
        strips = 4
        total = of(0)
        for i in range(strips):
            for j in range(strips):
                total += over_rectangle(lambda s, t: h * h / (math.pi * (s * s + t * t + h * h)**2),
                                        (x[0] + (x[1] - x[0]) * i / strips, x[0] + (x[1] - x[0]) * (i + 1) / strips),
                                        (y[0] + (y[1] - y[0]) * j / strips, y[0] + (y[1] - y[0]) * (j + 1) / strips), 16)
        return total
    rule = "H = Σ ± C(x, y), C = (a/√(a²+h²) atan(b/√(a²+h²)) + b/√(b²+h²) atan(a/√(b²+h²)))/2π"
    for name, x, y, h in (("on-axis", (-0.5, 0.5), (-0.5, 0.5), 1), ("on-axis-near", (-1, 1), (-1, 1), 0.25),
                          ("on-axis-far", (-0.5, 0.5), (-0.5, 0.5), 8),
                          ("corner", (0, 1), (0, 2), 1), ("off-axis", (1, 2), (0.5, 1.5), 1), ("far-off", (3, 4), (-2, -1), 2)):
        yield irradiance(f"large-lamp-{name}", f"Irradiance below a lamp: {name.replace('-', ' ')}", [square(x, y, h)], lamp, (0, 0, 0),
                         (0, 0, 1), parallel_light(x, y, h),
                         below(x, y, h), rule, "the kernel integrated over a rectangle with a corner over the point, added with signs",
                         "Gauss' rules on sixteen parts")
    # Blockers halfway up: the shadow of [x0, x1] × [y0, y1] at half the height is twice as large in the lamp's plane.
    x = y = (-0.5, 0.5)
    for name, bx, kept in (("half-hidden", (-0.5, 0), (0, 0.5)), ("quarter-hidden", (-0.5, -0.125), (-0.25, 0.5)),
                           ("hidden", (-0.4, 0.4), None)):
        blocker = polygon("blocker", [(bx[0], -0.5, 0.5), (bx[1], -0.5, 0.5), (bx[1], 0.5, 0.5), (bx[0], 0.5, 0.5)], "dark")
        value = parallel_light(kept, y, 1) if kept else of(0)
        second = below(kept, y, 1) if kept else of(0)
        yield irradiance(f"large-lamp-{name}", f"Below a lamp that a plate half-way up hides: {name.replace('-', ' ')}",
                         [square(x, y, 1), blocker], lamp, (0, 0, 0), (0, 0, 1), value,
                         second, rule, "the plate's shadow from the point is twice as large in the lamp's plane; what is left is a rectangle", "Gauss' rules on what is left")
    # From the side: the receiver upright, looking along x, at a lamp overhead.
    for name, x in (("upright", (0, 1)), ("upright-apart", (1, 2))):
        def leg(a):
            a, b, h = of(q(a)), of(1), of(1)  # Siegel and Howell, B-5: upright element to the corner of a level rectangle of depth a and width b
            root = sqrt(a * a + h * h)
            return (atan(b / h) - h / root * atan(b / root)) / (2 * PI)
        value = leg(x[1]) - (leg(x[0]) if x[0] else of(0))
        second = over_rectangle(lambda s, t: s / (math.pi * (s * s + t * t + 1)**2), x, (0, 1))
        yield irradiance(f"large-lamp-{name}", f"An upright element beside a lamp overhead: {name.replace('-', ' ')}",
                         [square(x, (0, 1), 1)], lamp, (0, 0, 0), (1, 0, 0), value, second,
                         "H = (atan(b/h) − h/√(a²+h²) atan(b/√(a²+h²)))/2π", "the contour integral over the lamp's edges", "Gauss' rules")
    triangle = [(0, 0, 1), (0, 2, 1), (2, 0, 1)]
    rays = [unit(qs(p)) for p in triangle]
    total = of(0)
    for a, b in zip(rays, rays[1:] + rays[:1]):
        n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        total += acos(dot(a, b)) * n[2] / sqrt(dot(n, n))
    squeezed = over_rectangle(lambda s, t: s * 4 / (math.pi * ((2 * s * (1 - t))**2 + (2 * s * t)**2 + 1)**2), (0, 1), (0, 1))
    yield irradiance("triangular-lamp", "Irradiance below the corner of a triangular lamp", [polygon("lamp", triangle, "lamp")], lamp,
                     (0, 0, 0), (0, 0, 1), -1 * total / (2 * PI),
                     squeezed, "H = 1/2π Σ_k β_k (Γ_k · n)", "Lambert's polygon formula, in intervals",
                     "Gauss' rules on the triangle as a squeezed square")
    assert abs(point_to_polygon((0, 0, 0), (0, 0, 1), triangle) - float((-1 * total / (2 * PI)).low)) < 1e-12


def cases():
    for part in (matt(), small_source(), mirrored(), large_source()):
        yield from part
