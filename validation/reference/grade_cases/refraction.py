# SPDX-License-Identifier: Apache-2.0
"""Cases on refraction: Snell's law, total internal reflection on either side of the critical angle, slabs, prisms, balls, Fresnel's
shares, what glass lets through."""
from case import Case, Truth, polygon, q, qs, scene
from interval import PI, Interval, acos, asin, atan, cos, dot, exp, of, plus, scaled, sin, sqrt, unit

SUBJECT = "refraction"
UNITS = ("one millionth of the direction's length: formulas differ by more than that, roundings of single precision (2^-24) by less, except "
         "near the critical angle, where double precision is needed")
PLACE = ("one millionth of the scene's size: a few roundings of single precision; of a picture that encodes places in colours it takes a few, each "
         "looking closer")
SHARES = "one millionth of the whole: what single precision keeps"
TOLERANCE = 1e-6
VECTOR = "the tangential part of n d is the same on both sides; the normal part makes the length right. In intervals of 50 digits"
ANGLES = "the angles by arcus sine, in intervals of 50 digits"
GLASS = {"k_t": 1}


def glass(eta, **more):
    return {**GLASS, "eta": eta, **more}


def refract(d, n, eta):
    """Unit d meets unit n (against d); eta = index before / index behind. None where the reflection is total."""
    c = -dot(d, n)
    radicand = 1 - eta * eta * (1 - c * c)
    if radicand.high < 0:
        return None
    if radicand.low < 0:
        raise ValueError("not decided: at the critical angle")
    return plus(scaled(eta, d), scaled(eta * c - sqrt(radicand), n))


def reflect(d, n):
    return plus(d, scaled(-2 * dot(d, n), n))


def meet(origin, d, point, n):
    """Where the ray meets a plane."""
    t = dot([of(b) - a for a, b in zip(origin, point)], n) / dot(d, n)
    return plus(origin, scaled(t, d))


def case(name, title, objects, materials, question, truth, second, tolerance=TOLERANCE, why=UNITS):
    return Case(SUBJECT, name, title, scene(objects, materials), question, truth, second, tolerance, why)


def ask(kind, origin, direction, events=None, **more):
    return {"kind": kind, "origin": list(origin), "direction": list(direction), **({"events": events} if events else {}), **more}


def snell():
    """A horizontal surface of glass, met at tan θ = slope."""
    block = [{"type": "box", "name": "block", "material": "glass", "low": [-50, -50, -50], "high": [50, 50, 0]}]
    for eta, slope in ((1.33, 0.25), (1.5, 0), (1.5, 1), (1.5, 3), (2.4, 10), (0.8, 0.5)):
        s, n = of(q(slope)), q(eta)
        length = sqrt(1 + s * s)
        sine = s / (length * n)
        value = [sine, of(0), -sqrt(1 - sine * sine)]
        angle = asin(sin(atan(s)) / n)
        yield case(f"snell-{eta}-{slope}", f"From air into a body of index {eta}, tan θ = {slope}", block, {"glass": glass(eta)},
                   ask("direction", (0, 0, 1), (slope, 0, -1), ["transmit"]),
                   Truth(value, "closed form", "sin θ' = sin θ/n, T = (sin θ', 0, −√(1 − sin² θ'))", VECTOR),
                   Truth([sin(angle), of(0), -cos(angle)], "interval arithmetic", "θ = atan(slope), θ' = asin(sin θ/n)", ANGLES))
    # A sphere's surface turns the frame: met at (1, 2, 2)/3 from straight above.
    n, d, eta = [of(q(x)) / 3 for x in (1, 2, 2)], [of(0), of(0), of(-1)], 1 / of(q(1.5))
    across = unit([n[0], n[1], of(0)])
    turn = acos(n[2]) - asin(sin(acos(n[2])) * eta)
    yield case("snell-on-a-ball", "Straight down onto a ball of glass, off its axis in two directions",
               [{"type": "sphere", "name": "ball", "material": "glass", "centre": [0, 0, 0], "radius": 3}], {"glass": glass(1.5)},
               ask("direction", (1, 2, 9), (0, 0, -1), ["transmit"]),
               Truth(refract(d, n, eta), "closed form", "T = η d + (η c − √(1 − η²(1 − c²))) N, N = (1, 2, 2)/3", VECTOR),
               Truth([-across[0] * sin(turn), -across[1] * sin(turn), -cos(turn)], "interval arithmetic",
                     "turned by θ − θ' towards −N's horizontal part", ANGLES))


