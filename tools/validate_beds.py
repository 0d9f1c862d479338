#!/usr/bin/env python3
"""Runs the fluidised beds of test/validate/beds with granum and holds them against what was measured or must be: writes
doc/validation/gas-beds.md with a table and a picture for each. Started by `./dev test validate` (or with names of beds: these
alone).

Runs are kept in build/validate and go on where they were interrupted, so the whole can be done in pieces. Errors of means are
standard errors from ten blocks. Ends with 1 where a verdict fails, 2 where a run failed.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
CASES = ROOT / "test/validate/beds"
REFERENCE = ROOT / "test/reference"
PAGE = ROOT / "doc/validation/gas-beds.md"
WORK = pathlib.Path(os.environ.get("GRANUM_VALIDATE_WORK", ROOT / "build/validate"))
GRANUM = pathlib.Path(os.environ.get("GRANUM_PROGRAM", ROOT / "build/release/app/granum"))
BLOCKS = 10


class Mean:
    """A mean over time with its standard error from the means of blocks."""

    def __init__(self, values):
        size = len(values) // BLOCKS
        if size == 0:
            raise ValueError("too few rows for block means")
        blocks = [statistics.fmean(values[k * size:(k + 1) * size]) for k in range(BLOCKS)]
        self.value = statistics.fmean(blocks)
        self.error = statistics.stdev(blocks) / math.sqrt(BLOCKS)

    def text(self, scale=1, digits=4):
        return f"{scale * self.value:.{digits}g} +- {scale * self.error:.1g}"


class Section:
    """One bed of the page."""

    def __init__(self, title, setup):
        self.title, self.setup, self.rows, self.pictures, self.failed = title, setup, [], [], 0

    def row(self, quantity, published, source, ours, holds=None):
        verdict = "" if holds is None else "holds" if holds else "**does not hold**"
        self.failed += holds is False
        self.rows.append(f"| {quantity} | {published} | {source} | {ours} | {verdict} |")

    def lines(self):
        return [f"## {self.title}", "", self.setup, "", "| quantity | published or demanded | source | ours | verdict |",
                "|---|---:|---|---:|---|", *self.rows, "",
                *(line for name, words in self.pictures for line in (f"![{words}]({name})", "", words, ""))]


class Run:
    """A finished run folder."""

    def __init__(self, folder):
        self.folder = folder
        self.summary = json.loads((folder / "summary.json").read_text())

    def table(self, name):
        """Columns of a file, as far as numbers stand in them."""
        with open(self.folder / name) as file:
            rows = list(csv.reader(file))
        names, body = rows[0], rows[2:]
        return {n: [float(row[k]) if row[k] else math.nan for row in body] for k, n in enumerate(names)}

    def after(self, name, column, start):
        table = self.table(name)
        return [value for time, value in zip(table["time"], table[column]) if time > start]


def finished(case, folder):
    """Whether the folder holds a run of all the time that the case asks for: a longer one goes on."""
    path = folder / "summary.json"
    if not path.exists():
        return False
    summary = json.loads(path.read_text())
    asked = float(re.search(r'^duration = "([0-9.]+) s"', case.read_text(), re.MULTILINE)[1])
    return summary["ended"] == "done" and summary["run"]["simulated_s"] > asked - 1e-6


def run(case, folder, ranks=1):
    if not finished(case, folder):
        folder.parent.mkdir(parents=True, exist_ok=True)
        print(f"validate: {case.stem} in {folder}", file=sys.stderr, flush=True)
        process = subprocess.run([GRANUM, "run", case, "-o", folder, "-n", str(ranks), "--quiet"], check=False)
        if process.returncode != 0 or not finished(case, folder):
            raise RuntimeError(f"granum run {case} ended with {process.returncode}")
    return Run(folder)


def picture(of, name, section, words):
    subprocess.run([GRANUM, "report", of.folder], check=True, stdout=subprocess.DEVNULL)
    found = sorted((of.folder / "pictures").glob("*.png"))
    if found:
        shutil.copy(found[-1], PAGE.parent / f"{name}.png")
        section.pictures.append((f"{name}.png", words))


def reference(name):
    with open(REFERENCE / name) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def pressure_row(section, of, start, within, straight=True):
    """`straight`: walls are upright, so that what granules lean on them is along z alone."""
    drop = Mean(of.after("timeseries.csv", "pressure_drop", start))
    weight = of.summary["bed"]["weight_over_area_Pa"]
    apart = drop.value / weight - 1
    section.row("mean pressure drop over the weight of the bed, Pa", f"{weight:.4g} +- {100 * within:.0f} %",
                "force balance", drop.text(), abs(apart) < within)
    if not straight:
        return
    table = of.table("timeseries.csv")
    late = [k for k, time in enumerate(table["time"]) if time > start]
    area = of.summary["granules"]["mass_kg"] * 9.81 / weight  # of the bed, without the weight of the gas it displaces
    carried = [table["pressure_drop"][k] - table["wall_force_z"][k] / area for k in late]
    both = Mean(carried)
    section.row("the same with what granules lean on plate and walls, Pa", f"{weight:.4g} +- 1 % or two standard errors",
                "force balance", both.text(), abs(both.value - weight) < max(0.01 * weight, 2 * both.error))


def height_row(section, of, start, published, source, low, high):
    height = Mean(of.after("timeseries.csv", "bed_height", start))
    section.row("height of the bed (twice the mean height of its mass), mm", published, source, height.text(1e3),
                None if low is None else low < 1e3 * height.value < high)


def profile(of, prefix, column, count, start):
    table = of.table("boxes.csv")
    late = [k for k, time in enumerate(table["time"]) if time > start]
    return [Mean([table[f"{prefix}-{k}_{column}"][row] for row in late]) for k in range(count)]


def along(profile_values, width, x):
    """Linear between the middles of boxes."""
    count = len(profile_values)
    at = min(max(x / width * count - 0.5, 0), count - 1)
    k = min(int(at), count - 2)
    return profile_values[k] + (at - k) * (profile_values[k + 1] - profile_values[k])


def mueller(folder):
    section = Section("Mueller et al.", "9240 spheres of 1.2 mm in 44 mm x 10 mm, air at 0.6 m/s, 12 s, means after 2 s. Voidage "
                      "is what granules leave of boxes 2 mm wide over the whole depth; published: magnetic resonance "
                      "(reference case x-03). The root mean squares of sediFoam's own archived curves are 0.027 and 0.057 (voidage) "
                      "and 0.036 m/s.")
    of, start, count, width = run(CASES / "mueller.toml", folder), 2.0, 22, 0.044
    pressure_row(section, of, start, 0.03)
    height_row(section, of, start, "", "", None, None)
    fast = run(CASES / "mueller-fast.toml", folder.with_name("mueller-fast"))
    fast_height = Mean(fast.after("timeseries.csv", "bed_height", 1.0))
    section.row("the same at 0.9 m/s, mm", "45 to 55 (seen: 50, its velocity not told)", "Khawaja 2015", fast_height.text(1e3),
                45 < 1e3 * fast_height.value < 55)
    rows = reference("x-03.csv")
    for prefix, y, name in (("low", 0.0164, "16.4"), ("high", 0.0312, "31.2")):
        ours = [1 - one.value for one in profile(of, prefix, "solids_fraction", count, start)]
        points = [row for row in rows if row["quantity"].startswith("void") and abs(float(row["y_m"]) - y) < 1e-4]
        rms = math.sqrt(statistics.fmean((along(ours, width, float(p["x_m"])) - float(p["value"])) ** 2 for p in points))
        section.row(f"voidage at {name} mm: root mean square of the difference at {len(points)} places", "0.05", "x-03",
                    f"{rms:.3f}", rms < 0.05)
    speeds = profile(of, "moving", "velocity_z", count, start)
    ours = [one.value for one in speeds]
    points = [row for row in rows if row["quantity"] == "velocity_y"]
    rms = math.sqrt(statistics.fmean((along(ours, width, float(p["x_m"])) - float(p["value"])) ** 2 for p in points))
    section.row(f"upward velocity at 19.9 mm, m/s: root mean square of the difference at {len(points)} places", "0.04", "x-03",
                f"{rms:.3f}", rms < 0.04)
    middle, wall = statistics.fmean(ours[10:12]), 0.5 * (ours[0] + ours[-1])
    section.row("upward velocity in the middle and at the walls, m/s", "up and down", "Mueller et al. 2008",
                f"{middle:.3f} and {wall:.3f}", middle > 0 > wall)
    picture(of, "bed-mueller", section, "Mueller's bed at the end of the run")
    return section


def goldschmidt(folder):
    section = Section("Goldschmidt et al.", "24,750 glass beads of 2.5 mm in 150 mm x 15 mm, air at 1.92 m/s (1.5 times the "
                      "measured velocity of minimum fluidisation), means after 1 s. The published mean height of all granules "
                      "is recalled.")
    of, start = run(CASES / "goldschmidt.toml", folder), 1.0
    pressure_row(section, of, start, 0.03)
    height = Mean(of.after("timeseries.csv", "bed_height", start))
    section.row("mean height of all granules, mm", "about 100", "Goldschmidt et al. 2004 (recalled)",
                f"{500 * height.value:.1f} +- {500 * height.error:.1g}")
    picture(of, "bed-goldschmidt", section, "Goldschmidt's bed at the end of the run")
    return section


def slugs(section, of, start, published):
    """Height and pressure of van Wachem's bed; judged where `published`, recorded otherwise."""
    judged = (lambda holds: holds) if published else (lambda holds: None)
    height = of.after("timeseries.csv", "highest_granule", start)
    mean = Mean(height)
    section.row("mean height, mm", "124.8 +- 10 %", "x-04", mean.text(1e3), judged(abs(1e3 * mean.value / 124.8 - 1) < 0.1))
    section.row("standard deviation of the height, mm", "14.4", "x-04", f"{1e3 * statistics.pstdev(height):.3g}")
    pressure = of.after("boxes.csv", "tap_gas_pressure", start)
    centre, spread = statistics.fmean(pressure), statistics.pstdev(pressure)
    section.row("pressure at 45 mm: standard deviation, Pa", "81.9, within a factor 1.5", "x-04", f"{spread:.1f}",
                judged(81.9 / 1.5 < spread < 81.9 * 1.5))
    smooth = [statistics.fmean(pressure[max(k - 2, 0):k + 3]) - centre for k in range(len(pressure))]
    rises = sum(a < 0 <= b for a, b in zip(smooth, smooth[1:])) / (of.summary["run"]["simulated_s"] - start)
    section.row("frequency, Hz (upward crossings of the mean)", "2.1 to 2.85, +- 0.5", "x-04", f"{rises:.2f}",
                judged(1.6 < rises < 3.35))


