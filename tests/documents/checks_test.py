"""Each check of the documents finds what it is for: a tree with one fault each, and one without. Run by ctest."""
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.dont_write_bytecode = True
import checks  # noqa: E402
import document as doc  # noqa: E402

ENGINE = """# Engine

## Departures from the paper

| paper | here | why | where |
|---|---|---|---|
| one | another | because | `engine/a.h` |

## Bibliography

- Mirtich, B. (1997). *V-Clip.*
"""
HEADER = """#pragma once
// The walk (paper 2; Mirtich 1997). DEVIATES: another order. Tested in
// tests/a_test.cpp.
int steps = 2000;  // at most 2000 of them
"""


class Tree(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name) / "tree"
        self.root.mkdir()
        self.put("README.md", "# Carom\n\n[engine](engine/README.md#bibliography), `engine/a.h`\n")
        self.put("engine/README.md", ENGINE)
        self.put("engine/a.h", HEADER)
        self.put("tests/a_test.cpp", "// Nothing.\n")

    def tearDown(self):
        self.folder.cleanup()

    def put(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def found(self, check):
        return list(checks.CHECKS[check](self.root))

    def commands(self, text):
        self.put("README.md", text)
        with tempfile.TemporaryDirectory() as work:
            return list(checks.commands(self.root, "README.md", "/bin/echo", work, seconds=2))


class Checks(Tree):
    def test_a_right_tree_has_no_finding(self):
        for check in checks.CHECKS:
            self.assertEqual(self.found(check), [], check)

    def test_a_readme_that_is_too_long_is_found(self):
        self.put("README.md", "x" * (checks.README_BYTES + 1))
        self.assertIn("at most 6144", self.found("sizes")[0])

    def test_a_link_to_no_file_is_found(self):
        self.put("README.md", "[x](engine/NONE.md)")
        self.assertEqual(self.found("links"), ["README.md: no engine/NONE.md"])

    def test_a_link_to_no_heading_is_found(self):
        self.put("README.md", "[x](engine/README.md#nowhere)")
        self.assertEqual(self.found("links"), ["README.md: no heading #nowhere in engine/README.md"])

    def test_links_in_code_are_no_links(self):
        self.put("README.md", "`[x](none)`\n```text\n[x](none)\n```\n")
        self.assertEqual(self.found("links"), [])

    def test_a_path_that_is_not_there_is_found(self):
        self.put("README.md", "`engine/b.h`")
        self.assertEqual(self.found("paths"), ["README.md: no engine/b.h"])

    def test_a_test_of_a_head_that_is_not_there_is_found_across_lines(self):
        self.put("engine/b.h", "// A thing. Tested in\n// tests/engine/b_test.cpp.\n")
        self.assertEqual(self.found("tests"), ["engine/b.h:1: no tests/engine/b_test.cpp"])

    def test_a_mark_without_a_row_is_found(self):
        self.put("engine/b.h", "// DEVIATES: so.\n")
        self.assertEqual(self.found("departures"), ["engine/b.h: 1 DEVIATES: marks, 0 rows in engine/README.md"])

    def test_a_row_without_a_mark_is_found(self):
        self.put("engine/a.h", "// Nothing.\n")
        self.assertEqual(self.found("departures"), ["engine/a.h: 0 DEVIATES: marks, 1 rows in engine/README.md"])

    def test_a_citation_without_an_entry_is_found(self):
        self.put("engine/b.h", "// By the method of Stronge\n// (1990).\n")
        self.assertIn("1990 is not in the bibliography", self.found("citations")[0])

    def test_the_year_has_to_be_the_entrys(self):
        self.put("engine/b.h", "// Mirtich 1996.\n")
        self.assertEqual(len(self.found("citations")), 1)

    def test_an_entry_without_a_year_is_found(self):
        self.put("engine/README.md", ENGINE + "- Somebody. *Something.*\n")
        self.assertIn("no author and (year)", self.found("citations")[0])

    def test_a_block_without_a_language_is_found(self):
        self.put("README.md", "```\nx\n```\n")
        self.assertEqual(self.found("remarks"), ["README.md:1: a block without a language"])

    def test_a_command_outside_a_block_is_found(self):
        self.put("README.md", "So:\n\n    carom list\n")
        self.assertEqual(self.found("remarks"), ["README.md: a command outside a block: carom list"])

    def test_a_command_that_is_not_run_needs_a_reason(self):
        self.put("README.md", "```sh not-run: no\nx\n```\n")
        self.assertEqual(self.found("remarks"), ["README.md:1: not run, without a reason"])

    def test_a_retired_word_is_found_in_text_and_in_names(self):
        self.put("engine/a.h", HEADER + "// A crowd.\nint kSolverCrowd = 0;  // clearly\n")
        self.put("demos/a.cpp", "// Clearly slack, which is English.\nint stir_count = 0;\n")
        found = self.found("words")
        self.assertEqual([line.split(": ")[0] for line in found],
                         ["engine/a.h:5", "engine/a.h:6", "engine/a.h:6", "demos/a.cpp:2"])

    def test_a_word_that_is_part_of_another_is_none(self):
        self.put("demos/a.cpp", "// Crowdedness, a screw and patience sorting take up to a minute.\n")
        self.assertEqual(self.found("words"), [])

    def test_a_file_that_is_excused_and_says_none_is_found(self):
        self.put("engine/response/a.cpp", "// A crowd.\n")
        self.put("engine/simulation/a.cpp", "// A large island.\n")
        found = self.found("words")
        self.assertEqual(len(found), 1)
        self.assertIn("engine/simulation/ says no retired word any more", found[0])

    def test_a_line_that_its_file_no_longer_has_is_found(self):
        self.put("README.md", "```cpp part-of: engine/a.h\nint steps = 2001;\n```\n")
        self.assertEqual(self.found("parts"), ["README.md:1: not in engine/a.h: int steps = 2001;"])


@unittest.skipUnless(shutil.which("doxygen"), "no doxygen")
class Reference(Tree):
    def found(self):
        self.put("engine/Doxyfile", "INPUT = engine\nFILE_PATTERNS = *.h\nQUIET = YES\nHAVE_DOT = NO\nGENERATE_LATEX = NO\nEXTRACT_ALL = YES\n")
        with tempfile.TemporaryDirectory() as work:
            return list(checks.reference(self.root, work))

    def test_a_header_without_fault_has_no_warning(self):
        self.put("engine/b.h", "/// Twice x.\nint twice(int x);\n")
        self.assertEqual(self.found(), [])

    def test_a_parameter_that_is_not_there_is_found(self):
        self.put("engine/b.h", "/// Twice.\n/// @param y what\nint twice(int x);\n")
        self.assertIn("argument 'y'", " ".join(self.found()))


class Commands(Tree):
    def test_a_command_that_fails_is_found(self):
        self.assertIn("exit code 3, not 0", self.commands("```sh\nexit 3\n```\n")[0])

    def test_the_first_of_several_commands_that_fails_is_found(self):
        self.assertEqual(len(self.commands("```sh\nfalse\ntrue\n```\n")), 1)

    def test_an_output_that_is_another_is_found(self):
        self.assertIn("printed:\n5.0", self.commands("```console\n$ echo 5.0\n4.0\n```\n")[0])

    def test_outputs_that_are_shown_are_compared(self):
        self.assertEqual(self.commands("```console\n$ echo 5.0; echo a\n...\na\n$ (exit 3)\n[exit code 3]\n```\n"), [])

    def test_a_command_that_prints_what_is_not_shown_is_found(self):
        self.assertEqual(len(self.commands("```console\n$ echo a\n```\n")), 1)

    def test_an_exit_code_that_is_another_is_found(self):
        self.assertIn("exit code 0, not 3", self.commands("```console\n$ true\n[exit code 3]\n```\n")[0])

    def test_a_command_that_does_not_end_is_found(self):
        self.assertIn("not ended", self.commands("```sh\nsleep 20\n```\n")[0])

    def test_the_program_is_there_and_files_that_are_shown_too(self):
        text = "```json file: a.json\n{}\n```\n```console\n$ carom check a.json; cat a.json\ncheck a.json\n{}\n```\n"
        self.assertEqual(self.commands(text), [])

    def test_commands_write_into_a_copy(self):
        self.commands("```sh\ntouch written engine/written\n```\n")
        self.assertFalse((self.root / "written").exists() or (self.root / "engine/written").exists())

    def test_commands_that_are_not_to_be_run_are_not(self):
        self.assertEqual(self.commands("```sh not-run: it would fail here\nfalse\n```\n"), [])


class Shown(unittest.TestCase):
    def test_dots_stand_for_lines_or_text(self):
        self.assertTrue(doc.is_shown(["a ... c", "...", "z"], "a b c\nx\ny\nz\n"))
        self.assertFalse(doc.is_shown(["a ... c"], "a b d\n"))

    def test_a_long_line_may_be_broken(self):
        self.assertTrue(doc.is_shown(['{"a":1,', '"b":2}'], '{"a":1,"b":2}\n'))
        self.assertFalse(doc.is_shown(['{"a":1,', '"b":3}'], '{"a":1,"b":2}\n'))

    def test_nothing_shown_is_nothing_printed(self):
        self.assertTrue(doc.is_shown([], ""))
        self.assertFalse(doc.is_shown([], "x\n"))


class Anchors(unittest.TestCase):
    def test_are_those_of_the_headings(self):
        text = "# A `b` and C\n## A, b: c!\n## Twice\n## Twice\n```sh\n# no heading\n```\n"
        self.assertEqual(doc.anchors_of(text), {"a-b-and-c", "a-b-c", "twice", "twice-1"})


if __name__ == "__main__":
    unittest.main()
