#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""POV-Ray, graded through its adapter by `etendue-validate grade` (argument 1): of the images and the ways through glass and by mirrors
that it is asked for it gets none wrong. Ends with 77 where it is not installed."""
import pathlib
import shutil
import subprocess
import sys

ADAPTER = pathlib.Path(__file__).resolve().parents[1] / "adapters/povray.py"
if not shutil.which("povray"):
    print("skipped: POV-Ray is not installed (apt-get install povray)")
    sys.exit(77)
wrong = False
for subject, summary in (("images", "16 passed, 0 failed, 14 unsupported"), ("refraction", "9 passed, 0 failed, 34 unsupported")):
    done = subprocess.run([sys.argv[1], "grade", "--subject", subject, "--", sys.executable, "-S", "-B", ADAPTER], capture_output=True,
                          text=True, check=False)
    good = done.returncode == 0 and summary in done.stdout
    wrong = wrong or not good
    print(("ok    " if good else "WRONG ") + subject, done.stdout + done.stderr, sep="\n")
sys.exit(wrong)
