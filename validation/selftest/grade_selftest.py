#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs `etendue-validate grade` (argument 1: the program) on programs that answer well, wrongly and not at all, argument 2 being etendue.
Each misbehaviour must be named for what it is, each wrong answer by its case."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
from demand import complaints, demand  # noqa: E402

program, etendue = (os.path.abspath(word) for word in sys.argv[1:3])
ROOT = pathlib.Path(__file__).resolve().parents[2]
ADAPTERS = ROOT / "validation/adapters"
CASES = ROOT / "validation/cases"
PYTHON = [sys.executable, "-S", "-B"]  # the standard library alone, which starts in half the time


def grade(*words, **how):
    done = subprocess.run([program, "grade", *map(str, words)], capture_output=True, text=True, timeout=300, check=False, **how)
    return done.returncode, done.stdout + done.stderr


def expect(what, code, *texts, words, **how):
    ended, out = grade(*words, **how)
    demand(what, ended == code and all(t in out for t in texts), f"exit {ended}, wanted {code} and {texts}\n{out[:3000]}")
    return out


# Cosines of Fresnel's formulas, but for the light that swings across the plane of incidence alone: wrong but at right angles.
WRONG = """
import json, math, sys
case = json.load(open(sys.argv[-1]))
if case["question"]["kind"] != "share" or case["question"]["events"] != ["reflect"]:
    print(json.dumps({"unsupported": "all but reflection"}))
    sys.exit()
n = case["scene"]["materials"]["glass"]["eta"]
x, y, z = case["question"]["direction"]
c = -z / math.sqrt(x * x + y * y + z * z)
behind = math.sqrt(1 - (1 - c * c) / (n * n))
print(json.dumps({"value": ((c - n * behind) / (c + n * behind)) ** 2}))
"""

# What a program may do instead of answering a number: (name, program, part of the message, case).
ONE, NONE, ARRAY = "form-factors/parallel-1-1-1", "intersections/sphere-missed", "refraction/snell-1.5-1"
MISBEHAVIOUR = [
    ("a crash", "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", "crashed by signal 11", ONE),
    ("an exit code, with the last line of what it says", "import sys; sys.exit('first\\nno licence')", "ended with 1: no licence", ONE),
    ("silence", "pass", "printed no answer", ONE),
    ("a text", "print('F = 0.2')", "printed 'F = 0.2\\n', which is not JSON", ONE),
    ("NaN", "print('{\"value\": NaN}')", "which is not JSON: it knows no NaN and no infinity", ONE),
    ("infinity", "print('{\"value\": -Infinity}')", "which is not JSON: it knows no NaN and no infinity", ONE),
    ("a number beyond doubles", "print('{\"value\": 1e999}')", "which is not JSON", ONE),
    ("null", "print('{\"value\": null}')", "its value is null, as NaN becomes", ONE),
    ("a bare number", "print(0.19982489569838738)", "expected an object with \"value\" or with \"unsupported\"", ONE),
    ("both keys", "print('{\"value\": 1, \"unsupported\": \"x\"}')", "expected an object with \"value\" or with \"unsupported\"", ONE),
    ("a number as text", "print('{\"value\": \"0.2\"}')", "its value is \"0.2\", not numbers", ONE),
    ("an array for a number", "print('{\"value\": [0.19982489569838738]}')", "asked is a number", ONE),
    ("two numbers for three", "print('{\"value\": [0, 1]}')", "asked is an array of 3 numbers", ARRAY),
    ("one that is no number", "print('{\"value\": [0, null, 1]}')", "its value is [0,null,1], not numbers", ARRAY),
    ("none where something is", "print('{\"value\": \"none\"}')", "answered \"none\", right is 0.1998", ONE),
    ("something where none is", "print('{\"value\": 5}')", "answered 5, right is \"none\"", NONE),
    ("no reason", "print('{\"unsupported\": true}')", "\"unsupported\" is not a text that says why", ONE),
    ("a wrong number", "print('{\"value\": 0.5}')", "answered 0.5, right is 0.19982489569838", ONE),
    ("bytes that no terminal should see", "print('\\x1b[2J')", "printed '\\x1b[2J", ONE),
    ("an endless answer", "while True: print('0' * 10000)", "killed: it printed far more than an answer", ONE),
    ("no end", "import time; time.sleep(60)", "no answer in time, killed after", ONE),
]


