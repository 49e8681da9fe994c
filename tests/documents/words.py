"""The field's words: what a reader of Mirtich, Baraff, Box2D and Drake would have to learn first is not said, in names,
comments, messages or documents. Tested in tests/documents/checks_test.py."""
import re

import document as doc

# Retired everywhere: the word, as it stands in running text and in names, and the field's.
RETIRED = {
    r"crowd(s|ed|ing)?": "a large island; over budget; many bodies: say which",
    r"crews?": "thread pool",
    r"stir(s|red|ring)?": "accumulated velocity change",
    r"lively": "nearly elastic",
    r"patience(?! sort)": "back-off of the direct solve",
    r"swept alone|sweeps alone": "back-off of the direct solve",
    r"in vain": "say what did not come of it",
    r"finely": "by the method: nonsmooth conjugate gradients",
    r"focused": "by the method: active set",
    r"standing solver": "by the method: direct",
    r"parts? idly|idle rows?": "a row that cannot close",
    r"carr(y|ies) on|take up(?! to)": "process the search's result",
    r"fullness": "relative amplitude",
    r"mid step": "midpoint rule",
}
# In the engine these are names for quantities, and there the field has better ones.
RETIRED_IN_THE_ENGINE = {
    r"clearly": "certified",
    r"alike": "similar, equal",
    r"slack": "margin",
    r"roomy|make room|with room|k room": "margin, clearance, fat bounds",
    r"blur(s|red)?": "uncertainty",
}
# Where they are still said: these files are being written anew. A pattern that excuses nothing is a finding.
OPEN = (
    r"engine/simulation/",
    r"engine/response/",
    r"tests/engine/simulation/",
    r"tests/engine/response/",
    r"engine/foundation/crew\.",  # used by both under that name
    r"tests/engine/foundation/crew_test\.cpp",
    r"engine/modes/resting\.",  # a member of what engine/simulation asks it
    r"engine/decisions/",  # what was thought then, in the words of then
)


def words_of(text):
    """Running text and names as words: kSolverCrowdResidual is "k solver crowd residual"."""
    apart = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|_", " ", text)
    return re.sub(r"[ \t/*]+", " ", apart).lower()


def retired_words(root, excused=OPEN):
    """No source and no document says a retired word."""
    present, used = set(), set()
    everywhere = re.compile(r"\b(" + "|".join(RETIRED) + r")\b")
    in_engine = re.compile(r"\b(" + "|".join([*RETIRED, *RETIRED_IN_THE_ENGINE]) + r")\b")
    better = {**RETIRED, **RETIRED_IN_THE_ENGINE}
    texts = [*doc.sources_of(root, ("engine", "renderer", "demos", "tests")),
             *((name, (root / name).read_text()) for name in doc.documents_of(root))]
    for name, text in texts:
        present.update(entry for entry in excused if re.match(entry, name))
        pattern = in_engine if name.startswith("engine/") else everywhere
        for number, line in enumerate(text.splitlines(), 1):
            for match in pattern.finditer(words_of(line)):
                excuse = next((entry for entry in excused if re.match(entry, name)), None)
                if excuse:
                    used.add(excuse)
                    continue
                field = next(value for word, value in better.items() if re.fullmatch(word, match[1]))
                yield f"{name}:{number}: \"{match[1]}\" is retired: {field}"
    for entry in excused:
        if entry in present - used:
            yield f"tests/documents/words.py: {entry} says no retired word any more: take it from OPEN"
