#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the real etendue-validate (argument 1) on its error paths and on one small selection, and etendue (argument 2)
as the one that hands over to it."""
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

program, front = sys.argv[1:]
complaints = []


def demand(what, options, code, *texts, command=(program,), **how):
    how = {"stdout": subprocess.PIPE, **how}
    done = subprocess.run([*command, *options], stderr=subprocess.PIPE, timeout=120, **how)
    out = ((done.stdout or b"") + done.stderr).decode()
    good = done.returncode == code and all(text in out for text in texts)
    print(("ok    " if good else "WRONG ") + what)
    if not good:
        complaints.append(what)
        print(f"exit {done.returncode}, wanted {code} and {texts}\n{out}")
    return out


demand("an unknown option is refused, the nearest one named", ["--jsn", "x"], 2, "unknown option --jsn", "did you mean --json?")
demand("an unknown option of GoogleTest too", ["--gtest_fliter=x"], 2, "unknown option --gtest_fliter=x")
demand("a missing value is refused", ["--json"], 2, "--json needs a value")
demand("a stray argument is refused", ["IU.6-11"], 2, "--filter IU.6-11")
demand("a filter that selects nothing is refused", ["--filter", "IU.99"], 2, "IU.99")
demand("a claim that the register does not have too", ["--claim", "IU.99"], 2, "--claim IU.99: the register does not have it")
demand("a subject that is none is told what there is", ["--subject", "rays and more"], 2, "acceleration, colour,", "; modules: acceleration, assembly,")
demand("a report that cannot be written is refused before the run", ["--json", "/nowhere/at/all.json"], 5, "/nowhere/at/all.json")
demand("a folder in place of a report too", ["--text", "/tmp"], 5, "etendue-validate: cannot write '/tmp': is a directory\n")
demand("and a device", ["--text", "/dev/null"], 5, "cannot write '/dev/null': not a regular file")
demand("--version", ["--version"], 0, "etendue-validate 0.")
demand("--help ends with sample runs", ["--help"], 0, "Sample runs\n  etendue-validate --claims\n")
demand("--claims shows the register", ["--claims"], 0, "claim\tverdict\toracles\ttests\tstatement\n",
       "IU.6-5\t", "A_i F_ij = A_j F_ji", "R9\t", "IU.5-7\tverified\tclosed form, exact arithmetic, metamorphic\tRefractAccuracy.")
demand("--list shows what is proved", ["--list"], 0, "Evidence.RefusesNanNegativeErrorsAndEmptyChecks")
with tempfile.TemporaryDirectory() as folder:
    json_path, junit_path = os.path.join(folder, "a.json"), os.path.join(folder, "a.xml")
    demand("one test runs alone", ["--filter", "Evidence.*", "--json", json_path, "--junit", junit_path], 0,
           "1 test passed, 0 failed")
    claims = json.load(open(json_path, encoding="utf-8"))["claims"]
    suites = xml.etree.ElementTree.parse(junit_path).getroot()
    if len(claims) < 130 or suites.get("tests") != "1":
        complaints.append("the reports of the real program")
    # One file, called by two names.
    os.symlink(folder, os.path.join(folder, "link"))
    for other in (json_path, os.path.join(folder, "link", "a.json"), os.path.join(folder, ".", "a.json")):
        demand("two reports in one file are refused before the run", ["--json", json_path, "--text", other], 2,
               f"etendue-validate: --text and --json name the same file, '{json_path}': one would replace the other\n")
    # A run that is stopped at once says what it would have run.
    for options, has_commands in (([], False), (["--all"], True)):
        run = subprocess.Popen([program, "--json", json_path, *options], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        time.sleep(1)
        run.send_signal(signal.SIGINT)
        text = run.communicate(timeout=120)[0].decode()
        report = json.load(open(json_path, encoding="utf-8"))
        names = {test["test"] for test in report["tests"]}
        commands = {name for name in names if name.startswith(("RenderCommand.", "Program.", "SolveCommand."))}
        good = bool(commands) == has_commands and len(names) > 600 and (" of commands left out (--all)" in text) != has_commands
        print(("ok    " if good else "WRONG ") + f"tests of commands {'run' if has_commands else 'are left out'} {options}")
        if not good:
            complaints.append(f"{options}: {len(names)} tests, {len(commands)} of commands\n{text[-400:]}")
    new = os.path.join(folder, "new")
    demand("so they are where the file is not there yet", ["--junit", new, "--json", os.path.join(folder, "link", "new")],
           2, "--json and --junit name the same file")
    os.remove(os.path.join(folder, "link"))
    # Room runs out: of the three reports that belong together none appears, and the message names the user's path.
    paths = {kind: os.path.join(folder, "b." + kind) for kind in ("text", "json", "junit")}
    limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (16384, 16384))
    demand("a report that outgrows its room leaves nothing half-written",
           ["--filter", "Evidence.*", *(word for kind, path in paths.items() for word in ("--" + kind, path))], 5,
           f"etendue-validate: cannot write '{paths['json']}': File too large\n", preexec_fn=limit)
    if sorted(os.listdir(folder)) != ["a.json", "a.xml"]:
        complaints.append("files left behind: " + " ".join(os.listdir(folder)))
demand("references are not updated without a reason", ["--update-references", "all"], 2,
       "--update-references needs --reason: why the old pictures are no longer right\n")
demand("a reason alone means nothing", ["--reason", "new"], 2, "--reason belongs to --update-references\n")
demand("references that are none are named", ["--update-references", "scenes/none", "--reason", "new"], 2,
       "--update-references: no reference picture begins with scenes/none\n")
lost = "etendue-validate: cannot write to standard output: not all data got through\n"
for options in (["--version"], ["--help"], ["--claims"], ["--list"], ["--filter", "Evidence.*"],
                ["--gtest_filter=Evidence.*"]):
    with open("/dev/full", "wb") as full:
        demand(f"lost output of {options[0]} is noticed", options, 5, lost, stdout=full)
with tempfile.TemporaryDirectory() as folder:
    help_text = subprocess.run([program, "--help"], capture_output=True, check=True).stdout.decode()
    runs = [line.strip() for line in help_text[help_text.index("Sample runs\n"):].splitlines()[1:]]
    if len(runs) < 3:
        complaints.append("too few sample runs")
    for run in runs:
        demand(f"the sample run works: {run}", ["-c", run], 0, command=("/bin/sh",), cwd=folder,
               env={**os.environ, "PATH": os.path.dirname(os.path.abspath(program)) + ":" + os.environ["PATH"]})
demand("etendue validate hands over", ["--claims"], 0, "IU.6-5\t", command=(front, "validate"))
demand("and hands back the exit code", ["--jsn"], 2, "did you mean --json?", command=(front, "validate"))
with tempfile.TemporaryDirectory() as folder:
    lonely = shutil.copy(front, folder)
    demand("without the program beside it etendue says so", [], 5, "etendue-validate': No such file or directory; etendue-validate is not installed", command=(lonely, "validate"))
sys.exit(1 if complaints else 0)