def vanwachem(folder):
    section = Section("van Wachem et al.", "17,562 spheres of 1.545 mm in 90 mm x 8 mm, air at 0.9 m/s, 8 s, after 2 s (reference "
                      "case x-04). As in Lethe's own comparison the height is that of the highest granule, and the "
                      "pressure that in the middle, 42 mm to 48 mm from a side and above the plate. The drag law decides how it "
                      "slugs: rows with Di Felice's, Lethe's choice, are recorded below; Lethe reports amplitudes lower than "
                      "measured with it, and so do we.")
    case, start = CASES / "vanwachem.toml", 2.0
    of = run(case, folder)
    pressure_row(section, of, start, 0.03)
    slugs(section, of, start, True)
    height_row(section, of, start, "", "", None, None)
    other = folder.with_name("vanwachem-di-felice")
    text = other.with_suffix(".toml")
    text.parent.mkdir(parents=True, exist_ok=True)
    text.write_text(case.read_text().replace("gidaspow", "di-felice"))
    section.row("**with Di Felice's drag**", "", "", "")
    of_other = run(text, other)
    section.row("mean pressure drop, Pa", "", "", Mean(of_other.after("timeseries.csv", "pressure_drop", start)).text())
    slugs(section, of_other, start, False)
    picture(of, "bed-vanwachem", section, "van Wachem's bed at the end of the run")
    return section


