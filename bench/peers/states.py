"""The states of the comparison: made once, kept in the work folder, in the form that each program reads.

packed    a settled bed of 20,000 spheres of 2 mm (states/base_packed.csv.gz), repeated with mirrored tiles
agitated  a cloud in the middle of its collapse: a loose lattice with random velocities, 6,000 steps of LAMMPS, repeated alike

A state is a CSV `id,x,y,z,radius,vx,vy,vz,wx,wy,wz` with the box in its first line.
"""
import gzip
import math
import random
import shutil

from places import HERE, run

BASE = 20_000
BOX = (0.072, 0.036)  # m, of a base state
DENSITY = 1500
TILES = {20_000: (1, 1), 100_000: (1, 5), 1_000_000: (5, 10), 10_000_000: (20, 25)}
COLUMNS = "id,x,y,z,radius,vx,vy,vz,wx,wy,wz"


def head(lx, ly):
    return f"# lx={lx:.9g} ly={ly:.9g} rho={DENSITY}\n{COLUMNS}\n"


class Draws:
    """Uniform and normal numbers of the Mersenne twister as NumPy's RandomState draws them, so that the cloud is the same."""

    def __init__(self, seed):
        words = [seed]
        for k in range(1, 624):
            words.append((1812433253 * (words[-1] ^ (words[-1] >> 30)) + k) & 0xFFFFFFFF)
        self.engine = random.Random()
        self.engine.setstate((3, (*words, 624), None))
        self.spare = None

    def uniform(self):
        return self.engine.random()

    def normal(self):
        if self.spare is not None:
            value, self.spare = self.spare, None
            return value
        while True:
            a, b = 2 * self.uniform() - 1, 2 * self.uniform() - 1
            square = a * a + b * b
            if 0 < square < 1:
                break
        scale = math.sqrt(-2 * math.log(square) / square)
        self.spare = scale * a
        return scale * b


def cloud(count=BASE, diameter=2e-3, spacing=2.25e-3, speed=0.5, seed=12345):
    """Rows of a loose cloud: a cubic lattice, every sphere moved at random within its cell, normal velocities (m/s)."""
    draws = Draws(seed)
    nx, ny = (round(length / spacing - 1e-9) for length in BOX)
    cell = (BOX[0] / nx, BOX[1] / ny, spacing)
    free = 0.98 * 0.5 * (min(cell) - diameter)
    places = []
    for k in range(count):
        at = (k % nx, k // nx % ny, k // (nx * ny))
        places.append([(at[d] + 0.5) * cell[d] + (2 * draws.uniform() - 1) * free for d in range(3)])
    return [[k + 1, *place, diameter / 2, *(speed * draws.normal() for _ in range(3)), 0, 0, 0]
            for k, place in enumerate(places)]


def tiled(rows, box, tiles):
    """The state repeated along x and y; every other tile a mirror image, so that what touched a wall touches its image."""
    out = []
    for j in range(tiles[1]):
        for i in range(tiles[0]):
            for _, x, y, z, radius, vx, vy, vz, wx, wy, wz in rows:
                if i % 2:
                    x, vx, wy, wz = box[0] - x, -vx, -wy, -wz
                if j % 2:
                    y, vy, wx, wz = box[1] - y, -vy, -wx, -wz
                out.append([len(out) + 1, x + i * box[0], y + j * box[1], z, radius, vx, vy, vz, wx, wy, wz])
    return out


def read(path):
    """(box, rows) of a state."""
    with open(path) as file:
        words = dict(word.split("=") for word in file.readline()[1:].split())
        file.readline()
        rows = [[float(word) for word in line.split(",")] for line in file]
    return (float(words["lx"]), float(words["ly"])), rows


def write(path, box, rows):
    with open(path, "w") as file:
        file.write(head(*box))
        for row in rows:
            file.write("%d,%.9f,%.9f,%.9f,%.9f,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g\n" % tuple(row))


def write_data(path, box, rows, top=0.2):
    """The data file that LAMMPS and LIGGGHTS read; its box is a little larger than the walls."""
    with open(path, "w") as file:
        file.write(f"a state of the comparison\n\n{len(rows)} atoms\n1 atom types\n\n")
        file.write(f"-1e-4 {box[0] + 1e-4:.9g} xlo xhi\n-1e-4 {box[1] + 1e-4:.9g} ylo yhi\n-1e-4 {top} zlo zhi\n\nAtoms\n\n")
        for row in rows:
            file.write("%d 1 %.9f %g %.9f %.9f %.9f\n" % (row[0], 2 * row[4], DENSITY, *row[1:4]))
        file.write("\nVelocities\n\n")
        for row in rows:
            file.write("%d %.9g %.9g %.9g %.9g %.9g %.9g\n" % (row[0], *row[5:11]))


def base(case, folder):
    """Path of the state of 20,000 spheres."""
    path = folder / f"{case}_{BASE}.csv"
    if path.exists():
        return path
    unfinished = path.with_suffix(".part")
    if case == "packed":
        with gzip.open(HERE / "states/base_packed.csv.gz") as source, open(unfinished, "wb") as target:
            shutil.copyfileobj(source, target)
    else:
        data, dump = folder / "cloud.data", folder / "agitated.dump"
        write_data(data, BOX, cloud())
        run(["lmp", "-log", "none", "-in", HERE / "decks/collapse.lammps", "-var", "data", data, "-var", "lx", BOX[0],
             "-var", "ly", BOX[1], "-var", "out", dump, "-var", "steps", 6000], folder, ranks=2)
        with open(dump) as file:
            rows = [[float(word) for word in line.split()] for line in file.readlines()[9:]]
        write(unfinished, BOX, rows)
    unfinished.rename(path)
    return path


def state(case, size, folder):
    """(CSV, data file, box) of a state of `size` spheres."""
    tiles = TILES[size]
    box = (BOX[0] * tiles[0], BOX[1] * tiles[1])
    csv, data = folder / f"{case}_{size}.csv", folder / f"{case}_{size}.data"
    if not (csv.exists() and data.exists()):
        own_box, rows = read(base(case, folder))
        rows = tiled(rows, own_box, tiles)
        if size != BASE:
            write(csv, box, rows)
        unfinished = data.with_suffix(".part")
        write_data(unfinished, box, rows)
        unfinished.rename(data)
    return csv, data, box
