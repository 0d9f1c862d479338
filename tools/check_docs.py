#!/usr/bin/env python3
"""Holds the manual against the tree: links between pages lead somewhere, doc/reference/case.md names exactly the keys that the
case reader asks for, doc/reference/run-folder.md every column of the event table, and the theory pages every law."""
import pathlib
import re
import sys

SECTIONS = "apparatus|gas|inlet|outlet|granules|contact|spray|drying|product|start|time|output"

# Functions that read keys of sections which they are told: where their `key + "name"` belongs.
PREFIXES = {
    "case_contact.cpp": {
        "read_pair": ["contact.", "contact.wall_", "contact.pair."],
        "read_pairs": ["contact.pair."],
        "read_contact": ["material."],
        "read_conductor": ["contact.", "contact.wall_", "material."],
    },
    "case_granules.cpp": {"read_amount": ["granules.", "granules.batch."], "read_batches": ["granules.batch."]},
    "case_feed.cpp": {"read_box": ["granules.region.", "feed.", "output.box."], "read_feeds": ["feed."]},
    "case_gas.cpp": {
        "read_flow": ["gas.", "inlet."],
        "read_humidity": ["gas.", "inlet."],
        "read_forces": ["gas."],
        "read_cells": ["gas.fine."],
    },
    "case_openings.cpp": {
        "read_opening": ["inlet.", "outlet."],
        "read_profile": ["inlet."],
        "read_inlet": ["inlet."],
        "read_outlet": ["outlet."],
        "read_gas_walls": ["gas.wall."],
    },
    "case_output.cpp": {"read_boxes": ["output.box."], "read_probes": ["output.probe."], "read_own_name": ["output.box.", "output.probe."]},
    "case_phases.cpp": {"read_phases": ["phase."]},
    "case_sizes.cpp": {"read_table": ["granules.size."], "read_list": ["granules.size."], "read_sizes": ["granules.size."]},
    "case_solid.cpp": {"Reader": ["apparatus.solid."]},
    "case_solids.cpp": {"read_name": ["apparatus.solid.", "internal."], "read_solids": ["apparatus.solid."], "read_internals": ["internal."]},
    "case_walls.cpp": {"WallReader": ["wall."]},
}
CALLS = r'(?<!derived\()(?<!section = )\b(?:(?:key|prefix) \+ |(?:length|point|direction|moves|law)\()"((?:flow_reference\.)?[a-z_]+)"'


def keys_with_prefix(name, text):
    """Keys that the functions of PREFIXES ask for: a function goes from the line of its name to a closing brace at the margin."""
    for function, prefixes in PREFIXES.get(name, {}).items():
        for body in re.findall(rf"^\S.*\b{function}\b[^;]*?\n\{{\n(.*?)^\}}", text, re.MULTILINE | re.DOTALL):
            named = [key for names in re.findall(r"\bonly\(\{([^}]*)\}\)", body) for key in re.findall(r'"([a-z_]+)"', names)]
            for key in re.findall(CALLS, body) + named:
                yield from (prefix + key for prefix in prefixes)


def broken_links(root):
    for page in sorted([*root.glob("*.md"), *root.glob("doc/**/*.md"), *root.glob("examples/**/*.md")]):
        for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text()):
            path = target.split("#")[0]
            if path and not re.match(r"[a-z]+:", target) and not (page.parent / path).exists():
                yield f"{page.relative_to(root)}: link to {target} leads nowhere"


def keys_read(root):
    """Keys that the case reader names: "section.key" literals, and the keys of [[granule]] and [[nozzle]]."""
    keys = set()
    for file in root.glob("src/granum/sim/case_*.cpp"):
        text = file.read_text()
        keys |= {key for key in re.findall(rf'"((?:{SECTIONS})\.[a-z_.]+)"', text) if key[-1] not in "._"}
        keys |= set(keys_with_prefix(file.name, text))
        if file.name == "case_spray.cpp":
            keys |= {f"spray.{name}" for name in re.findall(r'\bproperty\("([a-z_]+)"', text)}
        table = re.findall(r'fmt::format\("(granule|nozzle)\[\{\}\]\."', text)
        if table:
            keys |= {f"{table[0]}.{name}" for name in re.findall(r'(?<!derived\()\bkey \+ "([a-z_]+)"', text)}
    return keys


def keys_documented(root):
    """Keys in the first column of the tables of doc/reference/case.md, under their section's heading."""
    section, keys = None, set()
    for line in (root / "doc/reference/case.md").read_text().splitlines():
        heading = re.match(r"##+ `\[*([a-z.]+?)(?:\.NAME)?\]*`", line)
        if line.startswith("##"):
            section = heading[1] if heading else None
            if section and "." in section:
                keys.add(section)
        row = re.match(r"\| (`[^|]+) \|", line)
        if section and row:
            keys |= {f"{section}.{key}" for key in re.findall(r"`([a-z_.]+)`", row[1])}
    return keys


def laws_without_a_page(root):
    theory = "\n".join(page.read_text() for page in root.glob("doc/theory/*.md"))
    for file in sorted([*root.glob("src/granum/law/**/*.hpp"), *root.glob("src/granum/product/*.hpp")]):
        for name in re.findall(r'Card card\s*\{\s*\.name = "([^"]+)"', file.read_text()):
            if f"`{name}`" not in theory and f"**{name}**" not in theory:
                yield f"{file.relative_to(root)}: law {name} is on no page of doc/theory"


def events_without_a_line(root):
    page = (root / "doc/reference/run-folder.md").read_text()
    header = root / "src/granum/drying/event.hpp"
    for name in re.findall(r'^\s*\{"([a-z_]+)", "[^"]*", "', header.read_text(), re.MULTILINE):
        if f"`{name}`" not in page:
            yield f"doc/reference/run-folder.md: event column {name} is not explained"


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    errors = [*broken_links(root), *laws_without_a_page(root), *events_without_a_line(root)]
    read, documented = keys_read(root), keys_documented(root)
    errors += [f"doc/reference/case.md: {key} is read from a case and not documented" for key in sorted(read - documented)]
    errors += [f"doc/reference/case.md: no case reader asks for {key}" for key in sorted(documented - read)]
    for error in errors:
        print(error, file=sys.stderr)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