def misbehaving(folder):
    for name, text, message, case in MISBEHAVIOUR:
        script = folder / "misbehaves.py"
        script.write_text(text)
        began = time.monotonic()
        expect(f"{name}: failed, and said why", 1, f"FAILED {case}: ", message, "1 case: 0 passed, 1 failed, 0 unsupported",
               words=["--case", case, *(["--timeout", 2] if name == "no end" else []), "--", *PYTHON, script])
        if time.monotonic() - began > 30:
            complaints.append(f"{name} took its time")
    # A child that outlives its parent holds nothing up and does not stay.
    script = folder / "leaves.py"
    pid = folder / "pid"
    script.write_text(f"import subprocess, sys\nchild = subprocess.Popen(['sleep', '50'])\nopen({str(pid)!r}, 'w').write(str(child.pid))\n"
                      "print('{\"value\": 0.19982489569838738}')")
    expect("a child is not left behind", 0, "1 passed", words=["--case", ONE, "--", *PYTHON, script])
    time.sleep(0.2)
    state = pathlib.Path(f"/proc/{pid.read_text()}/stat")
    demand("it has ended", not state.exists() or state.read_text().split()[2] == "Z")


def wrong_solver(folder):
    script = folder / "wrong.py"
    script.write_text(WRONG)
    path = folder / "wrong.json"
    words = ["--subject", "refraction", "--json", path, "--", *PYTHON, script]
    out = expect("a wrong solver gets a bad score", 1, "1 passed, 5 failed, 37 unsupported", "unsupported, 37 cases: all but reflection",
                 words=words)
    named = sorted(line.split()[1].rstrip(":") for line in out.splitlines() if line.startswith("FAILED"))
    wanted = sorted(f"refraction/{p.stem}" for p in CASES.glob("refraction/fresnel-*.json") if not p.stem.endswith("-0"))
    demand("the cases are named that are wrong, and no others", named == wanted and len(wanted) == 5, out)
    score = json.loads(path.read_text())
    marks = {c["id"]: c["mark"] for c in score["cases"]}
    demand("so they are in JSON", score["total"]["failed"] == 5 and sorted(i for i, m in marks.items() if m == "failed") == wanted
           and score["total"]["worst_case"] in wanted and score["total"]["worst_error_in_tolerances"] > 1e4, str(score["total"]))
    alone = grade("--subject", "refraction", "--jobs", 1, "--", *PYTHON, script)[1]
    demand("one case at a time gives the same score card", alone == out, alone)


def protocol(folder):
    script = folder / "echo.py"
    script.write_text("import json, os, sys\ntext = sys.stdin.read()\nassert text == open(sys.argv[-1]).read() and sys.argv[1] == 'more'\n"
                      f"open(os.path.join({str(folder)!r}, 'seen'), 'a').write(text)\nprint(json.dumps({{'unsupported': 'anything'}}))")
    expect("nothing answered is no success", 1, "0 passed, 0 failed, 1 unsupported", words=["--case", ONE, "--", *PYTHON, script, "more"])
    seen = json.loads((folder / "seen").read_text())
    case = json.loads((CASES / (ONE + ".json")).read_text())
    demand("file and standard input are the case without its truths",
           seen == {**{k: v for k, v in case.items() if k not in ("truth", "second", "provenance", "$schema")},
                    "tolerance": case["tolerance"]["value"]})
    exported = folder / "exported"
    expect("cases are exported", 0, "30 cases written", words=["--subject", "images", "--export", exported])
    demand("as programs are given them, with schemas",
           len(list(exported.glob("images/*.json"))) == 30 and (exported / "answer.schema.json").exists()
           and "truth" not in json.loads((exported / "images/matt-ball-4-4.json").read_text()))
    expect("with their truths where asked", 0, words=["--case", ONE, "--export", exported, "--with-truth"])
    demand("byte by byte", (exported / (ONE + ".json")).read_bytes() == (CASES / (ONE + ".json")).read_bytes())
    answer = ["--", *PYTHON, "-c", "print('{\"value\": 0.19982489569838738}')"]
    expect("an exported folder serves as --cases", 0, "1 passed", words=["--cases", exported / "form-factors", *answer])
    expect("cases without truths do not", 3, "expected an object as \"truth\"", words=["--cases", exported / "images", *answer])


