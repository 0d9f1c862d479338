#!/usr/bin/env python3
"""What a granule costs Granum: memory, time from 100,000 to 10,000,000 granules, two ranks, and sizes of ratio 10.

Started by `./dev bench cost`. Prints the table, ends with 1 where a bar is missed, 2 where a run failed. Results are kept in
build/peers, so an interrupted measurement goes on where it was.
"""
import argparse
import sys

import machine
import page
import programs
import states
from measure import Bar, Kept, Spread, judged
from peers import BYTES, OF_ROOFLINE
from places import BUILD, WORK, Failed, run

GIB = 2 ** 30
ROUNDS, ROUNDS_OF_A_MILLION = 9, 3  # short runs scatter more and are repeated more
SIZES = 20_000
# name: state, tiles, ranks, steps before, timed steps
RUNS = {"100,000": ("packed", (1, 5), 1, 50, 200), "100,000 on two": ("packed", (1, 5), 2, 50, 200),
        "1,000,000": ("packed", (5, 10), 1, 10, 30), "one size": ("packed", (1, 1), 1, 200, 600),
        "five sizes": ("sizes", (1, 1), 1, 200, 600), "100,000, energy ledger": ("packed", (1, 5), 1, 50, 200)}
COUNT = {"100,000": 100_000, "100,000, energy ledger": 100_000, "100,000 on two": 100_000, "1,000,000": 1_000_000,
         "one size": 20_000}
TEN_MILLION = ("packed", states.TILES[10_000_000], 1, 0, 100)


def state(case, folder):
    """Path of a state; that of five sizes is settled by Granum."""
    if case != "sizes":
        return states.base(case, folder)
    path = folder / "sizes.csv"
    if not path.exists():
        unfinished = path.with_suffix(".part")
        run([BUILD / "peer_granum", "sizes", "--out", unfinished, "--granules", SIZES], folder)
        unfinished.rename(path)
    return path


def timed(name, spec, folder):
    """Seconds of the timed steps and what came out, with seconds a granule-step and a contact-step."""
    case, tiles, ranks, warm, steps = spec
    path = state(case, folder)
    count = COUNT.get(name) or 10_000_000 if case == "packed" else len(states.read(path)[1])
    result = programs.granum(path, tiles, warm, steps, folder, ranks, ["--ledger"] if "ledger" in name else [])
    each = result["loop"] / (steps * count)
    return {**result, "count": count, "each": each, "contact": each / (0.5 * result["coordination"])}


def measure(kept, say):
    folder = WORK / "states"
    folder.mkdir(parents=True, exist_ok=True)
    for round_ in range(1, ROUNDS + 1):
        kept.get(("triad", round_), lambda: programs.bandwidth(folder))
        for name in list(RUNS) if round_ % 2 else list(RUNS)[::-1]:
            if name == "1,000,000" and round_ > ROUNDS_OF_A_MILLION:
                continue
            result = kept.get((name, round_), lambda n=name: timed(n, RUNS[n], folder))
            say(f"round {round_} {name}: {1e9 * result['each']:.0f} ns a granule-step, {100 * result['busy']:.0f} % of its cores")


class Cost:
    """What was measured, by name."""

    def __init__(self, kept):
        self.kept = kept
        self.triad = Spread([value for key, value in kept.rows.items() if key[0] == "triad"])

    def all(self, name):
        return [value for key, value in sorted(self.kept.rows.items()) if key[0] == name]

    def spread(self, name, field, factor=1.0):
        return Spread([factor * run[field] for run in self.all(name)])

    def ratio(self, over, under, field):
        """Round by round, of those that both have."""
        return Spread([a[field] / b[field] for a, b in zip(self.all(over), self.all(under))])

    def slope(self):
        """Memory of one granule more, bytes."""
        few, many = self.spread("100,000", "memory").median, self.spread("1,000,000", "memory").median
        return (many - few) / 900_000

    def bars(self):
        touching = self.all("1,000,000")[0]["coordination"]
        yield Bar("contacts a granule, 1,000,000 packed", touching, 5.0)
        yield Bar("memory of one granule more, 100,000 to 1,000,000, bytes", self.slope(), 900, at_least=False)
        longer = self.ratio("1,000,000", "100,000", "each")
        part = self.spread("1,000,000", "speed_part")
        if longer.median <= 1.15:
            yield Bar("time of a granule-step, 1,000,000 over 100,000", longer.median, 1.15, False, longer.text())
        else:
            yield Bar(f"time of a granule-step, 1,000,000 over 100,000, is {longer.text()}: above 1.15 a third of the memory "
                      "roofline is asked for", part.median, OF_ROOFLINE, text=part.text())
        two = self.ratio("100,000", "100,000 on two", "each")
        yield Bar("two ranks over one, 100,000 packed", two.median, 1.8, text=two.text())
        mixed = self.ratio("five sizes", "one size", "contact")
        yield Bar("time of a contact, five sizes of ratio 10 over one size", mixed.median, 1.6, False, mixed.text())
        large = self.kept.rows.get(("10,000,000", 1))
        if large:
            yield Bar("contacts a granule, 10,000,000 packed", large["coordination"], 5.0)
            yield Bar("memory of 10,000,000 packed, 100 steps, GiB", large["memory"] / GIB, 14, at_least=False)
        else:
            yield Bar("memory of 10,000,000 packed, GiB: not run, as this much would be needed", self.slope() * 1e7 / GIB, 14,
                      at_least=False)

    def table(self):
        out = ["| run | granules | ranks | ns a granule-step | ns a contact-step | contacts a granule | lists made "
               "| bytes a granule | of its cores |", "|---|---:|---:|---|---|---:|---:|---:|---:|"]
        for name, spec in {**RUNS, "10,000,000": TEN_MILLION}.items():
            runs = self.all(name)
            if not runs:
                continue
            one = runs[0]
            out.append(f"| {name} | {one['count']:,} | {spec[2]} | {self.spread(name, 'each', 1e9).text()} "
                       f"| {self.spread(name, 'contact', 1e9).text()} | {one['coordination']:.2f} | {one['builds']} in {spec[4]} "
                       f"| {max(run['memory'] for run in runs) / one['count']:,.0f} "
                       f"| {100 * min(run['busy'] for run in runs):.0f} % |")
        every = self.triad.median * self.spread("1,000,000", "each", 1e9).median
        ledger = self.ratio("100,000, energy ledger", "100,000", "each")
        out += ["", f"With the energy ledger a step takes {ledger.text()} times as long as without.",
                f"In the time of a granule-step at 1,000,000 one core's memory could have moved {every:,.0f} bytes; the "
                f"roofline counts {BYTES}."]
        return out


def main():
    parser = argparse.ArgumentParser(prog="./dev bench cost", description=__doc__.split("\n\n")[0])
    parser.add_argument("--write", action="store_true", help="put the tables into doc/validation/peers.md")
    options = parser.parse_args()
    kept = Kept("cost")
    cost = None
    try:
        measure(kept, lambda text: print(text, file=sys.stderr, flush=True))
        cost = Cost(kept)
        for run_ in cost.all("1,000,000"):
            run_["speed_part"] = BYTES * 1e-9 / run_["each"] / cost.triad.median
        if cost.slope() * 1e7 <= 14 * GIB:
            kept.get(("10,000,000", 1), lambda: timed("10,000,000", TEN_MILLION, WORK / "states"))
    except Failed as failure:
        print(f"cost: {failure}", file=sys.stderr)
        return 2
    lines, missed = judged([*cost.bars()])
    sections = {"table": cost.table(), "bars": lines, "machine": machine.lines(cost.triad)}
    page.show("cost", sections, options.write)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
