# SPDX-License-Identifier: Apache-2.0
"""Cases on the radiosity equation B = E + ρ F B: furnaces, plates, rooms, spheres, partitions, colour. Every surface has one radiosity."""
import functools

from case import Case, Truth, around, box_walls, polygon, q, scene
from form_factors import parallel, perpendicular
from interval import Interval, of
from quadrature import parallel_exchange, perpendicular_exchange

SUBJECT = "radiosity"
RELATIVE = 1e-6
WHY = ("one millionth of the largest radiosity of the case: what single precision (2^-24 a rounding) keeps, with form factors known to seven digits")
WALLS = ("floor", "ceiling", "left", "right", "front", "back")
NEUMANN = "B = Σ_k (ρF)^k E, cut after n terms; the rest is below max E ρ^n/(1 − ρ), ρ = max ρ_i Σ_j F_ij"


def eliminate(matrix, right):
    """Gauss, on any numbers: rational ones exactly, intervals as enclosures. I − ρF has a dominant diagonal, so rows stay where they are."""
    n = len(right)
    a = [list(row) + [b] for row, b in zip(matrix, right)]
    for k in range(n):
        for i in range(k + 1, n):
            share = a[i][k] / a[k][k]
            a[i] = [x - share * y for x, y in zip(a[i], a[k])]
    result = [None] * n
    for i in reversed(range(n)):
        result[i] = (a[i][n] - sum((a[i][j] * result[j] for j in range(i + 1, n)), a[i][n] * 0)) / a[i][i]
    return result


def solve(factors, rho, emission):
    n = len(rho)
    return eliminate([[(1 if i == j else 0) - rho[i] * factors[i][j] for j in range(n)] for i in range(n)], emission)


def neumann(factors, rho, emission, digits=14):
    """The series, with its rest in the bar."""
    n = len(rho)
    rows = [float((rho[i] * sum((of(f) for f in factors[i]), Interval(0))).high) for i in range(n)]
    most, largest, left = max(rows), max(float(of(e).high) for e in emission), 1.0
    term, total = [of(e) for e in emission], [of(e) for e in emission]
    while left > 10.0**-digits:
        term = [rho[i] * sum((of(f) * t for f, t in zip(factors[i], term)), Interval(0)) for i in range(n)]
        total = [a + b for a, b in zip(total, term)]
        left *= most
    rest = largest * left * most / (1 - most)
    return [t + Interval(0, rest * (1 + 1e-9)) for t in total]


@functools.lru_cache(maxsize=None)
def room_factors(a, b, c, by):
    """6 × 6 factors of a closed room, by closed forms or by quadrature."""
    if by == "closed form":
        facing = lambda x, y, h: parallel((0, x), (0, y), (0, x), (0, y), h)
        corner = perpendicular
    else:
        facing = lambda x, y, h: parallel_exchange((0, x), (0, y), (0, x), (0, y), h)
        corner = lambda l, w, h: perpendicular_exchange(float(l), w, h)
    area = dict(zip(WALLS, (a * b, a * b, b * c, b * c, a * c, a * c)))
    normal = dict(zip(WALLS, "zzxxyy"))
    size = {"x": a, "y": b, "z": c}
    kinds = {}
    for u, v, w in ("xyz", "xzy", "yxz", "yzx", "zxy", "zyx"):
        kinds[u + v] = corner(size[w], size[v], size[u]) if u < v else None
        kinds[u + u] = facing(size[v], size[w], size[u])
    result = []
    for i in WALLS:
        row = []
        for j in WALLS:
            pair = "".join(sorted(normal[i] + normal[j]))
            row.append(of(0) if i == j else kinds[pair] / q(area[i]))
        result.append(row)
    return result


def material(rho, e):
    return {"rho": rho, "emission": e, "k_d": 0.5}


def room(name, title, size, rho, emission, ask, truth=None):
    """One closed room; `truth` where more is known than the system says."""
    materials = {w: material(rho[w], emission[w]) for w in WALLS}
    colour = isinstance(next(iter(emission.values())), list)
    channels = range(3) if colour else range(1)
    pick = lambda v, k: q(v[k]) if isinstance(v, list) else q(v)
    index, values, seconds = WALLS.index(ask), [], []
    closed = room_factors(*size, "closed form")
    for k in channels:
        r, e = [pick(rho[w], k) for w in WALLS], [pick(emission[w], k) for w in WALLS]
        values.append(solve(closed, r, [of(x) for x in e])[index])
        seconds.append(values[-1] if truth else neumann(room_factors(*size, "quadrature"), r, e)[index])
    first = Truth(values if colour else values[0], "interval arithmetic", "(I − ρF) B = E, F from closed forms",
                  "Gauss' elimination in intervals of 50 digits, each wall one zone")
    second = Truth(seconds if colour else seconds[0], "series with its rest", NEUMANN, "F by Gauss' quadrature, added up bounce by bounce")
    if truth:
        first, second = truth, first
    largest = max(float(of(v).high) for v in values)
    return Case(SUBJECT, name, title, scene(box_walls(*size, {w: w for w in WALLS}), materials),
                {"kind": "radiosity", "of": ask}, first, second, RELATIVE * max(largest, 1), WHY)


