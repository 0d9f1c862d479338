#!/usr/bin/env python3
"""The checker of the floor plan finds what it is there to find: each test breaks a small tree in one way."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECKER = pathlib.Path(__file__).resolve().parents[2] / "tools/check_rooms.py"
PAGE = "# Plan\n<!-- floor plan: begin -->\n<!-- floor plan: end -->\n"


class Checker(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        self.write("ARCHITECTURE.md", PAGE)
        self.room("base", "granum_room(base)")
        self.room("par", "granum_room(par NEEDS base LIBRARIES MPI::MPI_CXX)")
        self.room("dem", "granum_room(dem NEEDS base par)")
        self.write("src/granum/dem/loop.cpp", '#include "granum/par/rank.hpp"\n#include <vector>\n#include <cmath>\n')

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def room(self, name, call):
        self.write(f"src/granum/{name}/CMakeLists.txt", call + "\n")

    def run_checker(self, *words):
        return subprocess.run([sys.executable, CHECKER, "--root", self.root, *words], capture_output=True, text=True)

    def refuses(self, what):
        self.run_checker("--write")
        result = self.run_checker()
        self.assertEqual(result.returncode, 1)
        self.assertIn(what, result.stderr)

    def test_a_tree_that_keeps_its_plan_passes_once_its_picture_is_drawn(self):
        self.assertEqual(self.run_checker("--write").returncode, 0)
        result = self.run_checker()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        page = (self.root / "ARCHITECTURE.md").read_text()
        self.assertIn("dem --> par", page)
        self.assertNotIn("dem --> base", page, "implied by dem --> par --> base")

    def test_a_stale_picture_is_an_error(self):
        result = self.run_checker()
        self.assertEqual(result.returncode, 1)
        self.assertIn("ARCHITECTURE.md", result.stderr)

    def test_a_cycle_is_named_with_its_path(self):
        self.room("par", "granum_room(par NEEDS dem)")
        self.refuses("cycle: dem -> par -> dem")

    def test_an_include_of_a_room_that_is_not_named_is_an_error(self):
        self.write("src/granum/par/rank.hpp", '#pragma once\n#include "granum/dem/loop.hpp"\n')
        self.refuses("src/granum/par/rank.hpp:2: room par may not include room dem")

    def test_an_external_library_outside_its_room_is_an_error(self):
        self.write("src/granum/dem/halo.cpp", "#include <mpi.h>\n")
        self.refuses("src/granum/dem/halo.cpp:1: <mpi.h> may be included in")

    def test_a_library_that_nobody_declared_is_an_error(self):
        self.write("src/granum/dem/halo.cpp", "#include <boost/asio.hpp>\n")
        self.refuses("<boost/asio.hpp> belongs to no library")

    def test_a_need_that_is_no_room_is_an_error(self):
        self.room("dem", "granum_room(dem NEEDS base gsa)")
        self.refuses("room dem needs gsa, which is no room")


if __name__ == "__main__":
    unittest.main()
