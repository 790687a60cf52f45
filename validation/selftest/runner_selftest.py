#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the program of misbehaving tests (argument 1) and demands that the runner notices each misbehaviour."""
import json
import os
import pty
import signal
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

sys.dont_write_bytecode = True
from demand import complaints, demand  # noqa: E402

program = sys.argv[1]


def run(*options):
    done = subprocess.run([program, *options], capture_output=True, timeout=60)
    return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")


def demand_run(what, options, code, *texts):
    status, out, err = run(*options)
    good = status == code and all(text in out + err for text in texts)
    demand(what, good, f"exit {status}, wanted {code} and {texts}\n{out}{err}")
    return out


out = demand_run("good tests pass", ["--filter", "Good.*"], 0, "T.1", "closed form", "0.100", "3 tests passed, 0 failed",
                 "1 claim verified, 1 refuted with the mended form verified, 1 not testable, 1 open; 1 erratum proved")
lines = {line.split()[0]: line for line in out.splitlines() if line.strip()}
demand("a yes-or-no claim shows as exact", "exact" in lines["T.2"] and "refuted as printed: E1" in lines["T.2"], out)
demand("verified rows whose tests were not chosen are counted, not listed", "T.3" not in lines
       and "not run: the tests of 1 claim and 0 errata that have a verdict\n" in out, out)
demand("an open row with a passing test stays open", "open, in part" in lines["T.4"], out)
out = demand_run("the matrix says why a claim is not testable", ["--claims"], 0, "T.5\tnot testable\t", "nobody asked him")

demand_run("a failing test ends with 1", ["--filter", "Bad.Fails"], 1, "FAILED", "times the tolerance")
demand_run("a test that asserts nothing ends with 1", ["--filter", "Bad.AssertsNothing"], 1, "asserts nothing")
demand_run("so does one that passes out of bounds", ["--filter", "Bad.PassesOutOfBounds"], 1, "exceeds its tolerance")
demand_run("so does one that passes on NaN", ["--filter", "Bad.PassesOnNan"], 1, "not a number")
demand_run("so does one with an unknown id", ["--filter", "Bad.NamesAnUnknownClaim"], 1, "T.77", "register does not have")
demand_run("so does one that skips", ["--filter", "Bad.Skips"], 1, "nothing skips")
demand_run("a full run names the unproved row and the disabled test", [], 1, "not testable: T.5\n", "T.3: the register says verified",
           "Bad.DISABLED_Sleeps: skipped")
demand_run("GoogleTest's own options work, and the evidence still counts",
           ["--gtest_filter=Bad.AssertsNothing"], 1, "[       OK ]", "asserts nothing")
demand_run("a good test under GoogleTest's options passes", ["--gtest_filter=Good.DecidesExactly"], 0, "[  PASSED  ]")
demand_run("the list of GoogleTest is only that", ["--gtest_list_tests"], 0, "Good.\n  HoldsATenthOfItsTolerance")

demand_run("an id selects the tests that prove it", ["--filter", "E1", "--quiet"], 0, "1 refuted")
demand_run("a pattern that fits nothing is refused", ["--filter", "T.[24]", "--quiet"], 2, "T.[24]")
demand_run("--list shows what each test proves", ["--list"], 0, "Good.DecidesExactly T.2 E1", "Good.TwoOraclesInOneTest T.1\n")

demand_run("--claim runs the tests that prove it, and no other", ["--claim", "T.2"], 0, "1 test passed", "1 refuted with")
demand_run("of an erratum as well", ["--claim=E1"], 0, "1 test passed", "1 erratum proved")
demand_run("--claim is no pattern", ["--claim", "T.*"], 2, "--claim T.*: the register does not have it; --claims names all\n")
demand_run("a claim without a test is refused", ["--claim", "T.3"], 2, "--claim T.3: no test proves it\n")
demand_run("--subject is one of the register", ["--subject", "mended things"], 0, "1 test passed", "1 erratum proved")
demand_run("the errata of its claims belong to it", ["--subject", "errors"], 0, "1 test passed", "1 erratum proved")
demand_run("or a folder of tests", ["--subject", "selftest", "--quiet"], 1, "PROBLEM Bad.Skips", "FAILED Bad.Fails")
demand_run("and one that is neither is refused, with what there is", ["--subject", "optic"], 2,
           "--subject optic: no subject", "subjects: errors, mended things, s; modules: selftest\n")
demand_run("choices add up", ["--claim", "E1", "--filter", "Good.HoldsATenthOfItsTolerance"], 0, "2 tests passed")
demand_run("each must select something", ["--claim", "E1", "--filter", "T.9"], 2, "no test proves or is called T.9")


