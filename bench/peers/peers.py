#!/usr/bin/env python3
"""Granum beside Debian's LAMMPS, LIGGGHTS and YADE: the same states, physics, time step and number of steps, interleaved.

Started by `./dev bench peers`. Prints the tables, ends with 1 where a bar is missed, 2 where a program failed. Results are
kept in build/peers, so an interrupted comparison goes on where it was.
"""
import argparse
import sys

import forces
import machine
import page
import programs
from measure import Bar, Kept, Spread, judged
from places import WORK, Failed

BYTES = 690  # of memory that a granule-step asks for where nothing stays in the cache: see README.md
AGAINST_FASTEST = {"packed": 4.0, "agitated": 3.0}
AGAINST_YADE = 20.0
OF_ROOFLINE = 1 / 3


def matrix(quick):
    """(case, size, cores), longest last."""
    sizes = (20_000,) if quick else (20_000, 100_000, 1_000_000)
    return [(case, size, cores) for size in sizes for case in ("packed", "agitated") if (case, size) in programs.STEPS
            for cores in (1, 2)]


def rounds_of(program, size, rounds):
    """Short runs scatter more and are repeated more. YADE takes ten times as long as the others and is judged by a bar five
    times as high: three rounds do, and none at 1,000,000."""
    if program == "yade":
        return 0 if size >= 1_000_000 else min(rounds, 3)
    return rounds if size <= 20_000 else min(rounds, 3)


def measure(kept, cells, rounds, say):
    """Runs what is missing: round by round every program once, Granum first in odd rounds and last in even ones."""
    folder = WORK / "states"
    folder.mkdir(parents=True, exist_ok=True)
    for round_ in range(1, rounds + 1):
        kept.get(("triad", round_), lambda: programs.bandwidth(folder))
        for case, size, cores in cells:
            order = programs.PROGRAMS if round_ % 2 else programs.PROGRAMS[::-1]
            for program in order:
                if round_ > rounds_of(program, size, rounds):
                    continue
                result = kept.get((program, case, size, cores, round_),
                                  lambda p=program: programs.timed(p, case, size, cores, folder))
                say(f"round {round_} {case} {size} on {cores}: {program} {result['speed']:.2f} million granule-steps/s, "
                    f"{100 * result['busy']:.0f} % of its cores")


class Table:
    """What was measured, by cell."""

    def __init__(self, kept, cells):
        self.rows, self.cells = kept.rows, cells
        self.triad = Spread([value for key, value in kept.rows.items() if key[0] == "triad"])

    def runs(self, program, cell):
        """{round: result} of a program."""
        return {key[4]: value for key, value in self.rows.items() if key[0] == program and key[1:4] == cell}

    def ratio(self, cell, others):
        """Granum's speed over that of the fastest of `others`, round by round; None where they did not run."""
        ours, theirs = self.runs("granum", cell), [self.runs(other, cell) for other in others]
        ratios = [ours[k]["speed"] / max(runs[k]["speed"] for runs in theirs)
                  for k in ours if all(k in runs for runs in theirs)]
        return Spread(ratios) if ratios else None

    def roofline(self):
        """Million granule-steps per second that memory allows one core."""
        return 1e3 * self.triad.median / BYTES

    def bars(self):
        for cell in self.cells:
            case, size, cores = cell
            where = f"{case}, {size:,}, {cores} core{'s' if cores > 1 else ''}"
            fastest = self.ratio(cell, ("lammps", "liggghts"))
            yield Bar(f"{where}: over the faster of LAMMPS and LIGGGHTS", fastest.median, AGAINST_FASTEST[case],
                      text=fastest.text())
            yade = self.ratio(cell, ("yade",))
            if yade:
                yield Bar(f"{where}: over YADE", yade.median, AGAINST_YADE, text=yade.text())
            if case == "packed" and cores == 1:
                part = Spread([run["speed"] / self.roofline() for run in self.runs("granum", cell).values()])
                yield Bar(f"{where}: of the memory roofline, {self.roofline():.1f} million granule-steps/s", part.median,
                          OF_ROOFLINE, text=part.text())


def arguments():
    parser = argparse.ArgumentParser(prog="./dev bench peers", description=__doc__.split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="20,000 granules only")
    parser.add_argument("--rounds", type=int, default=5, help="repetitions at 20,000 (5); larger states take three at most")
    parser.add_argument("--write", action="store_true", help="put the tables into doc/validation/peers.md")
    options = parser.parse_args()
    if options.rounds < 1:
        parser.error("--rounds: at least 1")
    if options.write and options.quick:
        parser.error("--write needs the whole comparison, not --quick")
    return options


def main():
    options = arguments()
    kept, cells = Kept("peers"), matrix(options.quick)
    try:
        measure(kept, cells, options.rounds, lambda text: print(text, file=sys.stderr, flush=True))
        compared = [kept.get(("forces", k), lambda row=row: forces.compare(row, WORK / "states"))
                    for k, row in enumerate(forces.ROWS)]
    except Failed as failure:
        print(f"peers: {failure}", file=sys.stderr)
        return 2
    table = Table(kept, cells)
    lines, missed = judged([*table.bars(), *forces.bars(compared)])
    sections = {"speed": page.speed(table), "forces": page.force_table(compared), "bars": lines,
                "machine": machine.lines(table.triad)}
    page.show("peers", sections, options.write)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
