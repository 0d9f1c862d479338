#!/usr/bin/env python3
"""What is compiled for a newer processor must not leak into code for an older one.

The linker keeps one copy of every weak symbol (inline functions, templates) and may take it from any object. So the
objects of an instruction set may define weak symbols only where the name of that set is part of the type or namespace.
"""
import re
import subprocess
import sys


def strays(listing):
    """Weak symbols by object file that do not carry the name of their instruction set; (object, symbol) pairs."""
    out, name = [], None
    for line in listing.splitlines():
        if (found := re.match(r"kernel_(\w+)\.cpp\.o:$", line)) or line.endswith(".o:"):
            name = found[1] if found else None
        elif name and (symbol := re.match(r"[0-9a-f]+ [WVu] (.*)$", line)) and f"{name}_kernel" not in symbol[1]:
            out.append((name, symbol[1]))
    return out


def main():
    sample = "kernel_avx2.cpp.o:\n0000000000000000 W std::max(double, double)\nother.cpp.o:\n0000000000000000 W std::min()\n"
    assert strays(sample) == [("avx2", "std::max(double, double)")], "the checker does not see a stray symbol"
    listing = subprocess.run(["nm", "-C", sys.argv[1]], check=True, capture_output=True, text=True).stdout
    objects = set(re.findall(r"^kernel_(\w+)\.cpp\.o:$", listing, flags=re.M))
    assert objects == {"avx512", "avx2", "sse4"}, f"expected three instruction sets, found {sorted(objects)}"
    found = strays(listing)
    for name, symbol in found:
        print(f"kernel_{name}.cpp defines the weak symbol {symbol}, which older processors may be given")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