def patil(folder):
    section = Section("Patil et al.", "57,296 glass beads of 1 mm (75 g) in 80 mm x 15 mm, 90 degC in air of 20 degC at 1.2 m/s, no "
                      "heat through walls. A bed cannot cool faster than by gas that leaves it in equilibrium.")
    of, start = run(CASES / "patil.toml", folder), 1.0
    pressure_row(section, of, start, 0.03)
    table = of.table("timeseries.csv")
    tau = 36.2  # s, closed form of the bound; see the row's source
    worst, end = 1e9, 0.0
    for time, temperature in zip(table["time"], table["bed_temperature"]):
        limit = 20 + 70 * math.exp(-time / tau)
        celsius = temperature - 273.15 if temperature > 200 else temperature
        worst = min(worst, celsius - limit)
        end = (celsius - 20) / 70
    section.row("bed temperature less the bound, K, least", "at least -0.3", f"M c_p / (mass flow x c_pg) = {tau} s",
                f"{worst:.3f}", worst > -0.3)
    last = table["time"][-1]
    section.row(f"(T - T_in) / (T_0 - T_in) after {last:.3g} s", f"at least {math.exp(-last / tau):.4f}", "bound", f"{end:.4f}",
                end > math.exp(-last / tau) - 0.005)
    picture(of, "bed-patil", section, "Patil's bed at the end of the run")
    return section


