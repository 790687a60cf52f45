# SPDX-License-Identifier: Apache-2.0
"""What the self-tests demand: each demand is printed, and remembered where it is not met."""
complaints = []


def demand(what, good, more=""):
    print(("ok    " if good else "WRONG ") + what)
    if not good:
        complaints.append(what)
        print(more)
