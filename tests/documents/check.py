"""The documents' checks from the command line:
    check.py ROOT CHECK                      one of checks.CHECKS
    check.py ROOT reference                  Doxygen's
    check.py ROOT scenes PROGRAM             members of scenes that are shown
    check.py ROOT commands PROGRAM DOCUMENT  the commands of one document
Prints each finding and ends with 1 when there is one."""
import pathlib
import sys
import tempfile

import checks


def findings(root, what, arguments, work):
    if what == "reference":
        return checks.reference(root, work)
    if what == "scenes":
        return checks.scenes(root, arguments[0], work)
    if what == "commands":
        return checks.commands(root, arguments[1], arguments[0], work)
    return checks.CHECKS[what](root)


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as work:
        found = list(findings(root, sys.argv[2], sys.argv[3:], work))
    for finding in found:
        print(finding)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
