"""What must hold of the documents; each check returns its findings, one line each. Tested in
tests/documents/checks_test.py, where each is seen to find what it is for."""
import json
import os
import pathlib
import re
import shutil
import subprocess

import document as doc
import words

README_BYTES = 6144
APNG_BYTES = 1536 * 1024


def texts(root):
    return {name: (root / name).read_text() for name in doc.documents_of(root)}


def sizes(root):
    """README.md fits one minute's reading, its moving picture one second's loading."""
    readme = root / "README.md"
    size = readme.stat().st_size
    if size > README_BYTES:
        yield f"README.md: {size} bytes; at most {README_BYTES}"
    for link in doc.links_of(readme.read_text()):
        if link.endswith(".png") and (root / link).exists() and (root / link).stat().st_size > APNG_BYTES:
            yield f"README.md: {link} has {(root / link).stat().st_size} bytes; at most {APNG_BYTES}"


def links(root):
    """Every relative link leads to a file of the tree, and its anchor to a heading."""
    for name, text in texts(root).items():
        for link in doc.links_of(text):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            target = (root / name).parent / path if path else root / name
            if not target.exists():
                yield f"{name}: no {path}"
            elif anchor and target.suffix == ".md" and anchor not in doc.anchors_of(target.read_text()):
                yield f"{name}: no heading #{anchor} in {path or name}"


def named_paths(root):
    """Every path of the tree that a document names is there."""
    for name, text in texts(root).items():
        for path in doc.named_paths_of(text):
            if not (root / path).exists():
                yield f"{name}: no {path}"


def tests_of_heads(root):
    """Every test that a comment names is there."""
    for name, source in doc.sources_of(root, ("engine", "renderer", "demos", "tests")):
        for line, comment in doc.comments_of(source):
            for path in re.findall(r"\btests/[\w./\-]+", comment):
                path = path.rstrip(".")
                if path.startswith("tests/") and re.search(r"(_test\.cpp|\.py|\.sh|\.h|\.md|/)$", path) and not (root / path).exists():
                    yield f"{name}:{line}: no {path}"


def table_of(text, heading):
    """The rows of the first table below a heading, without its head."""
    found = re.search(rf"^#+ {re.escape(heading)}\s*$(.*?)(?=^#|\Z)", text, re.M | re.S)
    rows = [line for line in found[1].splitlines() if line.startswith("|")] if found else []
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", row.strip().strip("|"))] for row in rows[2:]]


def departures(root):
    """Every DEVIATES: mark of a source has its row in engine/README.md, and every row its mark."""
    marks, rows = {}, {}
    for name, source in doc.sources_of(root, ("engine",)):
        count = sum(comment.count("DEVIATES:") for _, comment in doc.comments_of(source))
        if count:
            marks[name] = count
    for row in table_of((root / "engine/README.md").read_text(), "Departures from the paper"):
        for path in re.findall(r"`(engine/[\w./]+)`", row[-1]):
            rows[path] = rows.get(path, 0) + 1
    for name in sorted(marks.keys() | rows.keys()):
        if marks.get(name, 0) != rows.get(name, 0):
            yield f"{name}: {marks.get(name, 0)} DEVIATES: marks, {rows.get(name, 0)} rows in engine/README.md"


def bibliography_of(text):
    """(surnames, year) of each entry: a list item that begins with the authors and has the year in brackets."""
    found = re.search(r"^#+ Bibliography\s*$(.*?)(?=^#|\Z)", text, re.M | re.S)
    entries = []
    for item in re.findall(r"^- (.*?)(?=^- |\Z)", found[1] if found else "", re.M | re.S):
        head = re.match(r"(.+?)\((\d{4})\)", " ".join(item.split()))
        if head:
            entries.append((set(re.findall(r"[A-Z][\w']+", head[1])), head[2], item))
        else:
            entries.append((set(), "", item))
    return entries


def citations(root):
    """Every year that a comment cites has an author before it, and both an entry in the bibliography; and every entry
    begins with authors and a year."""
    entries = bibliography_of((root / "engine/README.md").read_text())
    for names, year, item in entries:
        if not names:
            yield f"engine/README.md: no author and (year) in: {item[:60]}"
    for name, source in doc.sources_of(root, ("engine", "renderer")):
        for line, comment in doc.comments_of(source):
            for cited in re.finditer(r"(?<![\w.^#-])(1[6-9]\d\d|20[0-4]\d)(?![\w.]\d|\d|\w| \w+ ?[=+*/])", comment):
                before = set(re.findall(r"[A-Z][\w']+", comment[max(0, cited.start() - 160):cited.start()]))
                if not before or comment[:cited.start()].endswith("RFC "):
                    continue  # a number, not a year
                if not any(year == cited[1] and names & before for names, year, _ in entries):
                    yield f"{name}:{line}: {cited[1]} is not in the bibliography: ...{comment[max(0, cited.start() - 50):cited.end()]}"