def critical():
    """Into the top of a cube of index 1.25, out of its side: total if n² − sin² θ > 1, which is at sin θ = 3/4, tan θ = 1.13389…"""
    block = [{"type": "box", "name": "block", "material": "glass", "low": [-1, -1, -1], "high": [1, 1, 1]}]
    for slope in (1.1, 1.1338, 1.13389, 1.1339, 1.134, 1.2, 2):
        s, n = of(q(slope)), of(q(1.25))
        square = s * s / (1 + s * s)
        left = 1 - n * n + square
        total = left.high < 0
        value = "none" if total else [sqrt(left), of(0), -sqrt(n * n - square)]
        inside = asin(sin(atan(s)) / n)
        steep = n * cos(inside)  # sine of the angle outside
        second = "none" if steep.low > 1 else [cos(asin(steep)), of(0), -steep]
        question = ask("direction", (float(q(0.5) - q(slope)), 0, 2), (slope, 0, -1), ["transmit", "transmit"])
        yield case(f"critical-{slope}", f"Out of the side of a block: {'beyond' if total else 'before'} the critical angle, tan θ = {slope} where 1.133893… is critical",
                   block, {"glass": glass(1.25)}, question,
                   Truth(value, "exact arithmetic" if total else "closed form",
                         "n² − sin² θ ≷ 1; T = (√(1 − n² + sin² θ), 0, −√(n² − sin² θ))",
                         "two right-angled refractions; sin² θ is rational, so the side is decided exactly"),
                   Truth(second, "interval arithmetic", "n cos θ' ≷ 1 with θ' = asin(sin θ/n)", ANGLES))
    retro = [polygon("x", [(0, 0, 0), (0, 9, 0), (0, 9, 9), (0, 0, 9)], "mirror"),
             polygon("y", [(0, 0, 0), (0, 0, 9), (9, 0, 9), (9, 0, 0)], "mirror"),
             polygon("z", [(0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0)], "mirror")]
    d = unit(qs((-1, -2, -3)))
    there = d
    for axis in range(3):
        there = reflect(there, [of(1 if k == axis else 0) for k in range(3)])
    yield case("corner-reflector", "Three mirrors at right angles send light back", retro, {"mirror": {"k_r": 1}},
               ask("direction", (3, 5, 7), (-1, -2, -3), ["reflect", "reflect", "reflect"]),
               Truth([-x for x in d], "closed form", "R = −d", "each mirror turns one sign"),
               Truth(there, "interval arithmetic", "R = d − 2 (d·N) N, three times", "the law of reflection"))


def wall_below(z):
    return {"type": "plane", "name": "wall", "material": "wall", "point": [0, 0, z], "normal": [0, 0, 1]}


