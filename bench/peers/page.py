"""The tables of a comparison, for the screen and for doc/validation/peers.md."""
import re

from places import ROOT

PAGE = ROOT / "doc/validation/peers.md"


def speed(table):
    """Every program in every cell."""
    out = ["| state | granules | cores | program | million granule-steps/s | Granum over it | lists made | contacts a granule "
           "| bytes a granule | of its cores |", "|---|---:|---:|---|---|---|---:|---:|---:|---:|"]
    for cell in table.cells:
        case, size, cores = cell
        for program in ("granum", "lammps", "liggghts", "yade"):
            runs = list(table.runs(program, cell).values())
            if not runs:
                continue
            own = program == "granum"
            ratio = "" if own else table.ratio(cell, (program,)).text()
            spread = type(table.triad)([run["speed"] for run in runs])
            memory = max(run["memory"] for run in runs)
            out.append(f"| {case} | {size:,} | {cores} | {NAMES[program]} | {spread.text()} | {ratio} | {runs[0]['builds']} "
                       f"in {runs[0]['steps']} | {runs[0]['coordination']:.2f} | {f'{memory / size:,.0f}' if memory else ''} "
                       f"| {100 * min(run['busy'] for run in runs):.0f} % |")
    return out


NAMES = {"granum": "Granum", "lammps": "LAMMPS", "liggghts": "LIGGGHTS", "yade": "YADE"}


def force_table(rows):
    """Differences from LAMMPS' forces, in units of the force at an overlap of 1e-3 R."""
    out = ["| compared | state | steps | force, largest | force, median | torque over R, largest | force at walls, largest |",
           "|---|---|---:|---:|---:|---:|---:|"]
    for row in rows:
        torque = "" if row["torque"] is None else f"{row['torque']:.1e}"
        out.append(f"| {row['what']} | {row['state']} | {row['steps']} | {row['largest']:.1e} | {row['median']:.1e} | {torque} "
                   f"| {row['walls']:.1e} |")
    return out


def write(part, sections):
    """Puts tables between their marks in the page. Raises ValueError where a mark is not there."""
    text = PAGE.read_text()
    for name, lines in sections.items():
        begin, end = f"<!-- {part} {name}: begin -->", f"<!-- {part} {name}: end -->"
        if begin not in text or end not in text:
            raise ValueError(f"{PAGE}: no lines {begin} and {end}")
        body = "\n".join(lines)
        text = re.sub(re.escape(begin) + ".*?" + re.escape(end), lambda _: f"{begin}\n{body}\n{end}", text, flags=re.DOTALL)
    PAGE.write_text(text)


def show(part, sections, keep):
    """Prints tables and, if they are to be kept, puts them into the page."""
    print("\n\n".join("\n".join(section) for section in sections.values()))
    if keep:
        write(part, sections)