def spout(folder):
    section = Section("Spout-fluid bed", "44,800 glass beads of 4.04 mm in 154 mm x 84 mm, background 2.5 m/s, a spout of 22 mm x 12 mm "
                      "at 60 m/s; means after 0.5 s. Speeds are recalled; recorded, not judged, where nothing could be read.")
    of, start = run(CASES / "spout.toml", folder), 0.5
    drop = Mean(of.after("timeseries.csv", "pressure_drop", start))
    weight = of.summary["bed"]["weight_over_area_Pa"]
    # Momentum of the gas: what comes with the spout and around it, less what leaves at the mean velocity.
    area, spout_area = 0.154 * 0.084, 0.022 * 0.012
    mean = 2.5 + (60 - 2.5) * spout_area / area
    jet = 1.2 * (60**2 * spout_area + 2.5**2 * (area - spout_area) - mean**2 * area) / area
    section.row(f"mean pressure drop over the weight of the bed, {weight:.4g} Pa, less the momentum of the spout, {jet:.0f} Pa",
                f"{weight - jet:.4g} +- 3 %", "force balance", drop.text(), abs(drop.value / (weight - jet) - 1) < 0.03)
    lean = statistics.fmean(of.after("timeseries.csv", "wall_force_z", start)) / area
    carried = drop.value + jet - lean
    section.row(f"with the momentum of the spout, {jet:.0f} Pa, and what granules lean on plate and walls, {-lean:.0f} Pa",
                f"{weight:.4g} +- 3 %", "force balance", f"{carried:.4g} +- {drop.error:.1g}", abs(carried / weight - 1) < 0.03)
    height_row(section, of, start, "", "", None, None)
    picture(of, "bed-spout", section, "Spout-fluid bed at the end of the run")
    return section


