"""Reads the documents of the tree: their fenced blocks, links, headings and words. Tested in
tests/documents/checks_test.py."""
import dataclasses
import pathlib
import re
import subprocess

# What a block's info string may say after its language, besides nothing:
#   not-run: REASON    a command that cannot be run here, and why
#   file: PATH         the block is written to this file, for the commands that follow
#   part-of: PATH      every line of the block is a line of that file of the tree
#   in-scene           the block is part of a scene that is valid
REMARKS = ("not-run", "file", "part-of", "in-scene")
COMMANDS = ("sh", "console")


@dataclasses.dataclass
class Block:
    document: str
    line: int
    language: str
    remark: str
    value: str
    lines: list

    @property
    def place(self):
        return f"{self.document}:{self.line}"


def documents_of(root):
    """The paths of all Markdown files that belong to the tree, from the root."""
    try:
        out = subprocess.run(["git", "-C", str(root), "ls-files", "-co", "--exclude-standard", "*.md"],
                             capture_output=True, text=True)
        if out.returncode == 0 and out.stdout:
            return sorted(line for line in out.stdout.splitlines() if (root / line).exists())
    except FileNotFoundError:  # no git: a tree of an archive
        pass
    folders = (".github", "assets", "demos", "engine", "renderer", "tests")
    found = [*root.glob("*.md"), *(path for folder in folders for path in (root / folder).rglob("*.md"))]
    return sorted(path.relative_to(root).as_posix() for path in found)


def blocks_of(document, text):
    """The fenced blocks, and the same text without them."""
    blocks, prose, block = [], [], None
    for number, line in enumerate(text.splitlines(), 1):
        fence = re.match(r"^\s*```(.*)$", line)
        if fence and block is None:
            language, _, rest = fence[1].strip().partition(" ")
            remark, _, value = rest.strip().partition(":")
            block = Block(document, number, language, remark.strip(), value.strip(), [])
        elif fence:
            blocks.append(block)
            block = None
        elif block is not None:
            block.lines.append(line)
        else:
            prose.append(line)
            continue
        prose.append("")
    if block is not None:
        raise ValueError(f"{block.place}: a block has no end")
    return blocks, "\n".join(prose)


def steps_of(block):
    """The commands of a block, each with the output that is shown of it and its exit code. Of `sh` nothing is
    shown; in `console` a command begins with "$ ", goes on after a backslash, and "[exit code N]" ends it."""
    if block.language == "sh":
        return [("\n".join(block.lines), None, 0)]
    steps = []
    for line in block.lines:
        code = re.fullmatch(r"\[exit code (\d+)\]", line)
        if line.startswith("$ "):
            steps.append([line[2:], [], 0])
        elif not steps:
            raise ValueError(f"{block.place}: output before the first command")
        elif code:
            steps[-1][2] = int(code[1])
        elif steps[-1][0].endswith("\\") and not steps[-1][1]:
            steps[-1][0] += "\n" + line
        else:
            steps[-1][1].append(line)
    return [tuple(step) for step in steps]


def is_shown(shown, printed):
    """Whether `printed` is what the lines `shown` say. A line "..." stands for any lines, "..." within a line for any
    text; where a document breaks a long line, it is one line all the same."""
    parts = []
    for index, line in enumerate(shown):
        if line.strip() == "...":
            parts.append(r"(?:.*\n)*")
        else:
            joined = r"\n" if index + 1 == len(shown) or shown[index + 1].strip() == "..." else r"\n?"
            parts.append(".*".join(re.escape(piece) for piece in line.rstrip().split("...")) + r"[ \t]*" + joined)
    text = "\n".join(line.rstrip() for line in printed.splitlines()) + "\n" if printed else ""
    return re.fullmatch("".join(parts), text) is not None


def anchors_of(text):
    """The anchors that GitHub gives the headings."""
    anchors, seen = set(), {}
    _, prose = blocks_of("", text)
    for heading in re.findall(r"^#{1,6} +(.+?)\s*$", prose, re.M):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        anchor = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        count = seen.get(anchor, 0)
        seen[anchor] = count + 1
        anchors.add(f"{anchor}-{count}" if count else anchor)
    return anchors


def links_of(text):
    """The targets of links and pictures, outside blocks and code."""
    _, prose = blocks_of("", text)
    prose = re.sub(r"`[^`\n]*`", "", prose)
    return re.findall(r"\]\(([^)\s]+)\)", prose) + re.findall(r'<(?:img|a)\b[^>]*?(?:src|href)="([^"]+)"', prose)


def named_paths_of(text):
    """What stands in `code` and looks like a path of the tree: folders/..., with an ending or a slash at the end."""
    _, prose = blocks_of("", text)
    for token in re.findall(r"`([^`\s]+)`", prose):
        if re.fullmatch(r"(?:\.ci|\.github|assets|demos|engine|renderer|tests)/[\w./\-]*(?:\.\w+|/|\.ci/run)", token):
            yield token


def comments_of(source):
    """The comments of C++ text, each run of // lines as one line of text, with the number of its first line."""
    found, run, first = [], [], 0
    for number, line in enumerate(source.splitlines(), 1):
        match = re.search(r'(?<![:"\w])//[/!]?<?(.*)$', line)
        if match and (line.lstrip().startswith("//") or not run):
            if not run:
                first = number
            run.append(match[1].strip())
            if line.lstrip().startswith("//"):
                continue
        elif match:
            found.append((first, " ".join(run)))
            run, first = [match[1].strip()], number
        if run:
            found.append((first, " ".join(run)))
            run = []
    if run:
        found.append((first, " ".join(run)))
    return found


def sources_of(root, folders, endings=(".h", ".cpp")):
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in endings and path.is_file():
                yield path.relative_to(root).as_posix(), path.read_text()
