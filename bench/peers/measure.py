"""Repeated measurements: kept in the work folder as they come, medians with their spread, and bars."""
import hashlib
import json
import statistics

from places import BUILD, HERE, WORK


class Kept:
    """Results of one set of programs, a line each, so that an interrupted comparison goes on where it was.

    The set is known by the contents of Granum's side and of the decks: after a change of either all is measured anew,
    because only what ran in the same round is compared."""

    def __init__(self, name):
        digest = hashlib.sha256()
        for path in (BUILD / "peer_granum", BUILD / "peer_triad", *sorted(HERE.glob("*.py")), *sorted(HERE.glob("decks/*"))):
            digest.update(path.read_bytes())
        self.folder = WORK / f"{name}-{digest.hexdigest()[:12]}"
        self.folder.mkdir(parents=True, exist_ok=True)
        self.path = self.folder / "results.jsonl"
        self.rows = {}
        if self.path.exists():
            # A line that was being written when the comparison was interrupted has no end.
            for line in self.path.read_text().splitlines(keepends=True):
                if line.endswith("\n"):
                    key, value = json.loads(line)
                    self.rows[tuple(key)] = value

    def get(self, key, measure):
        """The result under `key`, measured now if it is not there yet."""
        if key not in self.rows:
            value = measure()
            whole = "".join(json.dumps([list(k), v]) + "\n" for k, v in [*self.rows.items(), (key, value)])
            unfinished = self.path.with_suffix(".part")
            unfinished.write_text(whole)
            unfinished.replace(self.path)
            self.rows[key] = value
        return self.rows[key]


class Spread:
    """Median, smallest and largest of some numbers."""

    def __init__(self, numbers):
        self.median, self.low, self.high = statistics.median(numbers), min(numbers), max(numbers)

    def text(self, digits=3):
        return f"{self.median:.{digits}g} ({self.low:.{digits}g} to {self.high:.{digits}g})"


class Bar:
    """A number that must not fall below (or rise above) a limit."""

    def __init__(self, what, value, limit, at_least=True, text=None):
        self.what, self.value, self.limit, self.at_least = what, value, limit, at_least
        self.shown = text or f"{value:.3g}"

    def met(self):
        return self.value >= self.limit if self.at_least else self.value <= self.limit

    def row(self):
        sign = "at least" if self.at_least else "at most"
        return f"| {self.what} | {self.shown} | {sign} {self.limit:.4g} | {'yes' if self.met() else '**no**'} |"


def judged(bars):
    """The bars as a table, and how many are missed."""
    lines = ["| bar | measured, median (lowest to highest) | asked | met |", "|---|---|---|---|", *(bar.row() for bar in bars)]
    return lines, sum(not bar.met() for bar in bars)