def remarks(root):
    """Blocks say of what language they are, and commands that are not run why not; no command hides in indented text."""
    for name, text in texts(root).items():
        for line in doc.blocks_of(name, text)[1].splitlines():
            if re.match(r"(?: {4}|\t)\s*(?:\$ )?(?:bash|carom|cmake|ctest|python3|doxygen|npm|apt-get|make) ", line):
                yield f"{name}: a command outside a block: {line.strip()}"
        for block in doc.blocks_of(name, text)[0]:
            if not block.language:
                yield f"{block.place}: a block without a language"
            if block.remark and block.remark not in doc.REMARKS:
                yield f"{block.place}: unknown remark {block.remark}; accepted: {', '.join(doc.REMARKS)}"
            if block.remark == "not-run" and len(block.value.split()) < 3:
                yield f"{block.place}: not run, without a reason"


def parts(root):
    """Blocks that are part of a file of the tree still are."""
    for name, text in texts(root).items():
        for block in doc.blocks_of(name, text)[0]:
            if block.remark != "part-of":
                continue
            source = root / block.value
            lines = {" ".join(line.split()) for line in source.read_text().splitlines()} if source.exists() else set()
            for line in block.lines:
                if line.strip() not in ("", "...") and " ".join(line.split()) not in lines:
                    yield f"{block.place}: not in {block.value}: {line}"


def whole_scene(fragment):
    """A valid scene around members of one."""
    text = "\n".join(fragment).rstrip().rstrip(",")
    bodies = "" if '"bodies"' in text else \
        ',\n"bodies": [ { "name": "crate", "shape": { "box": [1, 1, 1] }, "position": [0, 0, 1] } ]'
    return '{ "format": 1,\n' + text + bodies + " }\n"


def scenes(root, program, work):
    """Members of a scene that a document shows are accepted."""
    for name, text in texts(root).items():
        for block in doc.blocks_of(name, text)[0]:
            if block.remark == "in-scene":
                scene = pathlib.Path(work) / "shown.json"
                scene.write_text(whole_scene(block.lines))
                run = subprocess.run([program, "check", str(scene)], capture_output=True, text=True)
                if run.returncode:
                    yield f"{block.place}: {run.stderr.strip()}"


def reference(root, work):
    """The API reference is made of the headers without a warning."""
    settings = (root / "engine/Doxyfile").read_text() + f"\nOUTPUT_DIRECTORY = {work}\n"
    run = subprocess.run(["doxygen", "-"], input=settings, cwd=root, capture_output=True, text=True)
    if run.returncode:
        yield f"doxygen ended with {run.returncode}"
    yield from (line for line in run.stderr.splitlines() if line.strip())


def copy_of_the_tree(root, work):
    """A copy in which commands may write what they like."""
    target = pathlib.Path(work) / "carom"
    shutil.copytree(root, target, symlinks=True,
                    ignore=lambda folder, names: [n for n in names if n in (".git", "build", "frames", ".cache", "out")])
    return target


def commands(root, name, program, work, seconds=300):
    """Every command of one document ends as it says, in a copy of the tree, and prints what is shown of it."""
    tree = copy_of_the_tree(root, work)
    tools = pathlib.Path(work) / "bin"
    tools.mkdir()
    (tools / "carom").symlink_to(program)
    environment = dict(os.environ, PATH=f"{tools}:{os.environ['PATH']}", XDG_CACHE_HOME=str(work))
    for block in doc.blocks_of(name, (root / name).read_text())[0]:
        if block.remark == "file":
            (tree / block.value).write_text("\n".join(block.lines) + "\n")
        if block.language not in doc.COMMANDS or block.remark in ("not-run", "file", "part-of"):
            continue
        for command, shown, code in doc.steps_of(block):
            try:
                run = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", command], cwd=tree, env=environment, text=True,
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                     timeout=seconds)
            except subprocess.TimeoutExpired:
                yield f"{block.place}: not ended after {seconds} s: {command}"
                continue
            if run.returncode != code:
                yield f"{block.place}: exit code {run.returncode}, not {code}: {command}\n{run.stdout}"
            if shown is not None and not doc.is_shown(shown, run.stdout):
                yield f"{block.place}: {command}\nshown:\n" + "\n".join(shown) + f"\nprinted:\n{run.stdout}"


CHECKS = {"sizes": sizes, "links": links, "paths": named_paths, "tests": tests_of_heads, "departures": departures,
          "citations": citations, "remarks": remarks, "parts": parts, "words": words.retired_words}
