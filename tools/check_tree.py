#!/usr/bin/env python3
"""Looks at every file under version control or about to be: no file that a hand wrote outgrows 600 lines, and none names a folder
that exists on one machine only."""
import pathlib
import re
import subprocess
import sys

LONGEST = 600
WRITTEN_BY_HAND = {".cpp", ".hpp", ".py", ".txt", ".cmake", ".md", ".toml", ".sh", ""}
WRITTEN_BY_PROGRAMS = {"doc/validation/verify.md"}  # by tools/verify_table.py, a line for each row
MACHINE_PATH = re.compile(r"(?<![\w.~}\])])/(?:home|root|work|Users)/\w")


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"],
                            cwd=root, capture_output=True, text=True, check=True)
    errors = []
    for name in listed.stdout.splitlines():
        file = root / name
        if not file.is_file() or file.suffix not in WRITTEN_BY_HAND or name == "LICENSE" or name.startswith("test/reference/"):
            continue
        lines = file.read_text(errors="replace").splitlines()
        if len(lines) > LONGEST and name not in WRITTEN_BY_PROGRAMS:
            errors.append(f"{name}: {len(lines)} lines; a file over {LONGEST} holds more than one idea")
        errors += [f"{name}:{number}: path of one machine" for number, line in enumerate(lines, 1) if MACHINE_PATH.search(line)]
    for error in errors:
        print(error, file=sys.stderr)
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