def slabs():
    """Parallel faces: shifted, not turned."""
    for eta, thick, sx, sy in ((1.5, 1, 0, 0), (1.5, 1, 1, 0), (1.33, 2, 0.5, -0.25), (2.4, 0.5, 2, 1), (1.5, 3, 0, 4)):
        d = unit(qs((sx, sy, -1)))
        inside = refract(d, [of(0), of(0), of(1)], 1 / of(q(eta)))
        top = [of(q(sx)), of(q(sy)), of(0)]
        bottom = meet(top, inside, [0, 0, -q(thick)], [of(0), of(0), of(1)])
        traced = meet(bottom, d, [0, 0, -4], [of(0), of(0), of(1)])
        slope = sqrt(of(q(sx)) * q(sx) + q(sy) * q(sy))
        angle = atan(slope)
        shift = q(thick) * (sin(angle) / cos(angle) - sin(asin(sin(angle) / q(eta))) / cos(asin(sin(angle) / q(eta))))
        along = [of(0), of(0)] if sx == sy == 0 else [of(q(sx)) / slope, of(q(sy)) / slope]
        formula = [q(sx) * 5 - along[0] * shift, q(sy) * 5 - along[1] * shift, of(-4)]
        slab = {"type": "box", "name": "slab", "material": "glass", "low": [-40, -40, -thick], "high": [40, 40, 0]}
        yield case(f"slab-{eta}-{thick}-{sx}-{sy}", f"Through a slab of index {eta}, {thick} thick, onto the wall behind",
                   [slab, wall_below(-4)],
                   {"glass": glass(eta), "wall": {"k_d": 0.5}}, ask("landing", (0, 0, 1), (sx, sy, -1), on="wall"),
                   Truth(formula, "closed form", "shifted back along the surface by h (tan θ − tan θ')", ANGLES),
                   Truth(traced, "interval arithmetic", "two refractions and three intersections", VECTOR), TOLERANCE * 20, PLACE)


def prisms():
    """A mesh with an edge at the top: apex (0, y, 1), base z = 0, x = ±m."""
    for m, eta, slope, end in ((0.5, 1.5, 0.1, "direction"), (0.5, 1.5, 0.1, "landing"), (0.25, 1.33, 0, "direction"),
                               (0.5, 1.6, 0.2, "direction")):
        e = of(q(eta))
        left, right = unit([of(-1), of(0), of(q(m))]), unit([of(1), of(0), of(q(m))])
        origin, d = qs((-3, 0, 0.25)), unit(qs((1, 0, slope)))
        inside = refract(d, left, 1 / e)
        out = refract(inside, scaled(-1, right), e)
        apex = 2 * atan(of(q(m)))
        lift, tilt = atan(of(q(slope))), atan(of(q(m)))
        first = lift + tilt  # from the left face's normal, which points back and up by atan(m)
        behind = apex - asin(sin(first) / e)
        turned = lift - (first + asin(sin(behind) * e) - apex)
        mesh = {"type": "mesh", "name": "prism", "material": "glass", "vertices": [[-m, -2, 0], [m, -2, 0], [0, -2, 1], [-m, 2, 0],
            [m, 2, 0], [0, 2, 1]],
                "triangles": [[0, 1, 2], [3, 5, 4]], "quads": [[0, 2, 5, 3], [1, 4, 5, 2], [0, 3, 4, 1]]}
        wall = {"type": "plane", "name": "wall", "material": "wall", "point": [4, 0, 0], "normal": [-1, 0, 0]}
        on_right = meet(meet(origin, d, [0, 0, 1], left), inside, [0, 0, 1], right)
        if end == "direction":
            truths = [cos(turned), of(0), sin(turned)], out
        else:
            height = on_right[2] + (4 - on_right[0]) * sin(turned) / cos(turned)
            truths = [of(4), of(0), height], meet(on_right, out, [4, 0, 0], [of(1), of(0), of(0)])
        question = ask(end, (-3, 0, 0.25), (1, 0, slope), *([["transmit", "transmit"]] if end == "direction" else []),
                       **({"on": "wall"} if end == "landing" else {}))
        yield case(f"prism-{m}-{eta}-{slope}-{end}", f"Through a prism of half angle atan {m}, index {eta}: {end}", [mesh, wall],
                   {"glass": glass(eta), "wall": {"k_d": 0.5}},
                   question, Truth(truths[0], "closed form", "deviation D = θ_1 + θ_4 − A, θ_2 + θ_3 = A", ANGLES),
                   Truth(truths[1], "interval arithmetic", "two refractions at the faces' normals", VECTOR),
                   TOLERANCE * (10 if end == "landing" else 1), PLACE if end == "landing" else UNITS)


