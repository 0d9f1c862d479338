"""What the machine and the programs of a comparison are, as a table."""
import os
import re
import subprocess

from places import BUILD


def told(*command):
    """What a command prints; nothing where it is not there."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout
    except FileNotFoundError:
        return ""


def version(package):
    return told("dpkg-query", "-W", "-f", "${Version}", package) or "not installed"


def processor():
    """Name and vector units."""
    with open("/proc/cpuinfo") as file:
        text = file.read()
    name = re.search(r"model name\s*: (.*)", text)
    flags = set(re.search(r"flags\s*: (.*)", text)[1].split())
    units = [unit for unit, flag in (("AVX-512", "avx512f"), ("AVX2", "avx2"), ("SSE4", "sse4_1")) if flag in flags]
    return f"{name[1] if name else 'unknown'}, {units[0] if units else 'no vector units known'}"


def caches():
    sizes = re.findall(r"^(L\d\w*) cache:\s*(\S+ \S+)", told("lscpu"), re.MULTILINE)
    return ", ".join(f"{name} {size}" for name, size in sizes)


def memory():
    with open("/proc/meminfo") as file:
        return f"{int(file.readline().split()[1]) / 2**20:.0f} GiB"


def lines(triad):
    """The machine, the compiler, the programs; `triad` is its measured bandwidth."""
    compiler = told("c++", "--version").splitlines()[:1]
    cache = (BUILD.parent / "CMakeCache.txt").read_text() if (BUILD.parent / "CMakeCache.txt").exists() else ""
    kind = re.search(r"^CMAKE_BUILD_TYPE:\w+=(\w+)", cache, re.MULTILINE)
    return ["| what | here |", "|---|---|",
            f"| processor | {processor()}, {os.cpu_count()} cores |",
            f"| caches | {caches()} |",
            f"| memory | {memory()}; triad of one core {triad.text()} GB/s |",
            f"| compiler of Granum | {compiler[0] if compiler else 'unknown'}, {kind[1] if kind else 'unknown'} build |",
            f"| LAMMPS, LIGGGHTS, YADE | Debian's {version('lammps')}, {version('liggghts')}, {version('yade')} |",
            f"| MPI | {told('mpirun', '--version').splitlines()[0] if told('mpirun', '--version') else 'unknown'} |"]