def comparisons(environment, *options):
    """How many comparisons Good.DecidesExactly made, and the command that the report says would repeat the run."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "report.json")
        subprocess.run([program, "--claim", "E1", "--quiet", "--json", path, *options], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, **environment}, timeout=60)
        report = json.load(open(path, encoding="utf-8"))
        return report["tests"][0]["evidence"][0]["comparisons"], report["command"]


demand("a usual run makes its three decisions", comparisons({}) == (4, "etendue-validate --claim 'E1'"), comparisons({}))
demand("--long makes a hundred times as many, and says so", comparisons({}, "--long") == (301, "etendue-validate --claim 'E1' --long"),
       comparisons({}, "--long"))
demand("or as many as ETENDUE_LONG_RUN says", comparisons({"ETENDUE_LONG_RUN": "7"}, "--long")[0] == 22)


def on_a_terminal(*options):
    """What the program writes to stderr where that is a terminal."""
    reader, writer = pty.openpty()
    done = subprocess.run([program, *options], stdout=subprocess.DEVNULL, stderr=writer, timeout=60)
    os.close(writer)
    text = b""
    try:
        while piece := os.read(reader, 4096):
            text += piece
    except OSError:  # the terminal's other end is closed: all is read
        pass
    os.close(reader)
    return done.returncode, text.decode()


status, shown = on_a_terminal("--long", "--filter", "Good.*")
demand("a long run has a bar and a clock on a terminal", status == 0 and all(text in shown for text in (
       "\r\x1b[K[........................] 0:00:00 1/3 Good.HoldsATenthOfItsTolerance",
       "[########................] 0:00:00 2/3 Good.DecidesExactly",
       "[################........] 0:00:00 3/3 Good.TwoOraclesInOneTest")), repr(shown))
demand("which moves while a test runs", "[############............] 0:00:00 2/3 Good.DecidesExactly 50 %" in shown, repr(shown))
status, shown = on_a_terminal("--filter", "Good.*")
demand("a usual run says where it is", status == 0 and "\r\x1b[K2/3 Good.DecidesExactly" in shown and "#" not in shown, repr(shown))
demand("in a pipe there is neither", run("--long", "--filter", "Good.*")[2] == "")

with tempfile.TemporaryDirectory() as folder:
    files = {kind: os.path.join(folder, "report." + kind) for kind in ("json", "xml", "txt")}
    paths = ["--json", files["json"], "--junit", files["xml"], "--text", files["txt"]]
    demand_run("reports are written, failures or not", ["--quiet", *paths], 1)
    report = json.load(open(files["json"], encoding="utf-8"))
    demand("the JSON says what happened", report["schema"] == "etendue-validation-report/1" and not report["ok"]
           and report["totals"]["tests_failed"] == 3 and report["claims"][0]["verdict"] == "FAILED"
           and report["tests"][0]["evidence"][0]["seeds"] == [7], json.dumps(report["totals"]))
    suites = xml.etree.ElementTree.parse(files["xml"]).getroot()
    cases = list(suites.iter("testcase"))
    failed = [case for case in cases if case.find("failure") is not None]
    demand("the JUnit file counts what it holds", int(suites.get("tests")) == len(cases)
           and int(suites.get("failures")) == len(failed) and any(case.get("name") == "Fails" for case in failed))
    demand("and keeps odd characters", any("<integers> & \"quotes\"" in (p.get("value") or "") for p in suites.iter("property")))
    demand("nothing temporary is left", sorted(os.listdir(folder)) == ["report.json", "report.txt", "report.xml"])

    def stable(path):
        timeless = json.load(open(path, encoding="utf-8"))
        for entry in [timeless, *timeless["tests"]]:
            entry.pop("duration_seconds")
        timeless.pop("date")
        return timeless

    first = stable(files["json"])
    for jobs in ("1", "2", "3"):
        run("--quiet", "--jobs", jobs, *paths)
        demand(f"a second run, by {jobs} processes, reports the same", first == stable(files["json"]))

# The running test interrupts its own program, as the user might at that moment.
for name, number in (("SIGINT", signal.SIGINT), ("SIGTERM", signal.SIGTERM)):
    with tempfile.TemporaryDirectory() as folder:
        files = {kind: os.path.join(folder, "report." + kind) for kind in ("json", "xml", "txt")}
        os.environ["ETENDUE_SELFTEST_SIGNAL"] = str(int(number))
        demand_run(f"{name} ends the run after its test, with 6",
                   ["--jobs", "1", "--json", files["json"], "--junit", files["xml"], "--text", files["txt"]], 6,
                   "STOPPED: 7 tests were not run, of Good 1, Bad 6", "2 tests passed, 0 failed",
                   "etendue-validate: stopped; 7 tests were not run\n")
        del os.environ["ETENDUE_SELFTEST_SIGNAL"]
        if sorted(os.listdir(folder)) != ["report.json", "report.txt", "report.xml"]:
            demand("the reports of a stopped run are written, and nothing else", False, os.listdir(folder))
            continue
        report = json.load(open(files["json"], encoding="utf-8"))
        outcomes = [test["outcome"] for test in report["tests"]]
        demand("the JSON says which tests were not run", report["stopped"] and not report["ok"] and not report["full_run"]
               and outcomes == ["passed"] * 2 + ["not run"] * 7 and report["totals"]["tests_not_run"] == 7, outcomes)
        suites = xml.etree.ElementTree.parse(files["xml"]).getroot()
        demand("the JUnit file has them as skipped", suites.get("skipped") == "7" and suites.get("failures") == "0"
               and sum(case.find("skipped") is not None for case in suites.iter("testcase")) == 7)
        demand("the text counts them", "STOPPED: 7 tests" in open(files["txt"], encoding="utf-8").read())

    # The same to a run of two processes, each of which is within a test then.
    os.environ["ETENDUE_SELFTEST_STOP_THE_RUN"] = str(int(number))
    demand_run(f"{name} ends all processes of a run after their tests, with 6", ["--jobs", "2"], 6,
               "STOPPED: 7 tests were not run, of Good 1, Bad 6", "2 tests passed, 0 failed")
    del os.environ["ETENDUE_SELFTEST_STOP_THE_RUN"]

# The running test ends its process.
os.environ["ETENDUE_SELFTEST_SIGNAL"] = str(int(signal.SIGSEGV))
demand_run("a test that crashes is named", ["--claim", "E1", "--jobs", "2"], 1,
           "PROBLEM Good.DecidesExactly: ended its process by signal 11; what that had run is lost")
del os.environ["ETENDUE_SELFTEST_SIGNAL"]

for jobs in ("0", "201", "2.5", "two"):
    demand_run(f"--jobs {jobs} is refused", ["--jobs", jobs], 2, f"--jobs {jobs}: expected a whole number from 1 to 200")

sys.exit(1 if complaints else 0)
