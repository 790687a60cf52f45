#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The HTML report of a program (argument 1): as a file, and, where a headless Chromium is installed, as a page: good data
stay green, one injected fault of many kinds turns the page red, every plotted point is where the data say, nothing is
asked of the network. Ends with 77 (skipped) after the checks of the file where no Chromium is there."""
import base64
import copy
import hashlib
import html.parser
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

sys.dont_write_bytecode = True
validation = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(validation, "report"))
import embed  # noqa: E402
from demand import complaints, demand  # noqa: E402

program = sys.argv[1]


def fnv1a(text):
    value = 0x811c9dc5
    for byte in text.encode():
        value = (value ^ byte) * 0x01000193 & 0xffffffff
    return f"{value:08x}"


class Outline(html.parser.HTMLParser):
    """Ids, headings, elements and every address that the page names."""

    def __init__(self):
        super().__init__()
        self.ids, self.headings, self.tags, self.addresses, self.styled = [], [], [], [], False

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append(tag)
        if "id" in attributes:
            self.ids.append(attributes["id"])
        if re.fullmatch("h[1-6]", tag):
            self.headings.append(int(tag[1]))
        self.addresses += [attributes[key] for key in ("href", "src", "action") if key in attributes]
        self.styled = self.styled or "style" in attributes or any(key.startswith("on") for key in attributes)


def outline_of(page):
    outline = Outline()
    outline.feed(page)
    return outline


def luminance(color):
    parts = [int(color[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    return sum(w * (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4) for w, c in zip((0.2126, 0.7152, 0.0722), parts))


def contrast(a, b):
    high, low = sorted((luminance(a), luminance(b)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def check_file(page):
    outline = outline_of(page)
    demand("ids are there once", len(outline.ids) == len(set(outline.ids)))
    inner = [a[1:] for a in outline.addresses if a.startswith("#")]
    demand("every link leads to a place of the page", len(inner) + sum(a.startswith("data:image/bmp;base64,") for a in outline.addresses) == len(outline.addresses) and set(inner) <= set(outline.ids),
           sorted(set(inner) - set(outline.ids)))
    demand("one h1, and no heading skips a level", outline.headings.count(1) == 1 and outline.headings[0] == 1
           and all(b - a <= 1 for a, b in zip(outline.headings, outline.headings[1:])), outline.headings)
    demand("landmarks are there", {"header", "nav", "main"} <= set(outline.tags))
    demand("no style or handler in an attribute, which the policy would block", not outline.styled)
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)[1]
    for tag, text in (("script", re.findall(r"<script>(.*?)</script>", page, re.S)), ("style", re.findall(r"<style>(.*?)</style>", page, re.S))):
        digest = base64.b64encode(hashlib.sha256(text[0].encode()).digest()).decode()
        demand(f"one {tag}, with its hash in the policy", len(text) == 1 and f"{tag}-src 'sha256-{digest}'" in policy)
    demand("the policy allows nothing else", policy.startswith("default-src 'none'; ") and "http" not in policy and "unsafe" not in policy)
    colors = [dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", block)) for block in re.findall(r":root \{(.*?)\}", page, re.S)[:2]]
    poor = [(i, ink, paper) for i, c in enumerate(colors) for ink, paper in (("ink", "paper"), ("soft", "paper"), ("link", "paper"),
            ("good", "good-tint"), ("bad", "bad-tint"), ("good", "paper"), ("bad", "paper"), ("soft", "tint"), ("ink", "tint"), ("link", "tint"))
            if contrast(c[ink], c[paper]) < 4.5]
    demand("text has a contrast of 4.5, light and dark", len(colors) == 2 and not poor, poor)
    demand("what a reader without a script needs is text", "Verified" in page and "Reproduce with" in page and "error/tolerance 0.100" in page)


def data_of(page):
    return json.loads(re.search(r'id="report"[^>]*>(.*?)</script>', page, re.S)[1])


def with_data(page, data):
    """The page with other data, whose digest fits: so that the checks of their meaning must find the fault."""
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
    start = page.index('<script type="application/json" id="report"')
    end = page.index("</script>", start)
    return f'{page[:start]}<script type="application/json" id="report" data-fnv1a="{fnv1a(text)}">{text}{page[end:]}'


def places(value, path=()):
    """Every key and element below: where a fault can be put."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        yield path + (key,)
        yield from places(inner, path + (key,))