def sscp(folder):
    section = Section("SSCP-I", "92,948 nylon spheres of 3.256 mm in 228.6 mm x 76.2 mm, air at 2.19 m/s (recalled), means after 0.75 s. "
                      "The measured tables are not at hand: heights are recorded. At 3.28 m/s the bed rose from rest as one plug; in a "
                      "box of 914 mm it stayed against the outlet, at twice its weight.")
    of, start = run(CASES / "sscp.toml", folder), 0.75
    pressure_row(section, of, start, 0.03)
    height_row(section, of, start, "", "", None, None)
    taps = [of.after("boxes.csv", f"{tap}_gas_pressure", start) for tap in ("low", "high")]
    between = [low - high for low, high in zip(*taps)]
    section.row("pressure drop between taps at 41.3 mm and 346.1 mm, Pa", "", "", Mean(between).text())
    section.row("its standard deviation, Pa", "", "", f"{statistics.pstdev(between):.3g}")
    picture(of, "bed-sscp", section, "SSCP-I at the end of the run")
    return section


def beetstra(voidage, reynolds):
    """Force over that of Stokes with superficial velocity (Beetstra, van der Hoef and Kuipers 2007)."""
    phi = 1 - voidage
    return (10 * phi / voidage**2 + voidage**2 * (1 + 1.5 * math.sqrt(phi)) + 0.413 * reynolds / (24 * voidage**2) *
            (1 / voidage + 3 * voidage * phi + 8.4 * reynolds**-0.343) /
            (1 + 10 ** (3 * phi) * reynolds ** (-(1 + 4 * phi) / 2)))


def fluidising_velocity(voidage, diameter, solid, gas, viscosity):
    """Superficial velocity at which drag and pressure carry a granule, m/s."""
    low, high = 1e-6, 50.0
    for _ in range(80):
        middle = 0.5 * (low + high)
        drag = 3 * math.pi * viscosity * diameter * middle * beetstra(voidage, gas * middle * diameter / viscosity)
        carried = drag / voidage  # drag and its pressure gradient: what a bed at rest costs
        weight = (solid - gas) * 9.81 * math.pi / 6 * diameter**3
        low, high = (middle, high) if carried < weight else (low, middle)
    return low


def one_after_the_other(folder, text, number, velocities):
    """Runs of a case at one velocity after the other, each from the state that the one before left."""
    folder.mkdir(parents=True, exist_ok=True)
    before = None
    for velocity in velocities:
        own = re.sub(r'velocity = "[0-9.]+ m/s"', f'velocity = "{velocity:.2f} m/s"', text)
        if before is not None:
            own = re.sub(r"^(start|spacing|noise) = .*\n", "", own, flags=re.MULTILINE)
            own = own.replace(f"number = {number}", f'start = "given"\nrun = "{before.name}"')
        case = folder / f"u-{velocity:.2f}.toml"
        case.write_text(own)
        of = run(case, folder / f"u-{velocity:.2f}")
        before = of.folder
        yield velocity, of


def crossing(points, level):
    """Where the line p = a u + b u^2 through the points of the fixed bed (least squares) meets a level. Points: u and p; fixed
    are those below all that come to 0.9 of the level."""
    slowest = min(u for u, p in points if p >= 0.9 * level)
    points = [(u, p) for u, p in points if u < slowest]
    s2, s3, s4 = (sum(u**n for u, _ in points) for n in (2, 3, 4))
    t1, t2 = (sum(p * u**n for u, p in points) for n in (1, 2))
    a, b = (t1 * s4 - t2 * s3) / (s2 * s4 - s3 * s3), (s2 * t2 - s3 * t1) / (s2 * s4 - s3 * s3)
    return (-a + math.sqrt(a * a + 4 * b * level)) / (2 * b) if b > 0 else level / a