def same(value):
    return dict.fromkeys(WALLS, value)


def furnaces():
    for size, rho, e in (((1, 1, 1), 0.5, 1), ((2, 3, 1), 0.8, 2), ((1, 1, 4), 0.99, 1)):
        yield room(f"furnace-{rho}", f"A furnace {size[0]} × {size[1]} × {size[2]}: every wall emits {e} and reflects {rho}", size,
                   same(rho), same(e),
                   "floor", Truth(of(q(e)) / (1 - q(rho)), "closed form", "B = E/(1 − ρ)",
                                  "the rows of F sum to one, so a constant solves the equation"))
    for size, rho, c in (((1, 1, 1), (0.1, 0.9, 0.3, 0.5, 0.7, 0.2), 3), ((1, 2, 3), (0.9, 0.1, 0.5, 0.5, 0.25, 0.75), 1),
                         ((3, 1, 1), (0, 0.95, 0.5, 0, 0.5, 0), 10)):
        rhos = dict(zip(WALLS, rho))
        e = {w: float(q(c) * (1 - q(r))) for w, r in rhos.items()}
        yield room(f"equilibrium-{size[0]}{size[1]}{size[2]}", "Unlike walls, each emitting (1 − ρ) c: equilibrium", size, rhos, e,
                   "ceiling",
                   Truth(of(c), "closed form", "B = c", "E_i + ρ_i c = c for every wall: black-body radiation of one temperature"))
    colours = same([0.5, 0.75, 0.9])
    yield room("furnace-colour", "A furnace in three channels", (1, 1, 1), colours, same([1, 2, 0.5]), "left",
               Truth([of(2), of(8), of(5)], "closed form", "B = E/(1 − ρ), a channel at a time", "channels do not know each other"))


def rooms():
    lamp = lambda e=1: {**same(0), "ceiling": e}
    for ask in ("floor", "ceiling", "left"):
        yield room(f"grey-cube-{ask}", f"A cube of reflectance 0.5 whose ceiling emits: the {ask}", (1, 1, 1), same(0.5), lamp(), ask)
    for ask in ("floor", "back"):
        yield room(f"bright-hall-{ask}", f"A hall 4 × 2 × 1 of reflectance 0.9 whose ceiling emits: the {ask}", (4, 2, 1), same(0.9),
                   lamp(), ask)
    red_blue = {"floor": [0.5, 0.5, 0.5], "ceiling": [0.8, 0.8, 0.8], "left": [0.7, 0.1, 0.1], "right": [0.1, 0.1, 0.7],
                "front": [0.6, 0.6, 0.6],
                "back": [0.6, 0.6, 0.6]}
    for ask in ("floor", "right", "back"):
        yield room(f"colour-bleeding-{ask}", f"A red and a blue wall below a white lamp: the {ask}", (1, 1, 1), red_blue,
                   {**same([0, 0, 0]), "ceiling": [1, 1, 1]}, ask)
    yield room("shaft-floor", "A shaft 1 × 1 × 8, lit from its top", (1, 1, 8), same(0.7), lamp(100), "floor")
    yield room("black-room", "Black walls: direct light alone", (1, 1, 1), {**same(0), "floor": 0.5}, lamp(), "floor")


