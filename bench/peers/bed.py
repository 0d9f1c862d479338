#!/usr/bin/env python3
"""Granum beside OpenFOAM's DPMFoam: the fluidised bed of OpenFOAM's Goldschmidt tutorial, 24,750 spheres in 5,400 gas cells,
from the same settled packing with the same granule step, dense, as the gas comes up; each at its own stable gas step.

Started by `./dev bench bed`. Compares pressure drop and motion of the bed before times. Ends with 1 where a bar is missed, 2
where a program failed. The settled bed and OpenFOAM's warm-up are kept in build/peers/bed (they take some ten minutes).
"""
import argparse
import csv
import gzip
import json
import math
import os
import pathlib
import random
import re
import shutil
import sys

import page
import places
from measure import Bar, Spread, judged
from places import BUILD, HERE, Failed, run

FOLDER = places.WORK / "bed"
TUTORIAL = pathlib.Path("/usr/share/doc/openfoam-examples/examples/lagrangian/DPMFoam/Goldschmidt")
FOAM = {"WM_PROJECT_DIR": os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam")}
GRANUM = BUILD.parent / "app/granum"
GRANULES, DIAMETER, DENSITY, AIR = 24750, 2.5e-3, 2526, 1.2  # m, kg/m3, kg/m3
WARM = 0.01  # s of gas before anything is timed
FOAM_STEP, FOAM_STEPS, SKIPPED = 2e-5, 40, 6  # s; timed; of those not counted: they hold allocation and page faults
GRANUM_SECONDS = 0.02  # timed
FASTER = {1: 80.0, 2: 60.0}
CLOSE = {"pressure drop": 0.05, "speed": 0.15}  # relative


def lattice():
    """Positions of the tutorial, m."""
    packed = TUTORIAL / "constant/kinematicCloudPositions.gz"
    text = (gzip.open(packed, "rt") if packed.exists() else open(packed.with_suffix(""))).read()
    return [tuple(map(float, words)) for words in re.findall(r"^\((\S+) (\S+) (\S+)\)", text, re.MULTILINE)]


def settle_once(positions, out, jitter, **variables):
    """Positions after a run of LIGGGHTS, m."""
    chance = random.Random(7)
    data = FOLDER / "data.in"
    with open(data, "w") as file:
        file.write(f"granular\n\n{len(positions)} atoms\n1 atom types\n-0.0075 0.0075 xlo xhi\n-0.075 0.075 ylo yhi\n"
                   "0 0.45 zlo zhi\n\nAtoms\n\n")
        for k, place in enumerate(positions):
            x, y, z = (value + chance.uniform(-jitter, jitter) for value in place)
            file.write(f"{k + 1} 1 {DIAMETER} {DENSITY} {x:.8g} {y:.8g} {z:.8g}\n")
    words = [word for name, value in {**variables, "datafile": data, "outfile": out}.items() for word in ("-var", name, value)]
    run(["liggghts", "-in", HERE / "decks/settle.liggghts", *words], FOLDER)
    lines = out.read_text().splitlines()
    first = max(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS")) + 1
    rows = sorted(tuple(map(float, line.split())) for line in lines[first:] if line.strip())
    return [row[1:4] for row in rows]


def settled():
    """The settled packing, m."""
    kept = FOLDER / "settled.json"
    if not kept.exists():
        loose = settle_once(lattice(), FOLDER / "out1.txt", 1e-4, E=5e6, en=0.6, dt=2e-5, nsteps=25000)
        still = settle_once(loose, FOLDER / "out2.txt", 0, E=1e8, en=0.1, dt=4e-6, nsteps=12000)
        kept.write_text(json.dumps(still))
    return json.loads(kept.read_text())


def entry(case, file, name, value):
    run(["foamDictionary", "-entry", name, "-set", value, file], case, environment=FOAM)


def warm_foam(positions):
    """The tutorial from the settled packing, run for WARM seconds."""
    case = FOLDER / "warm"
    if (case / "done").exists():
        return case
    shutil.rmtree(case, ignore_errors=True)
    shutil.copytree(TUTORIAL, case)
    (case / "constant/kinematicCloudPositions.gz").unlink(missing_ok=True)
    with open(case / "constant/kinematicCloudPositions", "w") as file:
        file.write("FoamFile\n{\n    version 2.0;\n    format ascii;\n    class vectorField;\n    object kinematicCloudPositions;\n"
                   "}\n(\n" + "".join(f"({x:.8f} {y:.8f} {z:.8f})\n" for x, y, z in positions) + ")\n")
    entry(case, "system/controlDict", "endTime", WARM)
    entry(case, "system/controlDict", "writeInterval", WARM)
    entry(case, "system/controlDict", "writeFormat", "ascii")
    run(["blockMesh"], case, environment=FOAM)
    (case / "log").write_text(run(["DPMFoam"], case, environment=FOAM).text)
    (case / "done").touch()
    return case


def speed(energy):
    return (2 * energy / (GRANULES * DENSITY * math.pi / 6 * DIAMETER**3)) ** 0.5


def foam_bed(case):
    """Pressure drop (Pa) and speed of the granules (root mean square, m/s) after the warm-up."""
    text = (case / f"{WARM:g}" / "p").read_text()
    values = [float(word) for word in re.search(r"nonuniform List<scalar>\s*\d+\s*\(([^)]*)\)", text)[1].split()]
    bottom, top = values[:60], values[-60:]  # cells go along x, then y, then z
    energy = re.findall(r"Linear kinetic energy\s*= (\S+)", (case / "log").read_text())
    return {"pressure drop": AIR * (sum(bottom) - sum(top)) / 60, "speed": speed(float(energy[-1]))}


def granum_case(positions):
    case = FOLDER / "bed.toml"
    shutil.copy(HERE / "decks/bed.toml", case)
    with open(FOLDER / "settled.csv", "w") as file:
        file.write("id,x,y,z,radius\n")
        for k, (x, y, z) in enumerate(positions):
            file.write(f"{k},{x + 7.5e-3:.8f},{y + 75e-3:.8f},{z:.8f},{DIAMETER / 2}\n")
    return case


def go_on(folder, case, ranks, until):
    """Runs Granum to a time; what summary.json says then."""
    run([GRANUM, "run", case, "-o", folder, "-n", ranks, "--until", f"{until:g} s", "--quiet"], FOLDER, cores=ranks)
    return json.loads((folder / "summary.json").read_text())


def warm_granum(case, ranks):
    folder = FOLDER / f"granum-{ranks}"
    shutil.rmtree(folder, ignore_errors=True)
    go_on(folder, case, ranks, WARM)
    return folder


def granum_bed(folder):
    with open(folder / "timeseries.csv") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    last = dict(zip(rows[0], rows[-1]))
    return {"pressure drop": float(last["pressure_drop"]), "speed": speed(float(last["kinetic_energy"]))}


def timed_granum(warm, case, ranks):
    """Wall seconds per simulated second, and the summary."""
    folder = FOLDER / "timed"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(warm, folder)
    before = json.loads((folder / "summary.json").read_text())
    after = go_on(folder, case, ranks, WARM + GRANUM_SECONDS)
    simulated = after["run"]["simulated_s"] - before["run"]["simulated_s"]
    return (after["run"]["wall_s"] - before["run"]["wall_s"]) / simulated, after


def timed_foam(warm, ranks):
    """Wall seconds per simulated second."""
    case = FOLDER / "foam"
    shutil.rmtree(case, ignore_errors=True)
    shutil.copytree(warm, case)
    entry(case, "system/controlDict", "startFrom", "startTime")
    entry(case, "system/controlDict", "startTime", WARM)
    entry(case, "system/controlDict", "endTime", f"{WARM + FOAM_STEPS * FOAM_STEP:.8g}")
    entry(case, "system/controlDict", "writeInterval", 1000)
    command = ["DPMFoam"]
    if ranks > 1:
        entry(case, "system/decomposeParDict", "numberOfSubdomains", ranks)
        entry(case, "system/decomposeParDict", "coeffs.n", f"(1 {ranks} 1)")
        run(["decomposePar"], case, environment=FOAM)
        command.append("-parallel")
    text = run(command, case, ranks=ranks, environment=FOAM).text
    clock = [float(word) for word in re.findall(r"ExecutionTime = (\S+) s", text)]
    if len(clock) < FOAM_STEPS:
        raise Failed(f"DPMFoam took {len(clock)} steps instead of {FOAM_STEPS}:\n{text[-1500:]}")
    return (clock[-1] - clock[SKIPPED - 1]) / (len(clock) - SKIPPED) / FOAM_STEP


def compare(foam, granum):
    lines = ["| at 0.01 s | DPMFoam | Granum | apart |", "|---|---:|---:|---:|"]
    bars = []
    for name, limit in CLOSE.items():
        apart = abs(granum[name] - foam[name]) / abs(foam[name])
        unit = {"pressure drop": "Pa", "speed": "m/s"}[name]
        lines.append(f"| {name}, {unit} | {foam[name]:.4g} | {granum[name]:.4g} | {100 * apart:.1f} % |")
        bars.append(Bar(f"{name}: apart", apart, limit, at_least=False))
    return lines, bars


def main():
    parser = argparse.ArgumentParser(prog="./dev bench bed", description=__doc__.split("\n\n")[0])
    parser.add_argument("--rounds", type=int, default=5, help="repetitions (5)")
    parser.add_argument("--write", action="store_true", help="put the tables into doc/validation/peers.md")
    options = parser.parse_args()
    FOLDER.mkdir(parents=True, exist_ok=True)
    say = lambda text: print(text, file=sys.stderr, flush=True)
    try:
        positions = settled()
        foam, case = warm_foam(positions), granum_case(positions)
        warm = {ranks: warm_granum(case, ranks) for ranks in FASTER}
        lines, bars = compare(foam_bed(foam), granum_bed(warm[1]))
        say("\n".join(lines))
        times, summaries = {}, {}
        for round_ in range(options.rounds):
            for ranks in FASTER:
                order = ("granum", "foam") if round_ % 2 else ("foam", "granum")
                for program in order:
                    if program == "granum":
                        value, summaries[ranks] = timed_granum(warm[ranks], case, ranks)
                    else:
                        value = timed_foam(foam, ranks)
                    times.setdefault((program, ranks), []).append(value)
                    say(f"round {round_ + 1}: {program} on {ranks}: {value:.1f} s per simulated second")
    except Failed as failure:
        print(f"bed: {failure}", file=sys.stderr)
        return 2
    speeds = ["| program | cores | gas step | granule step | wall seconds per simulated second | Granum over it |",
              "|---|---:|---:|---:|---|---|"]
    for ranks, asked in FASTER.items():
        ratio = Spread([theirs / ours for theirs, ours in zip(times["foam", ranks], times["granum", ranks])])
        speeds.append(f"| DPMFoam | {ranks} | 2e-5 s | 5e-6 s | {Spread(times['foam', ranks]).text()} | {ratio.text()} |")
        speeds.append(f"| Granum | {ranks} | 2e-4 s | 5e-6 s | {Spread(times['granum', ranks]).text()} | |")
        bars.append(Bar(f"{ranks} core{'s' if ranks > 1 else ''}: DPMFoam's time over Granum's", ratio.median, asked,
                        text=ratio.text()))
    judgement, missed = judged(bars)
    sections = {"bed": lines, "speed": speeds, "bars": judgement}
    page.show("gas", sections, options.write)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
