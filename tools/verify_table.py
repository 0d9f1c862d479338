#!/usr/bin/env python3
"""Makes the page of verification from the rows that the test programs wrote: verify_table.py FOLDER PAGE."""
import pathlib
import re
import sys

HEAD = """# Verification

Written by `./dev test verify`; do not edit. Each row holds a number of this program against one that did not
come from it: a closed form, an independent small program, a table of somebody else. Rows that name a motion or a flow
go through the step that `granum run` takes, from a case as a user would write it, unless they need a state that no case
can tell. P: the project's test matrix; E: closed forms of heat and mass in gas and bed; CFD, D, G, H, X: reference cases cfd-NN, dem-NN, g-NN,
h-NN, x-NN of `test/reference/`; N: what closed forms say of the numerics; S: an apparatus of solids; L: the ledgers of the examples.
Published: how far other codes are from the same number, as far as that is known.

| id | quantity | reference | ours | difference | tolerance | published | verdict |
|---|---|---:|---:|---:|---:|---|---|
"""


def rank(row):
    letters, number = re.match(r"([A-Z]+)(\d+)", row.split("\t")[0]).groups()
    return letters, int(number)


def main():
    folder, page = map(pathlib.Path, sys.argv[1:])
    rows = [line for file in sorted(folder.glob("*.tsv")) for line in file.read_text().splitlines()]
    if not rows:
        sys.exit(f"no rows in {folder}")
    rows.sort(key=rank)
    page.write_text(HEAD + "".join("| " + row.replace("\t", " | ") + " |\n" for row in rows))


main()
