"""mutation.py [--count 200] [--seed 1] [--from 0] [--only engine/contact] [--out build/mutation] [--again LOG]: whether the
tests notice when the engine is wrong. Makes small changes to the engine's sources, one at a time, in a copy of the tree: a
sign, a comparison, a constant, a line that is dropped. Each is built and tried by the tests of its own folder, then by all
of the engine's and the physics' tests and the explorer's first worlds. What is noticed, by a test that fails or runs four
times as long, is killed; what is not survives, and wants a test or a reason. Prints a line a change, the survivors again and
the share that was killed. --again tries what survived a run, by the tests that may be new: those of its folder, and the
explorer's worlds.

Needs what the build needs; the copy is built without GL. A change that does not compile is not counted."""
import argparse
import dataclasses
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
MEMORY_BYTES = 4 << 30  # a loop that never ends may fill it before its time is over
BINARIES = ("engine_tests", "no_allocation_tests", "physics_tests")
JOBS = len(os.sched_getaffinity(0))
EXPLORED = ["--seeds", "300", "--shrink", "0", "--jobs", str(JOBS), "--open", "tests/explore/open.txt",
            "--cases", "tests/explore/cases"]


@dataclasses.dataclass(frozen=True)
class Change:
    path: str
    line: int  # from 1
    kind: str
    before: str
    after: str

    def __str__(self):
        return f"{self.path}:{self.line} {self.kind}: {self.before.strip()}  ->  {self.after.strip() or '(dropped)'}"


def code_of(text):
    """The text with comments, strings and directives blanked, place for place."""
    blank = lambda match: re.sub(r"[^\n]", " ", match[0])
    return re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|^\s*#[^\n]*', blank, text, flags=re.S | re.M)


# kind: (pattern in code, what takes the place of its first group)
REPLACEMENTS = {
    "sign": [(r"(?<=[\w)\]] )([+-])(?= [\w(])", lambda sign: "-" if sign == "+" else "+"),
             (r"(?<= )([+-]=)(?= )", lambda sign: "-=" if sign == "+=" else "+=")],
    "comparison": [(r"(?<=[\w)\]] )(<=|>=|<|>|==|!=)(?= [\w(-])",
                    lambda c: {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "!=", "!=": "=="}[c]),
                   (r"(?<= )(&&|\|\|)(?= )", lambda c: "||" if c == "&&" else "&&")],
    "constant": [(r"(?<![\w.])(0x1p-\d+|\d+(?:\.\d+)?(?:e-?\d+)?)(?![\w.])",
                  lambda c: {"0": "1", "0.0": "1.0", "1": "2"}.get(c, f"({c} * 2)"))],
}
# A statement by itself that a program compiles without.
DROPPED = re.compile(r"^\s+[\w.\->\[\]()*]+(\([^;{}]*\)|\s*[-+*/|]?=[^=;{}][^;{}]*|\+\+|--);\s*$")
# Not of the outcome: how much room is taken beforehand, and what is asked of a caller.
PASSED_OVER = re.compile(r"\breserve\(|REQUIRE|static_assert|\binclude\b|template|^\s*(const|constexpr|using|return|break)\b.*\bk[A-Z]\w*Bytes")


def changes_of(path, text):
    lines, code = text.splitlines(), code_of(text).splitlines()
    for number, (line, bare) in enumerate(zip(lines, code), 1):
        if not bare.strip() or PASSED_OVER.search(line):
            continue
        for kind, patterns in REPLACEMENTS.items():
            for pattern, replacement in patterns:
                for match in re.finditer(pattern, bare):
                    begin, end = match.span(1)
                    yield Change(path, number, kind, line, line[:begin] + replacement(match[1]) + line[end:])
        if DROPPED.match(bare):
            yield Change(path, number, "line", line, "")


def chosen(root, only, count, seed):
    """As many of each kind as of the others, as far as there are."""
    by_kind = {}
    for source in sorted((root / "engine").rglob("*.cpp")):
        path = source.relative_to(root).as_posix()
        if re.search(only, path):
            for change in changes_of(path, source.read_text()):
                by_kind.setdefault(change.kind, []).append(change)
    draw = random.Random(seed)
    for kind in sorted(by_kind):
        draw.shuffle(by_kind[kind])
    changes = []
    while len(changes) < count and any(by_kind.values()):
        for kind in sorted(by_kind):
            if by_kind[kind] and len(changes) < count:
                changes.append(by_kind[kind].pop())
    return changes


def survived(root, log):
    """The changes that the printed log of a run says survived, where the sources still have their lines: of equal ones the
    nearest."""
    there = {}
    for source in sorted((root / "engine").rglob("*.cpp")):
        for change in changes_of(source.relative_to(root).as_posix(), source.read_text()):
            path, line, rest = re.match(r"(.*?):(\d+) (.*)", str(change)).groups()
            there.setdefault((path, rest), []).append((int(line), change))
    found = []
    for path, line, rest in sorted(set(re.findall(r"^SURVIVED +(.*?):(\d+) (.*)$", log.read_text(), re.M))):
        if equal := there.get((path, rest)):
            found.append(min(equal, key=lambda known: abs(known[0] - int(line)))[1])
        else:
            print(f"gone         {path}:{line} {rest}", flush=True)
    return found


def suites_beside(root, path):
    """A filter of the tests in the folder that mirrors a source's."""
    names = set()
    for test in (root / "tests" / path).parent.glob("*_test.cpp"):
        names.update(re.findall(r"^TEST(?:_F|_P)?\(\s*(\w+)", test.read_text(), re.M))
    return ":".join(f"{name}.*:*/{name}.*" for name in sorted(names))


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))


