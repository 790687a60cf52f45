# SPDX-License-Identifier: Apache-2.0
"""How a case is put together: scene, question, two truths, tolerance. Numbers in a case are meant as they are written, as decimals."""
import dataclasses
import fractions

from interval import Interval, of

RELATIVE = 1e-6
SINGLE = ("one millionth of the largest value the answer can have: what arithmetic in single precision (2^-24 a rounding) keeps through some "
          "sixteen roundings, so that the formula is judged and not the precision")


def q(x):
    """The number as it is written."""
    return fractions.Fraction(repr(x)) if isinstance(x, float) else fractions.Fraction(x)


def qs(v):
    return [q(x) for x in v]


@dataclasses.dataclass
class Truth:
    value: object  # an Interval, a list of them, or "none"
    kind: str  # closed form | exact arithmetic | interval arithmetic | independent quadrature | series with its rest | other method
    formula: str
    derivation: str

    def data(self):
        said = {"kind": self.kind, "formula": self.formula, "derivation": self.derivation}
        if self.value == "none":
            return {"none": True, **said}
        if isinstance(self.value, list):
            ends = [of(v).doubles() for v in self.value]
            return {"low": [e[0] for e in ends], "high": [e[1] for e in ends], **said}
        low, high = of(self.value).doubles()
        return {"low": low, "high": high, **said}


@dataclasses.dataclass
class Case:
    subject: str
    name: str
    title: str
    scene: object  # None where the question says all
    question: dict
    truth: Truth
    second: Truth
    tolerance: float
    why: str

    def data(self, module):
        return {"$schema": "../case.schema.json", "format": "etendue-case", "version": 1,
                "id": f"{self.subject.replace(' ', '-')}/{self.name}", "subject": self.subject, "title": self.title,
                **({"scene": self.scene} if self.scene else {}), "question": self.question, "truth": self.truth.data(),
                "second": self.second.data(), "tolerance": {"value": self.tolerance, "from": self.why},
                "provenance": f"derived and computed by validation/reference/grade_cases/{module}.py; Apache-2.0"}


def scene(objects, materials=None, lights=None, eye=(0.5, -9, 0.5), look_at=(0.5, 0, 0.5), up=(0, 0, 1), fov=30, size=(1, 1), **more):
    """A scene in the project's format (docs/scene-format.md), in metres."""
    return {"format": "etendue-scene", "version": 1, "unit": "m",
            "camera": {"eye": list(eye), "look_at": list(look_at), "up": list(up), "horizontal_fov_deg": fov, "resolution": list(size)},
            **more, "materials": materials or {"plain": {"k_d": 0.5}}, **({"lights": lights} if lights else {}), "objects": objects}


def polygon(name, vertices, material="plain"):
    return {"type": "polygon", "name": name, "material": material, "vertices": [list(v) for v in vertices]}


def box_walls(a, b, c, materials=None):
    """The six walls of a × b × c, facing inwards."""
    corners = {
        "floor": [(0, 0, 0), (a, 0, 0), (a, b, 0), (0, b, 0)], "ceiling": [(0, 0, c), (0, b, c), (a, b, c), (a, 0, c)],
        "left": [(0, 0, 0), (0, b, 0), (0, b, c), (0, 0, c)], "right": [(a, 0, 0), (a, 0, c), (a, b, c), (a, b, 0)],
        "front": [(0, 0, 0), (0, 0, c), (a, 0, c), (a, 0, 0)], "back": [(0, b, 0), (a, b, 0), (a, b, c), (0, b, c)]}
    return [polygon(name, v, (materials or {}).get(name, "plain")) for name, v in corners.items()]


def around(value, bar):
    return of(value) + Interval(-bar, bar)
