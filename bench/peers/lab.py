#!/usr/bin/env python3
"""What a lab run and a pilot run take, beside what `granum check` foretells, and what of it goes to spray, drying, events and the
layers laid cap by cap; and how long `granum check` itself takes.

Started by `./dev bench lab`; wants an idle machine. Ends with 1 where a bar is missed, 2 where a program failed. The pilot is
measured over its first part: the rest takes as long, second for second. Each run stands between two forecasts, because the
forecast times the machine and the machine is not the same from minute to minute.
"""
import argparse
import json
import re
import shutil
import sys

import page
import places
from measure import Bar, Spread, judged
from places import BUILD, ROOT, Failed, run

FOLDER = places.WORK / "lab"
GRANUM = BUILD.parent / "app/granum"
SPRAY, FORECAST, CHECK = 0.20, 0.20, 0.5
RUNS = {"lab": ("01-lab-layering", 3.5), "pilot": ("11-pilot-x8", 0.6)}


def case(name):
    return ROOT / "examples" / RUNS[name][0] / "case.toml"


def foretold(name):
    """Wall time, s, for a second of the case on all cores, and how many cores."""
    text = run([GRANUM, "check", case(name)], FOLDER).text
    found = re.search(r"wall time +about ([0-9.]+) (s|min|h|days) for ([0-9.]+) s on (\d+) core", text)
    if not found:
        raise Failed(f"granum check does not foretell a wall time:\n{text}")
    value, unit, length, cores = found.groups()
    return float(value) * {"s": 1, "min": 60, "h": 3600, "days": 86400}[unit] / float(length), int(cores)


def measured(name):
    """Of one run: what was foretold before and after it and what it took, s of wall time a second; the share of its time that
    is asked about; the share of its cores that it got; how many these are."""
    folder = FOLDER / name
    before, cores = foretold(name)
    shutil.rmtree(folder, ignore_errors=True)
    command = [GRANUM, "run", case(name), "-o", folder, "-n", cores, "--until", f"{RUNS[name][1]} s", "--quiet"]
    busy = run(command, FOLDER, cores=cores).busy
    after, _ = foretold(name)
    summary = json.loads((folder / "summary.json").read_text())
    share = summary["performance"]["share"]
    return {"foretold": (before, after), "took": summary["run"]["wall_s"] / summary["run"]["simulated_s"],
            "spray": share["spray_and_drying"] + share["output"], "busy": busy, "cores": cores}


def rows_and_bars(results):
    lines = ["| run | cores | foretold before and after, s of wall time a second | taken | off by | of its cores "
             "| spray, drying, events and all output |", "|---|---:|---:|---:|---:|---:|---:|"]
    bars = []
    for name, (example, until) in RUNS.items():
        off = []
        for one in results[name]:
            before, after = one["foretold"]
            off.append(one["took"] / ((before + after) / 2) - 1)
            lines.append(f"| examples/{example}, {until} s | {one['cores']} | {before:.3g}, {after:.3g} | {one['took']:.3g} "
                         f"| {100 * off[-1]:+.0f} % | {100 * one['busy']:.0f} % | {100 * one['spray']:.1f} % |")
        off = Spread([abs(x) for x in off])
        bars.append(Bar(f"{name}: what it takes is off the forecast by", off.median, FORECAST, at_least=False, text=off.text()))
        if name == "lab":
            spray = Spread([one["spray"] for one in results[name]])
            bars.append(Bar("lab: share of spray, drying, events and output", spray.median, SPRAY, at_least=False, text=spray.text()))
    check = Spread([run([GRANUM, "check", case("lab")], FOLDER).wall for _ in range(7)])
    bars.append(Bar("`granum check` of the lab's case, s", check.median, CHECK, at_least=False, text=check.text()))
    return lines, bars


def main():
    parser = argparse.ArgumentParser(prog="./dev bench lab", description=__doc__.split("\n\n")[0])
    parser.add_argument("--rounds", type=int, default=3, help="runs of each case, in turn (default 3)")
    parser.add_argument("--write", action="store_true", help="put the tables into doc/validation/peers.md")
    options = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    results = {name: [] for name in RUNS}
    try:
        for _ in range(options.rounds):
            for name in RUNS:
                results[name].append(measured(name))
                print(f"lab: {name} {results[name][-1]}", file=sys.stderr, flush=True)
        lines, bars = rows_and_bars(results)
    except Failed as failure:
        print(f"lab: {failure}", file=sys.stderr)
        return 2
    table, missed = judged(bars)
    page.show("gas", {"lab": lines, "lab bars": table}, options.write)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
