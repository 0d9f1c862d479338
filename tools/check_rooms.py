#!/usr/bin/env python3
"""Holds the include lines of every room against its granum_room() call.

Proves that the plan has no cycle, that a room includes only the rooms it names, and that an external library is met only
in the rooms where it may enter. Keeps the picture of the plan in ARCHITECTURE.md true: without arguments a stale picture
is an error, `--write` redraws it.
"""
import argparse
import pathlib
import re
import sys

# Where each external header may be included: names of rooms, or of the folders app, test and bench.
EXTERNAL = {
    r"toml(\+\+|\.hpp|plusplus)": {"io", "test"},
    r"udunits2\.h": {"io"},
    r"(hdf5|H5\w*)\.h": {"io", "test"},
    r"xxhash\.h": {"io"},
    r"zlib\.h": {"io", "report", "test"},
    r"png\.h": {"report", "test"},
    r"Eigen/": {"map", "test"},
    r"nlohmann/": {"io", "map", "report", "sim", "app", "test"},
    r"_?HYPRE|krylov\.h": {"solve"},
    r"hwy/": {"dem"},
    r"mpi\.h": {"par", "solve", "app", "test", "bench"},
    r"CLI/": {"app", "bench"},
    r"(fmt|spdlog)/": {"*"},
    r"(gtest|gmock|rapidcheck)[/.]": {"test"},
    r"benchmark/": {"bench"},
}
SYSTEM = r"[a-z_0-9]+|(unistd|signal|sched|fcntl|execinfo|sys/[a-z]+)(\.h)?"
BEGIN, END = "<!-- floor plan: begin -->", "<!-- floor plan: end -->"


def read_plan(root):
    """Rooms as {name: (needs)}, read from the granum_room() calls, and what is wrong with the calls."""
    plan, errors = {}, []
    for file in sorted((root / "src/granum").glob("*/CMakeLists.txt")):
        call = re.search(r"granum_room\(\s*(\w+)([^)]*)\)", file.read_text())
        if not call or call[1] != file.parent.name:
            errors.append(f"{file.relative_to(root)}: no granum_room({file.parent.name} ...) call")
            continue
        needs = re.search(r"\bNEEDS\b((?:\s+[a-z_]+)*)", call[2])
        plan[call[1]] = tuple(needs[1].split()) if needs else ()
    for room, needs in plan.items():
        errors += [f"room {room} needs {need}, which is no room" for need in needs if need not in plan]
    return plan, errors


def floors(plan):
    """Floor of every room: one above the highest it needs. Raises ValueError with the path of a cycle."""
    floor = {}

    def visit(room, path):
        if room in path:
            raise ValueError("the plan has a cycle: " + " -> ".join(path[path.index(room):] + [room]))
        if room not in floor:
            floor[room] = 1 + max((visit(need, path + [room]) for need in plan[room]), default=-1)
        return floor[room]

    for room in plan:
        visit(room, [])
    return floor


def includes(file):
    for number, line in enumerate(file.read_text().splitlines(), 1):
        match = re.match(r'\s*#\s*include\s+(["<])([^">]+)[">]', line)
        if match:
            yield number, match[1], match[2]


def check_file(root, file, place, plan):
    """Wrong include lines of one file that belongs to `place` (a room, or app, test, bench)."""
    allowed = {place, *plan[place]} if place in plan else set(plan)
    for number, quote, header in includes(file):
        where = f"{file.relative_to(root)}:{number}"
        if header.startswith("granum/"):
            other = header.split("/")[1]
            if other not in allowed:
                yield f"{where}: room {place} may not include room {other} (see granum_room in its CMakeLists.txt)"
        elif quote == '"' and place in plan:
            yield f'{where}: "{header}" is not written from the include root "granum/..."'
        elif quote == "<":
            places = next((places for pattern, places in EXTERNAL.items() if re.match(pattern, header)), None)
            if places is None and not re.fullmatch(SYSTEM, header):
                yield f"{where}: <{header}> belongs to no library that this project knows (tools/check_rooms.py)"
            elif places is not None and "*" not in places and place not in places:
                yield f"{where}: <{header}> may be included in {', '.join(sorted(places))} only"


def picture(plan, floor):
    """The plan as a Mermaid graph of its direct needs: an edge that a longer way implies is left out."""
    below = {}
    for room in sorted(plan, key=floor.get):
        below[room] = set(plan[room]).union(*(below[need] for need in plan[room]))
    lines = ["```mermaid", "graph TD"]
    for level in range(max(floor.values()) + 1):
        rooms = sorted(room for room in plan if floor[room] == level)
        lines.append(f"    subgraph floor{level}[floor {level}]")
        lines += [f"        {room}" for room in rooms] + ["    end"]
    for room in sorted(plan, key=lambda name: (floor[name], name)):
        for need in sorted(plan[room]):
            if not any(need in below[other] for other in plan[room]):
                lines.append(f"    {room} --> {need}")
    lines += ["```", "", "| floor | room | may include |", "|---:|---|---|"]
    for room in sorted(plan, key=lambda name: (floor[name], name)):
        lines.append(f"| {floor[room]} | `{room}` | {', '.join(plan[room]) or '(nothing)'} |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--write", action="store_true", help="redraw the picture in ARCHITECTURE.md")
    options = parser.parse_args()
    root = options.root

    plan, errors = read_plan(root)
    if not errors:
        try:
            floor = floors(plan)
        except ValueError as cycle:
            errors.append(str(cycle))
    if not errors:
        trees = [(room, root / "src/granum" / room) for room in plan]
        trees += [(name, root / name) for name in ("app", "test", "bench")]
        for place, folder in trees:
            for file in sorted([*folder.rglob("*.hpp"), *folder.rglob("*.cpp")]):
                errors += check_file(root, file, place, plan)

        page = root / "ARCHITECTURE.md"
        text = page.read_text()
        head, _, rest = text.partition(BEGIN)
        _, _, tail = rest.partition(END)
        drawn = f"{head}{BEGIN}\n{picture(plan, floor)}\n{END}{tail}"
        if options.write:
            page.write_text(drawn)
        elif drawn != text:
            errors.append("ARCHITECTURE.md: the floor plan is not that of the code; run tools/check_rooms.py --write")

    for error in errors:
        print(error, file=sys.stderr)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