def plates():
    """Two plates in the void: what leaves them is lost, the rest goes to and fro."""
    for name, x, h, r1, r2, walls in (("equal", 1, 1, 0.5, 0.5, 0), ("near", 1, 0.1, 0.9, 0.9, 0), ("unlike", 2, 1, 0.2, 0.8, 0),
                                      ("black-above", 1, 1, 0.6, 0, 0), ("partition", 1, 1, 0.5, 0.5, 1),
                                      ("three-partitions", 1, 1, 0.9, 0.9, 3)):
        n = walls + 1
        strips = [((k / n, (k + 1) / n), (0, 1)) for k in range(n)] if walls else [((0, x), (0, 1))]
        f = parallel(*strips[0], *strips[0], h) * n / q(x)
        g = parallel_exchange(*strips[0], *strips[0], h) * n / q(x)
        materials = {"lamp": material(r1, 1), "other": material(r2, 0), "dark": material(0, 0)}
        objects = [polygon("lower", [(0, 0, 0), (x, 0, 0), (x, 1, 0), (0, 1, 0)], "lamp"),
                   polygon("upper", [(0, 0, h), (0, 1, h), (x, 1, h), (x, 0, h)], "other")]
        objects += [polygon(f"wall {k}{side}", [(k / n, 0, 0), (k / n, 1, 0), (k / n, 1, h), (k / n, 0, h)][::turn], "dark")
                    for k in range(1, n) for side, turn in (("a", 1), ("b", -1))]
        value = f * q(r2) / (1 - q(r1) * q(r2) * f * f) if r2 else of(1) / (1 - q(r1) * q(r2) * f * f)
        ask = "upper" if r2 else "lower"
        second = neumann([[of(0), g], [g, of(0)]], [q(r1), q(r2)], [1, 0])[1 if r2 else 0]
        yield Case(SUBJECT, f"plates-{name}",
                   f"Two plates {x} × 1 at distance {h}, the lower one emits" + (f", {walls} black partitions between" if walls else ""),
                   scene(objects, materials), {"kind": "radiosity", "of": ask},
                   Truth(value, "closed form", "B_1 = 1/(1 − ρ₁ρ₂F²), B_2 = ρ₂ F B_1",
                         "the geometric series of bounces; F from its closed form"
                         + (": n times that of one stall" if walls else "")),
                   Truth(second, "series with its rest", NEUMANN, "F by Gauss' quadrature, added up bounce by bounce"), RELATIVE, WHY)


def system(name, title, factors, rho, emission, truth, why=WHY, share=RELATIVE):
    """No geometry: the equation itself."""
    exact = solve([[q(f) for f in row] for row in factors], [q(r) for r in rho], [q(e) for e in emission])
    largest = max(float(x) for x in exact)
    return Case(SUBJECT, name, title, None, {"kind": "radiosities", "factors": [[float(f) for f in row] for row in factors],
                                             "reflectance": rho,
                "emission": emission}, truth, Truth([around(x, share * largest * 2.0**-20) for x in exact], "exact arithmetic",
                                                    "(I − ρF) B = E",
                "Gauss' elimination on rational numbers; the bar is for factors that have no finite decimals"), share * max(largest, 1),
                why)


def sphere(name, title, areas, rho, emission):
    """Within a closed sphere F_ij = A_j/A from everywhere, so the irradiance is one number."""
    total = sum(q(a) for a in areas)
    lit = sum(q(a) * q(e) for a, e in zip(areas, emission)) / total
    back = sum(q(a) * q(r) for a, r in zip(areas, rho)) / total
    h = lit / (1 - back)
    truth = Truth([of(q(e) + q(r) * h) for e, r in zip(emission, rho)], "closed form",
                  "B_i = E_i + ρ_i H, H = Σ a_j E_j/(1 − Σ a_j ρ_j), a_j = A_j/A",
                  "from any point of a sphere equal areas are seen under equal factors")
    return system(name, title, [[q(a) / total for a in areas]] * len(areas), rho, emission, truth)


def spheres():
    yield sphere("sphere-uniform", "Internal reflection in a closed sphere, one zone", [1], [0.5], [1])
    yield sphere("sphere-halves", "A sphere with a bright and a dark half, the dark one emits", [1, 1], [0.9, 0.1], [0, 2])
    yield sphere("sphere-port", "An integrating sphere of reflectance 0.98 with a black port of one hundredth", [98, 1, 1], [0.98, 0, 0.98],
                 [0, 0, 50])
    yield sphere("sphere-zones", "A sphere of ten zones", list(range(1, 11)), [k / 10 for k in range(10)], [1, 0, 0, 4, 0, 0, 0, 0, 2, 0])
    yield sphere("sphere-bright", "A sphere that reflects 0.999: a thousand bounces", [1, 3], [0.999, 0.999], [1, 0])


