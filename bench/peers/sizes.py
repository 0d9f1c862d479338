#!/usr/bin/env python3
"""Time of a gas step with all its granule steps against the size of the bed: 0.1, 0.4 and 1.6 million granules with cells in
proportion on one core, and 0.4 million on two.

Started by `./dev bench sizes`. Ends with 1 where a bar is missed, 2 where a program failed. Each round runs every size once,
from the same state 0.01 s after the gas came on.
"""
import argparse
import json
import shutil
import sys

import page
import places
from measure import Bar, Spread, judged
from places import BUILD, HERE, Failed, run

FOLDER = places.WORK / "sizes"
GRANUM = BUILD.parent / "app/granum"
WARM, STEPS, GAS_STEP = 0.01, 20, 4e-4  # s, timed gas steps, s
# Granules, cells across and along; 40 cells high. Three granules to a cell edge.
SIZES = {100_000: (17, 17), 400_000: (34, 34), 1_600_000: (68, 68)}
RUNS = [(100_000, 1), (400_000, 1), (400_000, 2), (1_600_000, 1)]
LINEAR, RANKS = 1.15, 1.7


def case(granules):
    across, along = SIZES[granules]
    text = (HERE / "decks/sizes.toml").read_text()
    for name, value in {"granules": granules, "width": 6 * across, "depth": 6 * along, "across": across, "along": along}.items():
        text = text.replace("{" + name + "}", str(value))
    path = FOLDER / f"bed-{granules}.toml"
    path.write_text(text)
    return path


def summary(granules, ranks, folder, until):
    run([GRANUM, "run", case(granules), "-o", folder, "-n", ranks, "--until", f"{until:.8g} s", "--quiet"], FOLDER, cores=ranks)
    return json.loads((folder / "summary.json").read_text())


def timed(granules, ranks):
    """Microseconds per granule and gas step, and the summary."""
    warm = FOLDER / f"warm-{granules}-{ranks}"
    if not (warm / "summary.json").exists():
        shutil.rmtree(warm, ignore_errors=True)
        summary(granules, ranks, warm, WARM)
    folder = FOLDER / "timed"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(warm, folder)
    # A first leg reads the state and sets all up; what the second takes less the start is the steps.
    before = summary(granules, ranks, folder, WARM + 5 * GAS_STEP)
    after = summary(granules, ranks, folder, WARM + (5 + STEPS) * GAS_STEP)
    steps = after["run"]["steps"] - before["run"]["steps"]
    spent = sum(after["performance"]["seconds"][part] for part in ("contacts", "neighbours", "gas", "exchange"))
    return 1e6 * spent / ranks / steps / granules, after


def main():
    parser = argparse.ArgumentParser(prog="./dev bench sizes", description=__doc__.split("\n\n")[0])
    parser.add_argument("--rounds", type=int, default=3, help="repetitions (3)")
    parser.add_argument("--write", action="store_true", help="put the tables into doc/validation/peers.md")
    options = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    times, told = {key: [] for key in RUNS}, {}
    try:
        for round_ in range(options.rounds):
            for key in RUNS if round_ % 2 == 0 else RUNS[::-1]:
                value, told[key] = timed(*key)
                times[key].append(value)
                print(f"round {round_ + 1}: {key[0]:,} on {key[1]}: {value:.2f} us per granule and gas step", file=sys.stderr,
                      flush=True)
    except Failed as failure:
        print(f"sizes: {failure}", file=sys.stderr)
        return 2
    lines = ["| granules | cells | cores | us per granule and gas step | contacts | neighbours | gas | exchange | us of gas per cell and step "
             "| of the triad's bandwidth |", "|---:|---:|---:|---|---:|---:|---:|---:|---:|---:|"]
    for (granules, ranks), values in times.items():
        performance = told[granules, ranks]["performance"]
        share, gas = performance["share"], performance["gas"]
        lines.append(f"| {granules:,} | {40 * SIZES[granules][0] * SIZES[granules][1]:,} | {ranks} | {Spread(values).text()} | " +
                     " | ".join(f"{100 * share[part]:.0f} %" for part in ("contacts", "neighbours", "gas", "exchange")) +
                     f" | {gas['us_per_cell_step']:.2f} | {100 * gas.get('share_of_bandwidth', float('nan')):.0f} % |")
    bars = []
    for granules in (400_000, 1_600_000):
        ratio = Spread([large / small for large, small in zip(times[granules, 1], times[100_000, 1])])
        bars.append(Bar(f"{granules:,} over 100,000, time per granule and step", ratio.median, LINEAR, at_least=False,
                        text=ratio.text()))
    ratio = Spread([one / two for one, two in zip(times[400_000, 1], times[400_000, 2])])
    bars.append(Bar("400,000: one core over two, time", ratio.median, RANKS, text=ratio.text()))
    judgement, missed = judged(bars)
    sections = {"sizes": lines, "size bars": judgement}
    page.show("gas", sections, options.write)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