class Copy:
    """A copy of the tree and its build."""

    def __init__(self, out, options):
        self.tree, self.build = out / "tree", out / "tree" / "build" / "release"
        shutil.rmtree(self.tree / "engine", ignore_errors=True)
        listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard"], check=True,
                                capture_output=True, text=True).stdout.splitlines()
        for name in listed:
            if name.startswith("tests/golden") or not (ROOT / name).is_file():
                continue
            place = self.tree / name
            place.parent.mkdir(parents=True, exist_ok=True)
            text = (ROOT / name).read_bytes()
            if not place.exists() or place.read_bytes() != text:  # what is as it was is not built again
                place.write_bytes(text)
        subprocess.run(["cmake", "-S", str(self.tree), "-B", str(self.build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DCAROM_RENDERER=OFF", *options], check=True, stdout=subprocess.DEVNULL)

    def make(self, *binaries):
        """Whether it compiles."""
        return subprocess.run(["cmake", "--build", str(self.build), "-j", str(JOBS), "--target", *binaries],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0

    def run(self, binary, tests, limit_s):
        """The first test that fails, or "time"; None: all pass."""
        began, shards, failed = time.monotonic(), [], None
        for shard in range(JOBS):
            command = [str(self.build / "tests" / binary), "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={tests}"]
            environment = {**os.environ, "GTEST_TOTAL_SHARDS": str(JOBS), "GTEST_SHARD_INDEX": str(shard)}
            shards.append(subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                           errors="replace", env=environment, preexec_fn=limit_memory))
        for shard in shards:
            try:
                said, _ = shard.communicate(timeout=max(0.1, limit_s - (time.monotonic() - began)) if not failed else 0.1)
            except subprocess.TimeoutExpired:
                shard.kill()
                shard.communicate()
                failed = failed or "time"
                continue
            if shard.returncode != 0 and not failed:
                name = re.search(r"^\[  FAILED  \] ([\w./]+)", said, re.M)
                failed = name[1] if name else f"an end with {shard.returncode}"
        return failed


    def explore(self, limit_s):
        """What of the explorer's worlds fails, or "time"; None: nothing."""
        command = [str(self.build / "tests" / "explore"), *EXPLORED, "--out", str(self.build / "explored")]
        try:
            explorer = subprocess.run(command, cwd=self.tree, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                      errors="replace", timeout=limit_s)
        except subprocess.TimeoutExpired:
            return "time"
        failed = re.search(r"^to be mended, or listed with its cause: (.+?) #", explorer.stdout, re.M)
        return None if explorer.returncode == 0 else f"the explorer: {failed[1] if failed else explorer.returncode}"


def allowed_s(run):
    """How long tests may take with a change: four times what they take without, and what a busy machine adds. Runs them by
    `run(limit_s)`."""
    began = time.monotonic()
    if killer := run(3600):
        sys.exit(f"the tree as it is fails {killer}")
    return 4 * (time.monotonic() - began) + 10


def survives(copy, change, binaries, limits_s):
    """None: not counted; else what killed it, or "" for nothing. limits_s: by binary, and by the filter of a folder's tests."""
    source = copy.tree / change.path
    text = source.read_text()
    lines = text.splitlines(keepends=True)
    lines[change.line - 1] = change.after + "\n"
    source.write_text("".join(lines))
    try:
        if not copy.make("engine_tests"):
            return None
        beside = suites_beside(copy.tree, change.path)
        if beside and (killer := copy.run("engine_tests", beside, limits_s[beside])):
            return killer
        for binary in binaries:
            if not copy.make(binary):
                return None
            if killer := copy.run(binary, "*", limits_s[binary]):
                return killer
        return copy.explore(limits_s["explore"]) or "" if copy.make("explore") else None
    finally:
        source.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200, help="changes that are tried (200)")
    parser.add_argument("--seed", type=int, default=1, help="which (1)")
    parser.add_argument("--from", dest="first", type=int, default=0, help="so many of them are passed over (0)")
    parser.add_argument("--only", default="", help="a regular expression that the sources' paths hold")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build" / "mutation", help="where the copy is made")
    parser.add_argument("--again", type=pathlib.Path, help="what survived the run that printed this file")
    parser.add_argument("--list", action="store_true", help="prints the changes and tries none")
    parser.add_argument("options", nargs="*", help="options for CMake, after --")
    options = parser.parse_args()
    if options.list:
        for change in chosen(ROOT, options.only, options.count, options.seed)[options.first:]:
            print(change)
        return 0
    binaries = BINARIES if options.again is None else ()
    copy = Copy(options.out.resolve(), options.options)
    if not copy.make("engine_tests", *binaries, "explore"):
        sys.exit("the tree as it is does not build")
    changes = survived(copy.tree, options.again)[options.first:options.count] if options.again else \
        chosen(copy.tree, options.only, options.count, options.seed)[options.first:]
    limits_s = {binary: allowed_s(lambda limit_s: copy.run(binary, "*", limit_s)) for binary in binaries}
    for beside in {suites_beside(copy.tree, change.path) for change in changes} - {""}:
        limits_s[beside] = allowed_s(lambda limit_s: copy.run("engine_tests", beside, limit_s))
    limits_s["explore"] = allowed_s(copy.explore)
    killed, survivors = 0, []
    for change in changes:
        outcome = survives(copy, change, binaries, limits_s)
        if outcome is None:
            print(f"not built    {change}", flush=True)
        elif outcome:
            killed += 1
            print(f"killed       {change}  by {outcome}", flush=True)
        else:
            survivors.append(change)
            print(f"SURVIVED     {change}", flush=True)
    for change in survivors:
        print(f"survivor: {change}")
    tried = killed + len(survivors)
    print(f"{killed} of {tried} changes were killed" + (f": {100 * killed / tried:.0f} %" if tried else ""))
    return 0


if __name__ == "__main__":
    sys.exit(main())