def balls():
    """Off its axis by b, a ball turns light by 2 (θ − θ'), with one reflection inside by π + 2θ − 4θ'."""
    for b, eta, inner in ((0.25, 1.5, 0), (0.5, 1.33, 0), (0.9, 2, 0), (0.75, 1.33, 1), (0.86, 1.33, 1), (0.5, 1.33, 2)):
        theta, e = asin(of(q(b))), of(q(eta))
        behind = asin(of(q(b)) / e)
        turn = 2 * (theta - behind) + inner * (PI - 2 * behind)
        point, d = [-sqrt(1 - of(q(b)) * q(b)), of(q(b)), of(0)], [of(1), of(0), of(0)]
        d = refract(d, point, 1 / e)
        for k in range(inner + 1):
            point = plus(point, scaled(-2 * dot(point, d), d))
            d = reflect(d, point) if k < inner else refract(d, scaled(-1, point), e)
        yield case(f"ball-{b}-{eta}-{inner}", f"Through a ball of index {eta}, off its axis by {b} radii, {inner} reflections inside",
                   [{"type": "sphere", "name": "ball", "material": "glass", "centre": [0, 0, 0], "radius": 1}],
                   {"glass": glass(eta, fresnel=True)},
                   ask("direction", (-3, b, 0), (1, 0, 0), ["transmit"] + ["reflect"] * inner + ["transmit"]),
                   Truth([cos(turn), -sin(turn), of(0)], "closed form", "turned by 2(θ − θ') + k (π − 2θ'), sin θ = b", ANGLES),
                   Truth(d, "interval arithmetic", "refraction, k reflections, refraction, by vectors", VECTOR))
    b, eta = 0.5, 1.5
    theta, behind = asin(of(q(b))), asin(of(q(b)) / q(eta))
    turn = 2 * (theta - behind)
    leaves = [-cos(PI - 2 * behind + theta), sin(PI - 2 * behind + theta)]
    point = [-sqrt(of(1) - q(b) * q(b)), of(q(b)), of(0)]
    d = refract([of(1), of(0), of(0)], point, 1 / of(q(eta)))
    out = plus(point, scaled(-2 * dot(point, d), d))
    behind_wall = meet(out, refract(d, scaled(-1, out), of(q(eta))), [4, 0, 0], [of(1), of(0), of(0)])
    height = leaves[1] - (4 - leaves[0]) * sin(turn) / cos(turn)
    yield case("ball-landing", "A ball as a lens: where the light lands",
               [{"type": "sphere", "name": "ball", "material": "glass", "centre": [0, 0, 0], "radius": 1},
               {"type": "plane", "name": "wall", "material": "wall", "point": [4, 0, 0], "normal": [-1, 0, 0]}],
               {"glass": glass(eta), "wall": {"k_d": 0.5}},
               ask("landing", (-3, b, 0), (1, 0, 0), on="wall"),
               Truth([of(4), height, of(0)], "closed form", "leaves at the angle θ + π − 2θ' around the ball, turned by 2(θ − θ')", ANGLES),
               Truth(behind_wall, "interval arithmetic", "two refractions, three intersections", VECTOR), TOLERANCE * 10, PLACE)


def mirrors():
    for name, normal, point in (("level", (0, 0, 1), (0, 0, 0)), ("tilted", (1, 2, 4), (0, 0, 0))):
        origin, d = qs((0, 0, 2)), qs((1, 0, -3))
        n = unit(qs(normal))
        hit = meet(origin, d, point, n)
        traced = meet(hit, reflect([of(x) for x in d], n), [0, 0, 5], [of(0), of(0), of(1)])
        image = plus(origin, scaled(-2 * dot(origin, n), n))  # the ray's origin behind the mirror
        seen = meet(image, [a - b for a, b in zip(hit, image)], [0, 0, 5], [of(0), of(0), of(1)])
        yield case(f"mirror-{name}", f"By a {name} mirror onto the ceiling",
                   [{"type": "plane", "name": "mirror", "material": "mirror", "point": list(point),
                   "normal": list(normal)}, {"type": "plane", "name": "ceiling", "material": "wall", "point": [0, 0, 5],
                                             "normal": [0, 0, -1]}],
                   {"mirror": {"k_r": 1}, "wall": {"k_d": 0.5}}, ask("landing", (0, 0, 2), (1, 0, -3), on="ceiling"),
                   Truth(traced, "interval arithmetic", "R = d − 2 (d·N) N", "the law of reflection, two intersections"),
                   Truth(seen, "closed form", "on the line from the mirror image of the origin",
                         "the image of the ray's origin, seen through the point of reflection"),
                   TOLERANCE * 10, PLACE)