# What carries no verdict, and what a consistent lie may say: text alone, and numbers that nothing else in the report repeats.
FREE = {"stated", "command", "eye"}
TEXTS = {"statement", "reason", "source", "oracle", "version", "compiler", "build_type", "date", "title", "size_name", "unit"}


def faults(data):
    """(what, damaged data): each differs from the good data in one place."""
    for path in places(data):
        if FREE & set(path):
            continue
        parent = data
        for key in path[:-1]:
            parent = parent[key]
        value, changes = parent[path[-1]], {}
        if isinstance(path[-1], str):
            changes["missing"] = None
        if isinstance(value, bool):
            if path[-1] != "full_run":
                changes["turned"] = not value
        elif isinstance(value, (int, float)):
            changes["negative"] = -1
            if path[-1] not in ("duration_seconds",) and "seeds" not in path:
                changes["above its bound"] = value + 1.5
            changes["not a number"] = "NaN"
        elif isinstance(value, str):
            changes["empty"] = ""
            if path[-1] not in TEXTS:
                changes["altered"] = value + "x"
        for what, new in changes.items():
            if path[-1] == "worst_share" and what == "missing":
                changes[what] = None
            damaged = copy.deepcopy(data)
            place = damaged
            for key in path[:-1]:
                place = place[key]
            if what == "missing":
                del place[path[-1]]
            else:
                place[path[-1]] = new
            yield f"{'.'.join(map(str, path))} {what}", damaged


def packed_faults(data):
    """One number of each long list of a figure: raised, not a number, and left out."""
    for k, figure in enumerate(data["figures"]):
        for name in (name for name in figure if re.match("f(32|64)_", name)):
            letter = "d" if name.startswith("f64") else "f"
            raw = base64.b64decode(figure[name])
            numbers = list(struct.unpack(f"<{len(raw) // struct.calcsize(letter)}{letter}", raw))
            middle = len(numbers) // 2
            for what, new in {"raised": numbers[:middle] + [numbers[middle] + 0.25] + numbers[middle + 1:],
                              "not a number": numbers[:middle] + [math.nan] + numbers[middle + 1:], "cut": numbers[:-1]}.items():
                damaged = copy.deepcopy(data)
                damaged["figures"][k][name] = base64.b64encode(struct.pack(f"<{len(new)}{letter}", *new)).decode()
                yield f"figures.{k}.{name} {what}", damaged


def browser():
    return next((path for path in map(shutil.which, ("chromium-headless-shell", "chromium", "google-chrome")) if path), None)


def dump(chromium, folder, page):
    """The page after its script has run, and what the browser logged. A host that cannot be found would be logged, too."""
    path = os.path.join(folder, "page.html")
    with open(path, "w", encoding="utf-8") as file:
        file.write(page)
    done = subprocess.run([chromium, "--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-logging=stderr", "--host-resolver-rules=MAP * ~NOTFOUND",
                           f"--user-data-dir={folder}/profile", "--dump-dom", "file://" + path], capture_output=True, timeout=120)
    return done.stdout.decode(), "\n".join(l for l in done.stderr.decode(errors="replace").splitlines() if "CONSOLE" in l)


def check_points(dom, data):
    shown = [(float(s), t, float(y)) for y, s, t in re.findall(r'<circle cx="[^"]*" cy="([^"]*)" r="3"[^>]*data-share="([^"]*)" data-test="([^"]*)"', dom)]
    wanted = sorted(((e["worst_share"], t["test"]) for t in data["tests"] for e in t["evidence"] if e["claims"] and e["worst_share"]), reverse=True)
    demand("each check is a point, worst first", wanted and [s for s, _, _ in shown] == [s for s, _ in wanted], (shown, wanted))
    # y is linear in log10(share): two points fix the line, the limit line of share 1 must lie on it.
    limit = float(re.search(r'<line [^>]*y1="([^"]*)"[^>]*class="limit"', dom)[1])
    tens = float(re.search(r'<text x="[^"]*" y="([^"]*)" text-anchor="end">10\^-1<', dom)[1]) - 4
    demand("and stands where its share says", all(abs(y - (limit - (tens - limit) * math.log10(s))) < 0.01 for s, _, y in shown), shown)