def usage(folder):
    expect("a program must be named", 2, "no program to grade; it stands behind the options: -- COMMAND", words=[])
    expect("an empty name is none", 2, "the program has no name", words=["--", ""])
    expect("an unknown option names the nearest", 2, "--subject", words=["--subjects", "images", "--", "true"])
    expect("a selection of nothing is refused", 2, "no case fits; --list names all", words=["--case", "nothing/*", "--", "true"])
    expect("--list runs nothing", 2, "--list and --export run no program", words=["--list", "--", "true"])
    expect("--with-truth means --export", 2, "--with-truth belongs to --export", words=["--with-truth", "--", "true"])
    expect("a folder that is not there", 5, "cannot read the cases in '/nowhere'", words=["--cases", "/nowhere", "--", "true"])
    expect("a folder without cases", 3, "there is no case in this folder", words=["--cases", folder, "--", "true"])
    expect("a program that is not there", 5, "cannot start /no/such/program", words=["--case", ONE, "--", "/no/such/program"])
    expect("a score card that cannot be written, before anything runs", 5, "/nowhere/score.json",
           words=["--json", "/nowhere/score.json", "--", "true"])
    bad = folder / "bad" / "a.json"
    bad.parent.mkdir()
    case = json.loads((CASES / (ONE + ".json")).read_text())
    for what, change, message in (("a case of another format", {"format": "x"}, '"format": "etendue-case"'),
                                  ("truths in disorder", {"truth": {"low": 1, "high": 0}},
                                   "/truth: low and high are not numbers in their order"),
                                  ("no tolerance", {"tolerance": {"value": 0, "from": ""}}, "/tolerance/value: expected a number above 0")):
        bad.write_text(json.dumps({**case, **change}))
        expect(f"{what} is refused", 3, message, words=["--cases", bad.parent, "--", "true"])


def interrupted(folder):
    script = folder / "slow.py"
    script.write_text("import time; time.sleep(30)")
    run = subprocess.Popen([program, "grade", "--subject", "images", "--", *PYTHON, str(script)], stdout=subprocess.PIPE,
                           stderr=subprocess.PIPE, text=True,
                           preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
    time.sleep(1)
    run.send_signal(signal.SIGINT)
    out, err = run.communicate(timeout=60)
    demand("Ctrl-C ends with 6 and the score card of what was run",
           run.returncode == 6 and "30 not run" in out and "stopped; 30 cases not run" in err, out + err)


def adapters(folder):
    path = folder / "own.json"
    expect("etendue answers every case, and rightly", 0, "0 failed, 0 unsupported",
           words=["--json", path, "--", *PYTHON, ADAPTERS / "etendue.py", etendue])
    total = json.loads(path.read_text())["total"]
    demand("all of them", total["passed"] == total["cases"] == len(list(CASES.glob("*/*.json"))) >= 100, str(total))
    vs3 = ["--", *PYTHON, ADAPTERS / "vs3.py"]
    expect("etendue reads its own .vs3", 0, "21 passed, 0 failed, 17 unsupported",
           words=["--subject", "form factors", *vs3, etendue, "form-factors", "{in}", "-o", "{out}"])
    expect("so does a program of a few lines", 0, "2 passed, 0 failed",
           words=["--case", "form-factors/parallel-1-1-1*", *vs3, *PYTHON, STAND_IN])
    expect("whose silence is told", 1, "ended with 0 and wrote no .vf", words=["--case", ONE, *vs3, "true"])


def documented(folder):
    """docs/grade.md: its program, its commands, and the score card that it shows."""
    text = (ROOT / "docs/grade.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```(\w+)\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    (folder / "mine.py").write_text(next(body for kind, body in blocks if kind == "python"))
    (folder / "validation").symlink_to(ROOT / "validation")
    (folder / "build/release").mkdir(parents=True)
    (folder / "build/release/bin").symlink_to(os.path.dirname(etendue))
    commands = [line.split("#")[0].strip() for kind, body in blocks if kind == "sh" for line in body.splitlines() if line.strip()]
    demand("the document has commands to run", len(commands) >= 7)
    (folder / "bin").mkdir()
    (folder / "bin/etendue-validate").symlink_to(program)
    path = f"{folder / 'bin'}:{os.path.dirname(etendue)}:{os.environ['PATH']}"
    for command in commands:
        if "povray" in command:
            continue  # validation/selftest/grade_povray_selftest.py
        done = subprocess.run(["/bin/sh", "-c", command], cwd=folder, env={**os.environ, "PATH": path}, capture_output=True, text=True,
                              check=False, timeout=300)
        demand(f"docs/grade.md: {command}", done.returncode == 0, done.stdout + done.stderr)
        if "--subject" in command and "mine.py" in command:
            def without_digits(shown):
                return re.sub(r"[\d.]+e-\d+", "tiny", shown)  # the C library's last bits
            demand("the score card is the one that is shown", without_digits(done.stdout) in without_digits(text), done.stdout)


STAND_IN = ROOT / "validation/selftest/vs3_program.py"

if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        for part in (misbehaving, wrong_solver, protocol, usage, interrupted, adapters, documented):
            (pathlib.Path(name) / part.__name__).mkdir()
            part(pathlib.Path(name) / part.__name__)
    sys.exit(bool(complaints))
