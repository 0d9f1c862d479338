"""The programs of the comparison: how each is run on a state, and what is read from it."""
import re

import states
from places import BUILD, HERE, Failed, run

PROGRAMS = ("granum", "lammps", "liggghts", "yade")
# Steps before the timed ones, timed steps: the same window of time in every program.
STEPS = {("packed", 20_000): (500, 1000), ("packed", 100_000): (50, 200), ("packed", 1_000_000): (10, 30),
         ("agitated", 20_000): (200, 600), ("agitated", 100_000): (50, 200)}
# Skin of the neighbour list, m: the best of a sweep on one core at 20,000. YADE: part of the radius. Granum chooses itself.
SKIN = {"lammps": {"packed": 1e-4, "agitated": 4e-4}, "liggghts": {"packed": 1e-4, "agitated": 4e-4},
        "yade": {"packed": 0.1, "agitated": 0.1}}


def granum(state, tiles, warm, steps, folder, ranks=1, options=()):
    """Granum's line on a base state that it tiles itself, and how the run went."""
    outcome = run([BUILD / "peer_granum", "time", state, "--tiles", *tiles, "--warm", warm, "--steps", steps, *options],
                  folder, ranks)
    words = outcome.fields("peer=granum")
    return {"loop": float(words["loop"]), "builds": int(words["builds"]), "coordination": float(words["coordination"]),
            "ke": float(words["ke"]), "memory": int(words["memory"]), "busy": outcome.busy}


def molecular(program, data, box, case, warm, steps, folder, ranks):
    """LAMMPS and LIGGGHTS: the second timed loop of the deck and the last line of the third."""
    binary = {"lammps": "lmp", "liggghts": "liggghts"}[program]
    outcome = run([binary, "-log", "none", "-in", HERE / f"decks/time.{program}", "-var", "data", data, "-var", "lx", box[0],
                   "-var", "ly", box[1], "-var", "skin", SKIN[program][case], "-var", "warm", warm, "-var", "steps", steps],
                  folder, ranks)
    loops = re.findall(r"Loop time of (\S+) on", outcome.text)
    builds = re.findall(r"Neighbor list builds = (\d+)", outcome.text)
    last = re.findall(rf"^\s+{warm + steps + 2}\s+(\d+)\s+(\S+)\s+(\S+)", outcome.text, re.MULTILINE)
    if len(loops) != 3 or len(builds) != 3 or not last:
        raise Failed(f"{binary}: three loops and their results were expected:\n{outcome.text[-1500:]}")
    atoms, energy, touching = int(last[-1][0]), float(last[-1][1]), float(last[-1][2])
    return {"loop": float(loops[1]), "builds": int(builds[1]), "ke": energy,
            "coordination": touching / (atoms if program == "liggghts" else 1),
            "memory": outcome.memory if ranks == 1 else 0, "busy": outcome.busy}


def yade(csv, case, warm, steps, folder, cores):
    """YADE: its cores are threads of one process."""
    outcome = run(["yade", "-n", "-x", "-j", cores, HERE / "decks/time_yade.py"], folder, cores=cores,
                  environment={"STATE": str(csv), "WARM": str(warm), "STEPS": str(steps), "VERLET": str(SKIN["yade"][case]),
                               "OMP_NUM_THREADS": str(cores)})
    words = outcome.fields("peer=yade")
    return {"loop": float(words["loop"]), "builds": int(words["builds"]), "coordination": float(words["coordination"]),
            "ke": float(words["ke"]), "memory": outcome.memory, "busy": outcome.busy}


def timed(program, case, size, cores, folder):
    """One run: seconds of the timed loop, million granule-steps per second, and what came out."""
    warm, steps = STEPS[case, size]
    csv, data, box = states.state(case, size, folder)
    if program == "granum":
        result = granum(states.base(case, folder), states.TILES[size], warm, steps, folder, cores)
    elif program == "yade":
        result = yade(csv, case, warm, steps, folder, cores)
    else:
        result = molecular(program, data, box, case, warm, steps, folder, cores)
    return {**result, "steps": steps, "speed": size * steps / result["loop"] / 1e6}


def bandwidth(folder):
    """Triad of one core, GB/s."""
    return float(run([BUILD / "peer_triad"], folder).fields("triad=")["triad"])