# Runs inside of the page's own function, after all is drawn: what pixels show, and what they should by the data.
PROBE = """
const wrong = [], expectPixel = function (what, found, wanted, slack) {
  if ([0, 1, 2].some(function (c) { return Math.abs(found[c] - wanted[c]) > slack; })) wrong.push([what, Array.from(found), wanted]);
};
let probed = 0;
data.figures.forEach(function (f, k) {
  const article = document.getElementById("figure-" + k), select = article.querySelector("select");
  const show = function (word) { select.value = word; select.dispatchEvent(new Event("change")); };
  const pixelsOf = function (canvas) { return canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data; };
  if (f.kind === "factors") {
    const n = f.areas.length, F = unpack(f.f64_factors, Float64Array), E = unpack(f.f64_bounds, Float64Array);
    for (const [word, decades, value] of [["factors", 6, function (i, j) { return F[i * n + j]; }], ["bounds", 18, function (i, j) { return E[i * n + j]; }],
        ["reciprocity", 18, function (i, j) { return Math.abs(f.areas[i] * F[i * n + j] - f.areas[j] * F[j * n + i]); }]]) {
      show(word);
      const pixels = pixelsOf(article.querySelector("canvas"));
      for (let i = 0; i < n; ++i) for (let j = 0; j < n; ++j, ++probed)
        expectPixel(word + " " + i + " " + j, pixels.slice(4 * (i * n + j), 4 * (i * n + j) + 3), rampColour(value(i, j) > 0 ? 1 + Math.log10(value(i, j)) / decades : 0), 0);
    }
    const strip = pixelsOf(article.querySelector(".strip"));
    for (let i = 0; i < n; ++i, ++probed) {
      const miss = Math.abs(1 - F.slice(i * n, i * n + n).reduce(function (a, b) { return a + b; }, 0));
      expectPixel("row sum " + i, strip.slice(4 * i, 4 * i + 3), rampColour(miss > 0 ? 1 + Math.log10(miss) / 18 : 0), 0);
    }
  }
  if (f.kind === "images") {
    const R = unpack(f.f32_reference, Float32Array), D = unpack(f.f32_difference, Float32Array), slider = article.querySelector("input");
    const byte = function (v) { v = Math.min(1, Math.max(0, v)); return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055); };
    for (const stops of [0, 1, -2]) {
      slider.value = stops; slider.dispatchEvent(new Event("input"));
      for (const [word, share] of [["ours", 1], ["reference", 0]]) {
        show(word);
        const pixels = pixelsOf(article.querySelector("canvas"));
        for (let p = 0; p < f.columns * f.rows; ++p, ++probed)
          expectPixel(word + " " + p + " at " + stops, pixels.slice(4 * p, 4 * p + 3), [0, 1, 2].map(function (c) { return byte(2 ** stops * (R[3 * p + c] + share * D[3 * p + c])); }), 0.6);
      }
    }
    show("signed relative difference");
    const pixels = pixelsOf(article.querySelector("canvas"));
    for (let p = 0; p < f.columns * f.rows; ++p, ++probed) {
      const biggest = [0, 1, 2].map(function (c) { return D[3 * p + c]; }).reduce(function (a, b) { return Math.abs(b) > Math.abs(a) ? b : a; }, 0);
      const [red, , blue] = pixels.slice(4 * p, 4 * p + 3);
      if (Math.sign(red - blue) !== Math.sign(biggest)) wrong.push(["sign of pixel " + p, red - blue, biggest]);
    }
  }
  if (f.kind === "radiosity") {
    const room = drawRadiosity(f, article), corners = unpack(f.f64_corners, Float64Array), B = unpack(f.f64_radiosity, Float64Array);
    if (!room) return wrong.push("no WebGL");
    let first = 0;
    f.sizes.forEach(function (size, k) {
      const corner = function (i) { return Array.from(corners.slice(3 * (first + i), 3 * (first + i) + 3)); };
      const less = function (a, b) { return a.map(function (v, c) { return v - b[c]; }); };
      const middle = [0, 1, 2].map(function (c) { let s = 0; for (let i = 0; i < size; ++i) s += corner(i)[c] / size; return s; });
      const normal = crossed(less(corner(1), corner(0)), less(corner(2), corner(0))), length = Math.hypot(...normal);
      const n = normal.map(function (v) { return v / length; });
      room.place.eye = middle.map(function (v, c) { return v + 0.06 * n[c]; });
      room.place.pitch = Math.asin(Math.max(-0.999999, Math.min(0.999999, -n[2])));
      room.place.yaw = Math.atan2(-n[1], -n[0]);
      room.exposure.value = -1;
      room.show();
      const pixel = new Uint8Array(4), gl = room.gl;
      gl.readPixels(room.canvas.width / 2, room.canvas.height / 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      expectPixel("element " + k, pixel, [0, 1, 2].map(function (c) { return shownByte(room.base / 2 * B[3 * k + c]); }), 1.01);
      first += size;
      ++probed;
    });
  }
});
document.body.textContent = "PROBED " + probed + " " + JSON.stringify(wrong.slice(0, 5)) + " END";
"""


