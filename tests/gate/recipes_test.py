#!/usr/bin/env python3
"""Runs the commands that demos/manual/recipes hold, as far as they can be run here.

    python3 tests/gate/recipes_test.py CAROM [BUILD]

A repository as the recipes want it is made in a folder of its own; every `carom` line of both services' files and of
the README is run in it, first as it is (all must pass), then with a body moved (the frames must fail and name it).
The YAML files are parsed where Python has a parser. With BUILD, a build folder, Carom is installed from it and the
CMake project is configured and tested against that. Of the Containerfile it is checked that every command exists.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECIPES = ROOT / "demos/manual/recipes"


def carom_lines(text):
    return re.findall(r"^\s*(?:- |run: )?(?:- )?(carom (?:regress|budget) .+)$", text, flags=re.M)


def run(line, folder, expected=0):
    end = subprocess.run(line, shell=True, cwd=folder, capture_output=True, text=True)
    if end.returncode != expected:
        sys.exit("%s: ended with %d, not %d:\n%s%s" % (line, end.returncode, expected, end.stdout, end.stderr))
    return end.stdout


def check_yaml(path):
    text = path.read_text()
    if "\t" in text:
        sys.exit("%s: a tab" % path)
    try:
        import yaml
    except ImportError:
        print("%s: not parsed, for Python has no yaml here" % path.name)
        return
    data = yaml.safe_load(text)
    jobs = data["jobs"] if "jobs" in data else {"frames": data["frames"]}
    for name, job in jobs.items():
        steps = job.get("steps") or job.get("script")
        does = steps and all(isinstance(step, str) or ("uses" in step) != ("run" in step) for step in steps)
        if not does:
            sys.exit("%s: job %s has a step that does nothing, or two things" % (path, name))


def check_services(carom):
    commands = {name: carom_lines((RECIPES / name).read_text()) for name in
                ("github-actions.yml", "gitlab-ci.yml", "README.md")}
    if not all(len(lines) >= 3 for lines in commands.values()):
        sys.exit("a recipe has lost its commands: %s" % commands)
    if commands["github-actions.yml"] != commands["gitlab-ci.yml"]:
        sys.exit("the two services run other commands")
    with tempfile.TemporaryDirectory(prefix="carom-recipes-") as name:
        folder = pathlib.Path(name)
        (folder / "bin").mkdir()
        (folder / "bin/carom").symlink_to(carom)
        os.environ["PATH"] = "%s:%s" % (folder / "bin", os.environ["PATH"])
        (folder / "golden").mkdir()
        (folder / "golden/suite.json").write_text(
            '{ "render": ["--portable", "--size", "160x90", "--fps", "2", "--duration", "1"],\n'
            '  "scenes": ["sliding", { "name": "ball", "scene": "ball.json" }] }\n')
        scene = (ROOT / "assets/scenes/bouncing-ball.json").read_text()
        (folder / "golden/ball.json").write_text(scene)
        run("carom regress golden --update -o first", folder)
        run("carom budget sliding --size 320x180 --duration 2 --budget 1000 --clock cpu --json golden/budget.json", folder)
        for line in commands["gitlab-ci.yml"]:
            # Times may be too noisy to judge here; what is tried is that the command runs and does the same work.
            if "--baseline" in line:
                end = subprocess.run(line, shell=True, cwd=folder, capture_output=True, text=True)
                if "the same work in every frame" not in end.stdout:
                    sys.exit("%s: %s%s" % (line, end.stdout, end.stderr))
            else:
                run(line, folder)
        moved = re.sub(r'("position": \[[^,]+,[^,]+, *)([0-9.]+)', lambda m: m.group(1) + str(float(m.group(2)) + 0.1),
                       scene)
        if moved == scene:
            sys.exit("bouncing-ball has no position to move")
        (folder / "golden/ball.json").write_text(moved)
        said = run(commands["gitlab-ci.yml"][0], folder, expected=1)
        if "away from where it was" not in said or not (folder / "out/index.html").exists():
            sys.exit("a moved body is not named: %s" % said)


def check_containerfile():
    text = (RECIPES / "Containerfile").read_text()
    for name in re.findall(r"install_missing_packages|build_release", text):
        if name + "()" not in (ROOT / "demos/packages.sh").read_text():
            sys.exit("Containerfile: packages.sh has no %s" % name)
    if not re.search(r"^FROM .+ AS build$", text, flags=re.M) or "COPY --from=build" not in text:
        sys.exit("Containerfile: its stages have come apart")


def check_cmake(build):
    with tempfile.TemporaryDirectory(prefix="carom-recipes-") as name:
        folder = pathlib.Path(name)
        shutil.copytree(RECIPES / "cmake", folder / "project")
        run("cmake --install %s --prefix %s/prefix >log" % (build, folder), folder)
        run("cmake -S project -B build -G Ninja -DCMAKE_PREFIX_PATH=%s/prefix" % folder, folder)
        end = subprocess.run("ctest --test-dir build --output-on-failure", shell=True, cwd=folder, capture_output=True,
                             text=True)
        accept = re.search(r"accept the frames with:\s+(.+ --update)", end.stdout + end.stderr)
        if not accept:
            sys.exit("the first run prints no command that accepts: %s" % end.stdout)
        run(accept.group(1), folder)
        run("ctest --test-dir build --output-on-failure", folder)


def main():
    carom = pathlib.Path(sys.argv[1]).resolve()
    for name in ("github-actions.yml", "gitlab-ci.yml"):
        check_yaml(RECIPES / name)
    check_services(carom)
    check_containerfile()
    if len(sys.argv) > 2:
        check_cmake(pathlib.Path(sys.argv[2]).resolve())
    print("all recipes run")


if __name__ == "__main__":
    main()
