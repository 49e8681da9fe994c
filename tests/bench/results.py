#!/usr/bin/env python3
"""Runs measuring scripts and writes what they print into RESULTS.md, with date, machine and commit:

    python3 tests/bench/results.py [NAME...]     # none: all but the long ones; --list says what there is

Only this writes RESULTS.md. A table that was not asked for stays as it is. Needs only Python 3."""
import datetime
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "tests/bench/RESULTS.md"
HEAD = """# Results

Written by `tests/bench/results.py` only; figures of one machine at one time: compare ratios within a table.
"""
# name: (title, command, whether it takes more than some minutes)
TABLES = {
    "physics": ("Closed forms, beside Bullet and ODE", "bash tests/bench/physics.sh", False),
    "closest-features": ("Closest features, beside FCL, Bullet and ODE, and wrong answers on adversarial pairs",
                         "bash tests/bench/run.sh", False),
    "piles": ("Piles from release to quiet, beside Bullet and ODE", "bash tests/bench/pile.sh", False),
    "resting": ("Sixty in flight over many at rest", "bash tests/bench/resting.sh 1000 8000", False),
    "frames": ("Frames a second, end to end", "bash tests/bench/frames.sh", False),
    "stress-small": ("Contact, the small suite", "bash tests/bench/stress.sh --small", False),
    "hashes": ("One state hash: compilers and levels on x86-64", "bash tests/hash_table.sh gcc-O3 gcc-O2 gcc-O0"
               " gcc-O3-avx2 clang-O3 clang-O2 clang-O0 clang-O3-avx2", True),
    "hashes-processors": ("One state hash: other processors", "bash tests/hash_table.sh gcc-O3 i686-O3 s390x-O3 riscv64-O3"
                          " ppc64el-O3 aarch64-O3 aarch64-O2", True),
    "hashes-webassembly": ("One state hash: WebAssembly", "SEEDS=200 bash tests/hash_table.sh --states gcc-O3 wasm-O2", True),
    "piles-all": ("Piles, with the large ones", "bash tests/bench/pile.sh --all", True),
    "physics-all": ("Closed forms, with the long rows", "bash tests/bench/physics.sh --all", True),
    "stress": ("Contact, the long suite", "bash tests/bench/stress.sh", True),
}


def machine():
    try:
        model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())[1]
    except (OSError, TypeError):
        model = os.uname().machine
    return f"{' '.join(model.split())}, {os.cpu_count()} processors"


def commit():
    run = lambda *words: subprocess.run(["git", "-C", str(ROOT), *words], capture_output=True, text=True).stdout.strip()
    changed = run("status", "--porcelain", "--untracked-files=no", "--", "engine", "renderer", "demos", "tests/bench/*.cpp")
    return run("rev-parse", "--short", "HEAD") + (" with changes" if changed else "")


def section(name):
    title, command, _ = TABLES[name]
    run = subprocess.run(command, shell=True, cwd=ROOT, stdout=subprocess.PIPE, text=True)
    printed = "\n".join(line for line in run.stdout.splitlines() if not line.startswith(("configuring ", "building ", "installing ")))
    now = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d")
    load = os.getloadavg()[0]
    return (f"<!-- {name} -->\n## {title}\n\n{now}; {machine()}; load {load:.1f} at the end; commit {commit()}.\n"
            f"`{command}` ended with {run.returncode}.\n\n```text\n{printed.rstrip()}\n```\n<!-- /{name} -->\n")


def main():
    asked = sys.argv[1:] or [name for name, (_, _, long) in TABLES.items() if not long]
    if asked == ["--list"]:
        for name, (title, command, long) in TABLES.items():
            print(f"{name:18} {title} ({command}){', long' if long else ''}")
        return 0
    unknown = [name for name in asked if name not in TABLES]
    if unknown:
        print(f"unknown: {', '.join(unknown)}; accepted: {', '.join(TABLES)}", file=sys.stderr)
        return 2
    for name in asked:
        fresh = section(name)
        text = PAGE.read_text() if PAGE.exists() else HEAD
        kept = {found: re.search(rf"<!-- {found} -->.*?<!-- /{found} -->\n", text, re.S) for found in TABLES}
        parts = [fresh if found == name else kept[found][0] for found in TABLES if found == name or kept[found]]
        PAGE.write_text("\n".join([HEAD, *parts]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