def check_pixels(chromium, folder, page):
    """The policy would stop a script of ours: the probe's page goes without, and is the same otherwise."""
    free = re.sub(r"<meta http-equiv[^>]*>", "", page)
    end = free.rindex("})();")
    dom, console = dump(chromium, folder, free[:end] + PROBE + free[end:])
    found = re.search(r"PROBED (\d+) (.*) END", dom)
    demand(f"{found[1] if found else 0} pixels show what the data say, by canvas and by WebGL", found and int(found[1]) >= 70 and found[2] == "[]",
           (found and found[2], console))


def check_curves(dom, data):
    """Each point of a curve stands where the logarithms of its size and error say: its coordinates are linear in them."""
    for k, figure in enumerate(data["figures"]):
        if figure["kind"] != "convergence":
            continue
        article = re.search(rf'id="figure-{k}".*?</article>', dom, re.S)[0]
        points = [(float(x), float(y)) for x, y in re.findall(r'<circle cx="([^"]*)" cy="([^"]*)"', article)]
        x, y = ([math.log10(v) for v in figure[key]] for key in ("sizes", "errors"))
        scale = [(points[-1][c] - points[0][c]) / (v[-1] - v[0]) for c, v in ((0, x), (1, y))]
        good = len(points) == len(x) and scale[0] > 0 > scale[1] and all(
            abs(points[i][0] - points[0][0] - scale[0] * (x[i] - x[0])) < 0.01 and
            abs(points[i][1] - points[0][1] - scale[1] * (y[i] - y[0])) < 0.01 for i in range(len(points)))
        demand("points of a convergence plot stand where their logarithms say", good, points)


