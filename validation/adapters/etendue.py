#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Answers cases of `etendue-validate grade` by the program etendue: the protocol on one side, its command line on the other.

usage: validation/adapters/etendue.py [PROGRAM] CASE      PROGRAM: etendue, by default that of the release build
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import exr

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "build/release/bin/etendue"


class Etendue:
    def __init__(self, program, case, folder):
        self.program, self.case, self.folder = program, case, pathlib.Path(folder)
        self.question = case["question"]

    def run(self, *words):
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True, cwd=self.folder, check=False)
        if done.returncode not in (0, 4):  # 4: less exact than asked by default; the tolerance judges that
            sys.exit(f"etendue {words[0]} ended with {done.returncode}: {done.stderr.strip()}")
        return done.stdout

    def scene(self, **changes):
        path = self.folder / "scene.json"
        path.write_text(json.dumps({**self.case["scene"], **changes}))
        return path

    def factors(self):
        self.run("form-factors", self.scene(), "--quiet", "--threads", 1, "-o", "factors.json")
        return json.loads((self.folder / "factors.json").read_text())

    def form_factor(self):
        return json.loads(self.run("form-factors", self.scene(), "--pair", self.question["from"], self.question["to"], "--json",
                                   "--threads", 1))["factor"]

    def form_factor_sum(self):
        found = self.factors()
        return found["row_sums"][found["names"].index(self.question["from"])]

    def solved_system(self, factors, reflectance, emission):
        """Rows of radiosities, a column a channel."""
        for name, rows in (("factors", factors), ("reflectance", reflectance), ("emission", emission)):
            (self.folder / f"{name}.csv").write_text("\n".join(",".join(map(repr, row)) for row in rows) + "\n")
        table = self.run("solve", "--factors", "factors.csv", "--reflectance", "reflectance.csv", "--emission", "emission.csv", "--threads",
                         1)
        names, *rows = [line.split(",") for line in table.splitlines() if line]
        wanted = [i for i, name in enumerate(names) if name.startswith("radiosity")]
        return [[float(row[i]) for i in wanted] for row in rows]

    def radiosities(self):
        given = self.question
        return [row[0] for row in self.solved_system(given["factors"], [[r] for r in given["reflectance"]],
                                                     [[e] for e in given["emission"]])]

    def radiosity(self):
        """Form factors, then the equation: one radiosity a surface. `etendue solve SCENE` does both, and a picture."""
        found, materials = self.factors(), self.case["scene"]["materials"]
        by_name = {o["name"]: materials[o["material"]] for o in self.case["scene"]["objects"]}
        columns = max(len(v) if isinstance(v, list) else 1 for m in materials.values() for v in (m.get("rho", 0), m.get("emission", 0)))

        def table(key):
            values = [by_name[name].get(key, 0) for name in found["names"]]
            return [v if isinstance(v, list) else [v] * columns for v in values]
        row = self.solved_system(found["F"], table("rho"), table("emission"))[found["names"].index(self.question["of"])]
        return row if columns > 1 else row[0]

    def irradiance(self):
        sensor = {"name": "sensor", "position": self.question["at"], "normal": self.question["normal"]}
        text = {"format": "etendue-sensors", "version": 1, "unit": "m", "sensors": [sensor]}
        (self.folder / "sensors.json").write_text(json.dumps(text))
        self.run("solve", self.scene(), "--quiet", "--threads", 1, "--samples", 1, "--sensors", "sensors.json", "-o", "solved.png")
        names, values = (self.folder / "solved.sensors.csv").read_text().splitlines()[:2]
        return float(values.split(",")[names.split(",").index("irradiance_red")])

    def rays(self):
        """The tree behind the one pixel of a camera that looks along the ray."""
        gaze = self.question["direction"]
        up = [0, 0, 1] if abs(gaze[0]) + abs(gaze[1]) > abs(gaze[2]) else [1, 0, 0]
        camera = {"eye": self.question["origin"], "gaze": gaze, "up": up, "horizontal_fov_deg": 1, "resolution": [1, 1]}
        return json.loads(self.run("ray-tree", self.scene(camera=camera), "--pixel", 0, 0, "--json"))["rays"]

    @staticmethod
    def after(rays, ray, event):
        kind = {"transmit": "transmitted", "reflect": "reflected"}[event]
        index = rays.index(ray)
        return next((r for r in rays if r["parent"] == index and r["kind"] == kind), None)

    def followed(self):
        rays = self.rays()
        ray = rays[0]
        for event in self.question["events"]:
            ray = ray and self.after(rays, ray, event)
        return ray

    def direction(self):
        ray = self.followed()
        return ray["direction"] if ray else "none"

    def share(self):
        ray = self.followed()
        return ray["weight"] if ray else "none"

    def hit(self):
        ray = self.rays()[0]
        return ray["length"] if ray["end"] == "surface" else "none"

    def landing(self):
        rays = self.rays()
        ray = rays[0]
        while ray and not (ray["end"] == "surface" and ray["object"]["name"] == self.question["on"]):
            ray = self.after(rays, ray, "transmit") or self.after(rays, ray, "reflect")
        return ray["point"] if ray else "none"

    def pixel(self):
        self.run("render", self.scene(), "--quiet", "--threads", 1, "--samples", 1, "-o", "picture.exr")
        return exr.pixel(self.folder / "picture.exr", self.question["column"], self.question["row"])


def main():
    *program, path = sys.argv[1:] or sys.exit(__doc__)
    with open(path, encoding="utf-8") as file:
        case = json.load(file)
    kind = case["question"]["kind"]
    with tempfile.TemporaryDirectory() as folder:
        answer = getattr(Etendue(str(pathlib.Path(*program or [PROGRAM]).resolve()), case, folder), kind, None)
        print(json.dumps({"value": answer()} if answer else {"unsupported": f"questions of kind {kind}"}))


main()