def umf(folder):
    section = Section("Minimum fluidisation", "Mueller's granules as their air is turned down, 0.5 s at each velocity from the state "
                      "before, pressures of the second half. U_mf is where the line a U + b U^2 through the fixed bed's points "
                      "(below 0.9 of the weight) meets the weight: once within a column 12 mm x 12 mm whose sides repeat "
                      "themselves, between two taps 32 mm apart, where packing and force balance are those of its middle; and once of "
                      "Mueller's whole bed, which is eight cells deep, with walls and a surface.")
    velocities = (0.50, 0.40, 0.35, 0.30, 0.27, 0.24, 0.20, 0.16, 0.12, 0.08)
    points = []
    for velocity, of in one_after_the_other(folder / "column", (CASES / "column.toml").read_text(), 5000, velocities):
        low, high = (statistics.fmean(of.after("boxes.csv", f"{tap}_gas_pressure", 0.25)) for tap in ("low", "high"))
        solids = statistics.fmean(of.after("boxes.csv", "between_solids_fraction", 0.25))
        points.append((velocity, (low - high) / 0.032 - 1.2 * 9.81, solids))
    solids = points[-1][2]
    weight = solids * (1000 - 1.2) * 9.81
    met = crossing([(u, p) for u, p, _ in points], weight)
    demanded = fluidising_velocity(1 - solids, 1.2e-3, 1000, 1.2, 1.8e-5)
    section.row(f"column: U_mf, m/s (solids {solids:.3f})", f"{demanded:.4f} +- 3 %",
                "force balance, the same drag law, the same packing", f"{met:.4f}", abs(met / demanded - 1) < 0.03)
    for u, p, s in points:
        section.row(f"column: pressure gradient at {u:.2f} m/s, Pa/m (solids {s:.3f})",
                    f"{s * (1000 - 1.2) * 9.81:.0f}" if p > 0.9 * weight else "", "weight" if p > 0.9 * weight else "", f"{p:.0f}")
    text = (CASES / "mueller.toml").read_text()
    text = text[:text.index("[[output.box]]")].replace('duration = "12 s"', 'duration = "0.5 s"')
    text += '[[output.box]]\nname = "bed"\nlower = ["0 mm", "0 mm", "4 mm"]\nupper = ["44 mm", "10 mm", "24 mm"]\n'
    whole = []
    for velocity, of in one_after_the_other(folder, text, 9240, (0.60, 0.50, 0.45, *velocities[1:])):
        whole.append((velocity, Mean(of.after("timeseries.csv", "pressure_drop", 0.25)).value))
    weight = of.summary["bed"]["weight_over_area_Pa"]
    met = crossing(whole, weight)
    section.row("whole bed: U_mf, m/s", "0.3", "Mueller et al., measured (recalled)", f"{met:.3f}", abs(met / 0.3 - 1) < 0.15)
    for u, p in whole:
        section.row(f"whole bed: pressure drop at {u:.2f} m/s, Pa", f"{weight:.1f}" if p >= 0.9 * weight else "",
                    "weight" if p >= 0.9 * weight else "", f"{p:.1f}")
    return section


def tube(folder):
    section = Section("Tube of 200,000 spheres", "Spheres of 0.5 mm in a tube of 20 mm whose air is turned up as in Lethe's example, "
                      "0.05 s at each velocity from the state before, pressures of the second half (reference case x-02; the drag "
                      "law is Ergun's in the dense bed). U_mf is where the line a U + b U^2 through the fixed bed's points meets "
                      "the weight.")
    text, points = (CASES / "tube.toml").read_text(), []
    for velocity, of in one_after_the_other(folder, text, 200000, (0.02, 0.06, 0.08, 0.10, 0.12, 0.16, 0.20, 0.25, 0.30)):
        points.append((velocity, statistics.fmean(of.after("timeseries.csv", "pressure_drop", 0.025)),
                       statistics.fmean(of.after("boxes.csv", "between_solids_fraction", 0.025))))
    points = points[1:]  # at the first the spheres still settle
    weight = of.summary["bed"]["weight_over_area_Pa"]
    section.row("weight over area, Pa", "408.3 +- 0.5 %", "x-02", f"{weight:.1f}", abs(weight / 408.34 - 1) < 0.005)
    plateau = statistics.fmean(p for u, p, _ in points if u >= 0.2)
    section.row("plateau of the pressure drop, 0.20 m/s and above, Pa", "408.3 +- 3 %", "x-02", f"{plateau:.1f}",
                abs(plateau / 408.34 - 1) < 0.03)
    met, packing = crossing([(u, p) for u, p, _ in points], weight), points[2][2]
    section.row(f"U_mf, m/s (solids {packing:.3f} in the middle)", "0.1348 +- 20 %", "x-02, Wen and Yu", f"{met:.4f}",
                abs(met / 0.134826 - 1) < 0.2)
    for u, p, s in points:
        section.row(f"pressure drop at {u:.2f} m/s, Pa (solids {s:.3f})", "", "", f"{p:.1f}")
    return section