def fresnel(c, eta):
    """Unpolarised share that is reflected, by cosines; eta the index behind, relative."""
    inside = sqrt(1 - (1 - c * c) / (eta * eta))
    s, p = (c - eta * inside) / (c + eta * inside), (eta * c - inside) / (eta * c + inside)
    return (s * s + p * p) / 2


def by_angles(theta, eta):
    behind = asin(sin(theta) / eta)
    less, more = theta - behind, theta + behind
    s, p = sin(less) / sin(more), sin(less) * cos(more) / (cos(less) * sin(more))
    return (s * s + p * p) / 2


def shares():
    block = [{"type": "box", "name": "block", "material": "glass", "low": [-90, -90, -9], "high": [90, 90, 0]}]
    for eta, slope in ((1.5, 0), (1.5, 0.5), (1.5, 1.5), (1.33, 3), (2.4, 1), (1.5, 20)):
        c = 1 / sqrt(1 + of(q(slope)) * q(slope))
        e = of(q(eta))
        second = (e - 1) * (e - 1) / ((e + 1) * (e + 1)) if slope == 0 else by_angles(atan(of(q(slope))), e)
        yield case(f"fresnel-{eta}-{slope}",
                   f"Share that glass of index {eta} reflects, tan θ = {slope}" + (" (Brewster's angle)" if slope == eta else ""),
                   block, {"glass": glass(eta, fresnel=True)}, ask("share", (0, 0, 1), (slope, 0, -1), ["reflect"]),
                   Truth(fresnel(c, e), "closed form", "F = ½ (r_s² + r_p²), r_s = (c − n c')/(c + n c'), r_p = (n c − c')/(n c + c')",
                         "unpolarised light, by cosines"),
                   Truth(second, "interval arithmetic", "r_s = sin(θ−θ')/sin(θ+θ'), r_p = tan(θ−θ')/tan(θ+θ'); ((n−1)/(n+1))² at θ = 0",
                         ANGLES), TOLERANCE, SHARES)
    for eta, sigma, thick, slope in ((1.5, 0, 1, 0), (1.5, 0, 1, 1), (1.52, 0.5, 1, 0.75), (1.33, 2, 0.5, 2)):
        c, e = 1 / sqrt(1 + of(q(slope)) * q(slope)), of(q(eta))
        inside = sqrt(1 - (1 - c * c) / (e * e))
        value = (1 - fresnel(c, e)) * (1 - fresnel(c, e)) * exp(-(q(sigma) * q(thick) / inside))
        theta = atan(of(q(slope)))
        back = (e - 1) * (e - 1) / ((e + 1) * (e + 1)) if slope == 0 else by_angles(theta, e)
        second = (1 - back) * (1 - back) * exp(-(q(sigma) * q(thick) / cos(asin(sin(theta) / e))))
        pane = [{"type": "box", "name": "pane", "material": "glass", "low": [-90, -90, -thick], "high": [90, 90, 0]}]
        yield case(f"pane-{eta}-{sigma}-{thick}-{slope}",
                   f"What a pane of index {eta}, {thick} thick, absorption {sigma}/m, lets straight through", pane,
                   {"glass": glass(eta, fresnel=True, absorption=sigma)}, ask("share", (0, 0, 1), (slope, 0, -1), ["transmit", "transmit"]),
                   Truth(value, "closed form", "(1 − F)² exp(−σ h/cos θ')", "no light that was reflected inside; F by cosines"),
                   Truth(second, "interval arithmetic", "the same, F by sines of θ ± θ'", ANGLES), TOLERANCE, SHARES)


def cases():
    for part in (snell(), critical(), slabs(), prisms(), balls(), mirrors(), shares()):
        yield from part
