#!/usr/bin/env python3
"""What a lab run and a pilot run take, beside what `granum check` foretold, and what of it goes to spray, drying, events and the
layers laid cap by cap.

Started by `./dev bench lab`; wants an idle machine. Ends with 1 where a bar is missed, 2 where a program failed. The pilot is
measured over its first part: the rest takes as long, second for second.
"""
import argparse
import json
import re
import shutil
import sys

import page
import places
from measure import Bar, judged
from places import BUILD, ROOT, Failed, run

FOLDER = places.WORK / "lab"
GRANUM = BUILD.parent / "app/granum"
SPRAY, FORECAST = 0.20, 0.20
RUNS = {"lab": ("01-lab-layering", 3.5), "pilot": ("11-pilot-x8", 0.6)}


def foretold(case):
    """Seconds of wall time for a second of the case on all cores."""
    text = run([GRANUM, "check", case], FOLDER).text
    found = re.search(r"wall time +about ([0-9.]+) (s|min|h|days) for ([0-9.]+) s on (\d+) core", text)
    if not found:
        raise Failed(f"granum check does not foretell a wall time:\n{text}")
    value, unit, length, cores = found.groups()
    return float(value) * {"s": 1, "min": 60, "h": 3600, "days": 86400}[unit] / float(length), int(cores)


def measured(name):
    example, until = RUNS[name]
    case, folder = ROOT / "examples" / example / "case.toml", FOLDER / name
    expected, cores = foretold(case)
    shutil.rmtree(folder, ignore_errors=True)
    run([GRANUM, "run", case, "-o", folder, "-n", cores, "--until", f"{until} s", "--quiet"], FOLDER, cores=cores)
    summary = json.loads((folder / "summary.json").read_text())
    took = summary["run"]["wall_s"] / summary["run"]["simulated_s"]
    share = summary["performance"]["share"]
    return expected, took, share["spray_and_drying"] + share["output"], cores


def main():
    parser = argparse.ArgumentParser(prog="./dev bench lab", description=__doc__.split("\n\n")[0])
    parser.add_argument("--write", action="store_true", help="put the tables into doc/validation/peers.md")
    options = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    lines = ["| run | cores | foretold, s of wall time a second | taken | spray, drying, events and all output |", "|---|---:|---:|---:|---:|"]
    bars = []
    try:
        for name, (example, until) in RUNS.items():
            expected, took, share, cores = measured(name)
            lines.append(f"| examples/{example}, {until} s | {cores} | {expected:.3g} | {took:.3g} | {100 * share:.1f} % |")
            bars.append(Bar(f"{name}: what it takes is off the forecast by", abs(took / expected - 1), FORECAST, at_least=False))
            if name == "lab":
                bars.append(Bar("lab: share of spray, drying, events and output", share, SPRAY, at_least=False))
    except Failed as failure:
        print(f"lab: {failure}", file=sys.stderr)
        return 2
    table, missed = judged(bars)
    page.show("gas", {"lab": lines, "lab bars": table}, options.write)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
