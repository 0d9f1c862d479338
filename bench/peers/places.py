"""Where things are, and how a program is started and its output read."""
import os
import pathlib
import resource
import subprocess
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BUILD = pathlib.Path(os.environ.get("GRANUM_BENCH_BUILD", ROOT / "build/bench")) / "bench"
WORK = pathlib.Path(os.environ.get("GRANUM_PEERS_WORK", ROOT / "build/peers"))

# One launcher for every program. Memory is copied through a shared page: copying straight from the neighbour's memory is
# forbidden in many containers, and then warns on every run.
MPIRUN = ["mpirun", "--allow-run-as-root", "-np"]
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


class Failed(Exception):
    """A program did not do what it was started for."""


class Outcome:
    """What a finished program printed, its wall time (s), its share of the cores, its peak memory (bytes, one process)."""

    def __init__(self, text, wall, busy, memory):
        self.text, self.wall, self.busy, self.memory = text, wall, busy, memory

    def fields(self, first):
        """The words key=value of the line that starts with `first`."""
        for line in self.text.splitlines():
            if line.startswith(first):
                return dict(word.split("=", 1) for word in line.split() if "=" in word)
        raise Failed(f"no line starts with {first}:\n{self.text[-1500:]}")


def run(command, folder, ranks=1, cores=None, environment=None):
    """Runs a program to its end. Raises Failed with the end of what it printed where it does not end well."""
    words = [str(word) for word in command]
    if ranks > 1:
        words = [*MPIRUN, str(ranks), *words]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    try:
        process = subprocess.Popen(words, cwd=folder, env={**os.environ, **ENVIRONMENT, **(environment or {})},
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    except FileNotFoundError as error:
        raise Failed(f"{words[0]} is not there: {error.strerror}") from error
    with process:
        text = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if process.returncode != 0:
        raise Failed(f"{' '.join(words)}\nended with {process.returncode}:\n{text[-1500:]}")
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return Outcome(text, wall, used / (wall * (cores or ranks)), 1024 * usage.ru_maxrss)
