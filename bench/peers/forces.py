"""Forces and torques of Granum held against those of LAMMPS on the same state: once with the laws set alike, where rounding
alone may differ, and once as the decks have them, where the laws differ.

The measure: the largest difference of any component on any granule, over the force of two of the granules at an overlap of
1e-3 R (a torque over that force times R).
"""
import math
import statistics

import states
from measure import Bar
from places import BUILD, HERE, run

YOUNG, POISSON, RADIUS, RESTITUTION = 1e7, 0.25, 1e-3, 0.8
E_STAR = YOUNG / (2 * (1 - POISSON ** 2))
G_STAR = YOUNG / (4 * (2 - POISSON) * (1 + POISSON))
UNIT = 4 / 3 * E_STAR * math.sqrt(RADIUS / 2) * (1e-3 * RADIUS) ** 1.5  # N
ROUNDING = 1e-11  # of UNIT: fifteen digits of a distance of 2 R are twelve of an overlap of 1e-3 R


def tsuji_polynomial(e):
    """Damping over sqrt(m* k_n) that LAMMPS takes for a restitution, k_n = 4/3 E* a: a fit of its authors."""
    return 1.2728 - 4.2783 * e + 11.087 * e ** 2 - 22.348 * e ** 3 + 27.467 * e ** 4 - 18.022 * e ** 5 + 4.8218 * e ** 6


def damping(e):
    """The same number as Granum has it: exact for a Hertz contact whose pull at the end is kept."""
    beta = -math.log(e) / math.hypot(math.pi, math.log(e))
    return 2 * math.sqrt(5 / 6) * beta * math.sqrt(1.5)


def restitution_for(number):
    """The restitution for which LAMMPS' fit gives `number` (the fit falls between 0.5 and 1)."""
    low, high = 0.5, 1.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if tsuji_polynomial(middle) > number else (low, middle)
    return 0.5 * (low + high)


def laws(alike=False, wall=False, friction=0.3, rolling=True):
    """LAMMPS' laws. `alike` sets both dashpots to those of Granum, and the modulus at walls, where this LAMMPS takes
    E / (2 (1 - nu)) for E*, so that the same E* results."""
    e, ratio = (restitution_for(damping(RESTITUTION)), math.sqrt(4 * G_STAR / E_STAR)) if alike else (RESTITUTION, 1.0)
    young = YOUNG / (1 + POISSON) if alike and wall else YOUNG
    roll = "rolling sds 400.0 0.0 0.1 " if rolling else ""
    return (f"hertz/material {young:.17g} {e:.17g} {POISSON:.17g} tangential mindlin NULL {ratio:.17g} {friction:.17g} "
            f"{roll}damping tsuji")


ALIKE = {"alike": True, "friction": 1e9, "rolling": False}  # nothing slips, nothing resists rolling
FREE = ("--friction", 1e9, "--no-rolling")
# what is compared, state, how LAMMPS' laws are set, Granum's options, steps, what must agree to rounding
ROWS = (
    ("at rest, laws set alike", "packed", {"alike": True}, (), 0, ("largest", "torque", "walls")),
    ("moving, laws set alike, no slip", "pressed", ALIKE, FREE, 0, ("largest", "torque")),
    ("the same with spins, Granum's lever at the radius", "spinning", ALIKE, (*FREE, "--lever-radius"), 0, ("largest",)),
    ("the same, levers as in the decks", "spinning", ALIKE, FREE, 0, ()),
    ("all as in the decks", "packed", {}, (), 0, ()),
    ("all as in the decks", "packed", {}, (), 10, ()),
    ("all as in the decks", "agitated", {}, (), 0, ()),
    ("all as in the decks", "agitated", {}, (), 10, ()),
)


def made(case, folder):
    """(CSV, data file, box) of a state; `pressed` is the packed bed with a velocity field that closes every pair and shears
    it, so that no contact pulls, and `spinning` the same with a spin that differs from granule to granule."""
    if case in ("packed", "agitated"):
        return states.state(case, states.BASE, folder)
    box, rows = states.read(states.base("packed", folder))
    middle, turn, press = (box[0] / 2, box[1] / 2, 0.0), (3.0, -4.0, 5.0), 5.0  # m, rad/s, 1/s
    for row in rows:
        x, y, z = (row[1 + d] - middle[d] for d in range(3))
        row[5:8] = (turn[1] * z - turn[2] * y - press * x, turn[2] * x - turn[0] * z - press * y,
                    turn[0] * y - turn[1] * x - press * z)
        if case == "spinning":
            row[8:11] = (10 * math.sin(row[0]), 10 * math.sin(2 * row[0]), 10 * math.sin(3 * row[0]))
    csv, data = folder / f"{case}.csv", folder / f"{case}.data"
    states.write(csv, box, rows)
    states.write_data(data, *states.read(csv))  # with the digits of the CSV
    return csv, data, box


def table(path, separator, skip):
    with open(path) as file:
        return [[float(word) for word in line.split(separator)] for line in file.readlines()[skip:]]


def at_wall(row, box):
    """Whether the granule of a state touches the floor or a side."""
    x, y, z, radius = row[1:5]
    return min(x, y, z, box[0] - x, box[1] - y) < radius


def compare(row, folder):
    """Differences of one row: the largest and the median force and the largest torque among granules that touch no wall,
    the largest force on those that do."""
    what, case, setting, options, steps, exact = row
    csv, data, box = made(case, folder)
    _, rows = states.read(csv)
    theirs, ours = folder / "forces_lammps.dump", folder / "forces_granum.csv"
    run(["lmp", "-log", "none", "-in", HERE / "decks/forces.lammps", "-var", "data", data, "-var", "lx", box[0], "-var", "ly",
         box[1], "-var", "laws", laws(**setting), "-var", "walls", laws(**setting, wall=True), "-var", "steps", steps,
         "-var", "out", theirs], folder)
    run([BUILD / "peer_granum", "forces", csv, "--out", ours, "--steps", steps, *options], folder)
    inside, walls, torques = [], [], []
    for one, a, b in zip(rows, table(theirs, None, 9), table(ours, ",", 1), strict=True):
        force = max(abs(a[k] - b[k]) for k in (1, 2, 3)) / UNIT
        if at_wall(one, box):
            walls.append(force)
        else:
            inside.append(force)
            torques.append(max(abs(a[k] - b[k]) for k in (4, 5, 6)) / (UNIT * RADIUS))
    # With the lever at the radius the torque differs by the overlap, which is what the row is not about.
    return {"what": what, "state": case, "steps": steps, "exact": exact, "largest": max(inside),
            "median": statistics.median(inside), "walls": max(walls),
            "torque": None if "--lever-radius" in options else max(torques)}


def bars(rows):
    """Of the rows that should agree to rounding."""
    for row in rows:
        if row["exact"]:
            worst = max(row[field] for field in row["exact"])
            yield Bar(f"forces as LAMMPS has them: {row['state']}, {row['what']}", worst, ROUNDING, at_least=False,
                      text=f"{worst:.1e}")
