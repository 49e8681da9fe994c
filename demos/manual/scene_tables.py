#!/usr/bin/env python3
"""Writes the tables of scene-format.md from assets/scene.schema.json: scene_tables.py; with --check it ends with 1 where
they are not the schema's. Needs only Python 3."""
import json
import pathlib
import sys

BEGIN = "<!-- The tables that follow are made by demos/manual/scene_tables.py. -->"
END = "<!-- Here they end. -->"
HERE = pathlib.Path(__file__).resolve().parent
SCHEMA = HERE.parent.parent / "assets/scene.schema.json"


def named(value, schema):
    """The rule that a $ref means, with what stands beside it."""
    if "$ref" not in value:
        return value, None
    name = value["$ref"].rsplit("/", 1)[1]
    return {**schema["$defs"][name], **{key: beside for key, beside in value.items() if key != "$ref"}}, name


def number(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def range_of(rule):
    low, high = rule.get("minimum"), rule.get("maximum")
    if "exclusiveMinimum" in rule:
        return f"more than {number(rule['exclusiveMinimum'])}, to {number(high)}"
    if low is None and high is None:
        return ""
    return f"{number(low)} to {number(high)}"


# Rules that are told where they are used; every other has a table of its own.
INLINE = ("vector", "length", "color", "box", "up", "fov", "aperture", "focus")


def kind_of(value, schema):
    rule, name = named(value, schema)
    if name == "vector":
        return "[x, y, z]"
    if name == "color":
        return '"#rrggbb"'
    if name and name not in INLINE:
        return name
    if "const" in rule:
        return json.dumps(rule["const"])
    if "enum" in rule:
        return " or ".join(json.dumps(choice) for choice in rule["enum"])
    if "oneOf" in rule:
        return " or ".join(kind_of(choice, schema) for choice in rule["oneOf"])
    if rule.get("type") == "array":
        size = f" of {rule['minItems']}" if rule.get("minItems") == rule.get("maxItems") and "minItems" in rule else ""
        return f"list{size}: {kind_of(rule.get('items', {}), schema)}"
    if rule.get("type") == "object":
        if "additionalProperties" in rule and rule["additionalProperties"] is not False:
            return f"names: {kind_of(rule['additionalProperties'], schema)}"
        return "object"
    if rule.get("type") in ("number", "integer"):
        limits = range_of(rule)
        return rule["type"] + (f", {limits}" if limits else "")
    return rule.get("type", "")


def rows_of(rule, schema, prefix=""):
    required = set(rule.get("required", []))
    for key, value in rule.get("properties", {}).items():
        inner, name = named(value, schema)
        text = value.get("description") or inner.get("description", "")
        linked = name and name not in INLINE
        if linked:
            text = value.get("description", "")
        yield f"| `{prefix}{key}`{' (needed)' if key in required else ''} | {kind_of(value, schema)} | {text} |"
        if not linked and inner.get("type") == "object" and inner.get("additionalProperties") is False:
            yield from rows_of(inner, schema, f"{prefix}{key}.")


def table(title, rule, schema):
    yield f"## {title}"
    yield ""
    if title != "A scene" and rule.get("description"):
        yield rule["description"]
        yield ""
    if "oneOf" in rule and "properties" not in rule:
        for choice in rule["oneOf"]:
            yield from choice_table(choice, schema)
        return
    yield "| key | value | |"
    yield "|---|---|---|"
    yield from rows_of(rule, schema)
    yield ""


def choice_table(choice, schema):
    if choice.get("description"):
        yield choice["description"]
        yield ""
    if choice.get("type") != "object":
        yield f"Or {kind_of(choice, schema)}."
        yield ""
        return
    yield "| key | value | |"
    yield "|---|---|---|"
    yield from rows_of(choice, schema)
    yield ""


def tables():
    schema = json.loads(SCHEMA.read_text())
    lines = [BEGIN, "", *table("A scene", schema, schema)]
    for name, rule in schema["$defs"].items():
        if name not in INLINE:
            lines += table(name, rule, schema)
    return "\n".join(lines + [END])


def main():
    page = HERE / "scene-format.md"
    text = page.read_text()
    begin, end = text.index(BEGIN), text.index(END) + len(END)
    wanted = text[:begin] + tables() + text[end:]
    if wanted == text:
        return 0
    if "--check" in sys.argv[1:]:
        print("demos/manual/scene-format.md is not what assets/scene.schema.json says: demos/manual/scene_tables.py")
        return 1
    page.write_text(wanted)
    return 0


if __name__ == "__main__":
    sys.exit(main())