def systems():
    for r1, r2, e2 in ((0.5, 0.5, 0), (0.2, 0.9, 3)):
        d = 1 - q(r1) * q(r2)
        yield system(f"infinite-plates-{r1}-{r2}", "Infinite parallel plates", [[0, 1], [1, 0]], [r1, r2], [1, e2],
                     Truth([of((1 + q(r1) * q(e2)) / d), of((q(e2) + q(r2)) / d)], "closed form", "B_1 = (E_1 + ρ₁E_2)/(1 − ρ₁ρ₂)",
                           "all that leaves one plate meets the other"))
    for k, r1, r2 in ((2, 0.5, 0.5), (4, 0.3, 0.8)):
        f = q(1) / (k * k)  # inner sphere of radius 1, outer of radius k
        b1, b2 = (1 - q(r2) * (1 - f)), q(r2) * f
        d = b1 - q(r1) * b2
        yield system(f"concentric-spheres-{k}", f"Concentric spheres, the outer one {k} times as large, the inner one emits",
                     [[0, 1], [f, 1 - f]], [r1, r2], [1, 0],
                     Truth([of(b1 / d), of(b2 / d)], "closed form", "F_21 = (r_1/r_2)², F_22 = 1 − F_21; Cramer's rule",
                           "the inner sphere sends all to the outer one; reciprocity and closure give the rest"))
    yield system("nearly-lossless", "Two plates that absorb one millionth: nearly singular", [[0, 1], [1, 0]], [0.999999, 0.999999], [1, 1],
                 Truth([of(1) / (1 - q(0.999999))] * 2, "closed form", "B = E/(1 − ρ)", "a furnace of a million bounces"),
                 "one millionth of the answer: a condition of 10⁶ on roundings of 2^-53 is 10^-10, a ten-thousandth of it", RELATIVE)


def solids():
    """Closed sphere approximated by few faces: a furnace is exact on each; in a tetrahedron symmetry says the rest."""
    p = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = [polygon(f"face {a}{b}{c}", [p[i] for i in ((a, c, b) if (a + b + c) % 2 == 0 else (a, b, c))], "glow") for a in (0,
        1) for b in (2, 3) for c in (4, 5)]
    yield Case(SUBJECT, "octahedron", "A furnace in the shape of an octahedron: the coarsest closed sphere",
               scene(faces, {"glow": material(0.75, 1)}),
               {"kind": "radiosity", "of": "face 024"}, Truth(of(4), "closed form", "B = E/(1 − ρ)",
                                                              "the rows of F sum to one in any closed shape"),
               Truth(neumann([[of(1)]], [q(0.75)], [1])[0], "series with its rest", NEUMANN, "all faces are alike: one zone"), 4 * RELATIVE,
               WHY)
    c = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    index = {"one": (0, 2, 1), "two": (0, 1, 3), "three": (0, 3, 2), "four": (1, 2, 3)}
    for rho, ask in ((0.5, "one"), (0.5, "two"), (0.9, "four")):
        r = q(rho)
        third = [[of(0) if i == j else of(1) / 3 for j in range(4)] for i in range(4)]
        d = (1 - r / 3 * 2) - r * r / 3
        value = (1 - r * 2 / 3) / d if ask == "one" else r / 3 / d
        objects = [polygon(n, [c[i] for i in f], "lamp" if n == "one" else "grey") for n, f in index.items()]
        yield Case(SUBJECT, f"tetrahedron-{rho}-{ask}", f"A regular tetrahedron, one face emits, all reflect {rho}: face {ask}",
                   scene(objects, {"lamp": material(rho, 1), "grey": material(rho, 0)}), {"kind": "radiosity", "of": ask},
                   Truth(of(value), "exact arithmetic", "F_ij = 1/3: B_1 = (1 − 2ρ/3)/D, B_2 = ρ/3/D, D = 1 − 2ρ/3 − ρ²/3",
                         "two zones by symmetry"),
                   Truth(neumann(third, [r] * 4, [1, 0, 0, 0])[list(index).index(ask)], "series with its rest", NEUMANN,
                         "four zones, bounce by bounce"),
                   2 * RELATIVE, WHY)


def blocked():
    """A closed room, cut in two by a wall: nothing passes."""
    a = box_walls(1, 1, 1, {"ceiling": "lamp"})
    b = [{**o, "name": o["name"] + " beyond", "vertices": [[v[0] + 1, v[1], v[2]] for v in o["vertices"]],
          "material": "grey"} for o in box_walls(1, 1, 1)]
    materials = {"plain": material(0.5, 0), "grey": material(0.5, 0), "lamp": material(0.5, 1)}
    yield Case(SUBJECT, "next-room", "The floor of the dark room behind the wall of a lit one", scene(a + b, materials),
               {"kind": "radiosity", "of": "floor beyond"},
               Truth(of(0), "exact arithmetic", "B = 0", "both rooms are closed, and the other one has no light"),
               Truth(of(0), "other method", "B = (I − ρF)^-1 0", "the equation of the dark room has no right-hand side"), RELATIVE, WHY)


def cases():
    for part in (furnaces(), rooms(), plates(), spheres(), systems(), solids(), blocked()):
        yield from part