def check_browser(chromium, folder, page):
    dom, console = dump(chromium, folder, page)
    demand("good data: green, no fault", 'data-verdict="good"' in dom and 'data-faults="0"' in dom, dom[:500] + console)
    demand("the console says nothing, so nothing was asked of the network", console == "", console)
    check_points(dom, data_of(page))
    check_curves(dom, data_of(page))
    check_pixels(chromium, folder, page)
    altered = page.replace('"worst_share":0.1', '"worst_share":0.2')
    demand("altered data are found by their digest", altered != page and "altered after the run" in dump(chromium, folder, altered)[0])
    # All faults in one visit: the page's own findFaults() judges each of them.
    script = re.search(r"<script>(.*?)</script>", page, re.S)[1]
    listed = list(faults(data_of(page))) + list(packed_faults(data_of(page)))
    judge = "\n".join(["const out = cases.map(function (c) { try { return findFaults(c).length; } catch (e) { return 1; } });",
                       "document.body.textContent = 'JUDGED ' + JSON.stringify(out);"])
    body = script[:script.index("const holder")] + "const cases = " + json.dumps([d for _, d in listed]).replace("<", "\\u003c") + ";\n" + judge + "})();"
    judged = re.search(r"JUDGED (\[[0-9,]*\])", dump(chromium, folder, f"<!DOCTYPE html><body><script>{body}</script>")[0])
    counts = json.loads(judged[1]) if judged else []
    # The name of a row that no test proves is held against the table only: by the whole page.
    missed = [what for (what, damaged), count in zip(listed, counts) if count == 0
              and not (re.fullmatch(r"(claims|errata)\.\d+\.id altered", what)
                       and 'data-verdict="bad"' in dump(chromium, folder, with_data(page, damaged))[0])]
    demand(f"each of {len(listed)} injected faults is found", len(listed) >= 100 and len(counts) == len(listed) and not missed, missed)
    # A few of them through the whole page, to the colour.
    for what, damaged in listed[::max(1, len(listed) // 4)][:4]:
        dom = dump(chromium, folder, with_data(page, damaged))[0]
        demand(f"the page turns red: {what}", 'data-verdict="bad"' in dom and "NOT VERIFIED" in dom, dom[:300])


def check_formulas():
    """Each formula of the register is well-formed MathML, and no sign of it is lost on the way."""
    def plain(text):
        return re.sub(r"[\s_^\u2061]", "", text).translate(str.maketrans("²³ⁿ", "23n")).replace("sqrt", "√")

    with open(os.path.join(validation, "claims", "claims.json"), encoding="utf-8") as file:
        formulas = [row["formula"] for row in json.load(file)["claims"] if row["formula"]]
    lost = [f for f in formulas if plain("".join(xml.etree.ElementTree.fromstring(embed.mathml(f)).itertext())) != plain(f)]
    powers = embed.mathml("d² cosⁿ φ_i")
    demand("formulas become MathML, and keep every sign", len(formulas) > 70 and not lost and powers.count("<msup>") == 2
           and "<msub><mi>φ</mi><mi>i</mi></msub>" in powers, lost)


check_formulas()
with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "report.html")
    past = [os.path.join(folder, name) for name in ("good.json", "bad.json")]
    subprocess.run([program, "--filter", "Good.*", "--quiet", "--json", past[0]], capture_output=True, timeout=60)
    subprocess.run([program, "--quiet", "--json", past[1]], capture_output=True, timeout=60)
    good = subprocess.run([program, "--filter", "Good.*", "--quiet", "--report", path, "--history", past[0], "--history", past[1]],
                          capture_output=True, timeout=60)
    demand("a report is written", good.returncode == 0, good)
    good_page = open(path, encoding="utf-8").read()
    check_file(good_page)
    demand("earlier runs are told of, and what changed", good_page.count('<tr><th scope="row">20') == 3
           and '<a href="#claim-T.1">T.1</a>: FAILED, now verified' in good_page and len(data_of(good_page)["history"]["changes"]) == 2,
           data_of(good_page)["history"])
    with open(past[0], "w", encoding="utf-8") as file:
        file.write('{"schema": "etendue-validation-report/1", "totals": {}}')
    for what, options, code in (("no report", ["--report", path, "--history", past[0]], 3), ("not JSON", ["--report", path, "--history", path], 3),
                                ("not there", ["--report", path, "--history", past[0] + "x"], 5), ("without --report", ["--history", past[1]], 2)):
        refused = subprocess.run([program, "--filter", "Good.*", *options], capture_output=True, timeout=60)
        demand(f"a history is refused: {what}", refused.returncode == code and refused.stderr.count(b"\n") == 1, refused)
    bad = subprocess.run([program, "--quiet", "--report", path], capture_output=True, timeout=60)
    bad_page = open(path, encoding="utf-8").read()
    demand("a failed run is red without a script", bad.returncode == 1 and '<html lang="en" data-verdict="bad">' in bad_page
           and "NOT VERIFIED" in bad_page and "times the tolerance" in bad_page)
    chromium = browser()
    if chromium:
        check_browser(chromium, folder, good_page)
sys.exit(1 if complaints else 0 if chromium else 77)