def cone(folder):
    section = Section("Lab cone on ranks", "The lab example, 12 s with spray, on 1, 2 and 4 ranks that share space anew every 200 gas steps; "
                      "means after 1.5 s. What granules alone do in gas that is held is the same to the bit "
                      "(`./dev test repeat`).")
    runs = {ranks: run(CASES / "cone.toml", folder / f"{ranks}", ranks) for ranks in (1, 2, 4)}
    pressure_row(section, runs[1], 1.5, 0.03, straight=False)
    for column, name, scale in (("pressure_drop", "pressure drop, Pa", 1), ("bed_height", "height, mm", 1e3)):
        means = {ranks: Mean(of.after("timeseries.csv", column, 1.5)) for ranks, of in runs.items()}
        for ranks in (2, 4):
            apart = abs(means[ranks].value - means[1].value)
            error = math.hypot(means[ranks].error, means[1].error)
            section.row(f"{name}: {ranks} ranks against one", f"{means[1].text(scale)}, within two standard errors", "one rank",
                        means[ranks].text(scale), apart < 2 * error)
    for ranks, of in runs.items():
        for name in ("solids", "water", "energy", "momentum"):
            ledger = of.summary["ledger"][name]
            section.row(f"{name} ledger on {ranks}: relative error", f"at most {ledger['bar']:g}", "conservation",
                        f"{ledger['relative_error']:.1e}", ledger["relative_error"] <= ledger["bar"])
    picture(runs[4], "bed-cone", section, "The lab cone at the end of the run on four ranks")
    return section


BEDS = {"mueller": mueller, "umf": umf, "goldschmidt": goldschmidt, "vanwachem": vanwachem, "patil": patil, "spout": spout,
        "sscp": sscp, "tube": tube, "cone": cone}


def write(sections):
    """Replaces these sections of the page and leaves the others."""
    old = {}
    if PAGE.exists():
        for part in re.split(r"^(?=## )", PAGE.read_text(), flags=re.MULTILINE)[1:]:
            old[part.split("\n", 1)[0][3:]] = part.rstrip("\n")
    for section in sections:
        old[section.title] = "\n".join(section.lines()).rstrip("\n")
    head = ("# Fluidised beds\n\nWritten by `./dev test validate`; do not edit. Beds with gas, case files in "
            "[test/validate/beds](../../test/validate/beds), against what was\nmeasured or what the balance of forces demands. "
            "Means over time have the standard error of ten blocks.\n")
    PAGE.write_text(head + "".join(f"\n{text}\n" for _, text in sorted(old.items())))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("beds", nargs="*", metavar="BED", help=f"any of {', '.join(BEDS)}; otherwise all")
    options = parser.parse_args()
    if unknown := set(options.beds) - set(BEDS):
        parser.error(f"no such bed: {', '.join(sorted(unknown))}; there are {', '.join(BEDS)}")
    failed = 0
    for name in options.beds or BEDS:
        try:
            section = BEDS[name](WORK / name)
        except (RuntimeError, ValueError) as error:
            print(f"validate: {name}: {error}", file=sys.stderr)
            return 2
        write([section])
        print("\n".join(section.lines()))
        failed += section.failed
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
