#!/usr/bin/env python3
"""The comparison with other programs: its states are those that it says, its ratios are taken within a round, its bars can be
missed, and what was measured is not measured again."""
import contextlib
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench/peers"))

import forces  # noqa: E402
import measure  # noqa: E402
import peers  # noqa: E402
import states  # noqa: E402


class States(unittest.TestCase):
    def test_numbers_are_those_of_numpys_random_state(self):
        # numpy 1.24.2: r = RandomState(12345); r.random_sample(6); r.standard_normal(6)
        draws = states.Draws(12345)
        self.assertEqual([draws.uniform() for _ in range(6)],
                         [0.9296160928171479, 0.3163755545817859, 0.18391881167709445, 0.2045602785530397, 0.5677250290816866,
                          0.5955447029792516])
        self.assertEqual([draws.normal() for _ in range(6)],
                         [0.09290787674371767, 0.2817461528302025, 0.7690225676118387, 1.2464347363862822, 1.0071893575830049,
                          -1.2962211091122635])

    def test_cloud_has_no_overlaps(self):
        rows = states.cloud(2000)
        cells = {}
        for row in rows:
            cells.setdefault(tuple(int(x / 2e-3) for x in row[1:4]), []).append(row[1:4])
        near = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]
        for cell, places in cells.items():
            for one in places:
                for step in near:
                    for other in cells.get(tuple(a + b for a, b in zip(cell, step)), []):
                        if other is not one:
                            self.assertGreater(sum((a - b) ** 2 for a, b in zip(one, other)), 4e-6)

    def test_a_mirrored_tile_touches_its_image_as_the_wall_was_touched(self):
        row = [1, 0.0009, 0.01, 0.02, 0.001, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
        other = [2, 0.0719, 0.01, 0.02, 0.001, -1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
        rows = states.tiled([row, other], (0.072, 0.036), (2, 1))
        self.assertEqual([one[0] for one in rows], [1, 2, 3, 4])
        # The sphere that overlaps the wall x = 0.072 has its image as far behind the wall.
        self.assertAlmostEqual(rows[3][1] - 0.072, 0.072 - rows[1][1], delta=1e-15)
        self.assertEqual(rows[2][5:], [-1.0, 2.0, 3.0, 4.0, -5.0, -6.0])  # a mirror turns the spin along it round


class Laws(unittest.TestCase):
    def test_damping_of_a_hertz_contact_is_that_of_the_oscillator(self):
        # Tsuji's form: g = 0.06468 at e = 0.8, c = 2 g sqrt(S m*), S = 1.5 k_n
        self.assertAlmostEqual(forces.damping(0.8), 2 * 0.06468 * 1.5 ** 0.5, delta=2e-5)

    def test_the_restitution_found_gives_the_damping_asked_for(self):
        for number in (0.05, 0.1, 0.158):
            self.assertAlmostEqual(forces.tsuji_polynomial(forces.restitution_for(number)), number, delta=1e-12)


class Bars(unittest.TestCase):
    def table(self, granum, lammps, liggghts):
        class Rows:
            rows = {("triad", 1): 17.0}
        cell = ("packed", 20_000, 1)
        for program, speeds in (("granum", granum), ("lammps", lammps), ("liggghts", liggghts)):
            for round_, speed in enumerate(speeds, 1):
                Rows.rows[(program, *cell, round_)] = {"speed": speed}
        return peers.Table(Rows, [cell]), cell

    def test_ratios_are_taken_within_a_round_over_the_faster_of_two(self):
        # The machine was half as fast in the second round: medians of speeds alone would say 10 over 3.
        table, cell = self.table([20, 10, 24], [4, 2, 3], [3, 2.5, 4])
        ratio = table.ratio(cell, ("lammps", "liggghts"))
        self.assertEqual((ratio.median, ratio.low, ratio.high), (5, 4, 6))
        self.assertIsNone(table.ratio(cell, ("yade",)))

    def test_roofline_is_bandwidth_over_bytes(self):
        table, _ = self.table([20], [4], [3])
        self.assertAlmostEqual(table.roofline(), 17e9 / 690 / 1e6)

    def test_below_a_bar_is_a_miss(self):
        table, _ = self.table([15.9], [4], [3])
        lines, missed = measure.judged(list(table.bars()))
        self.assertEqual(missed, 1)
        self.assertIn("| at least 4 | **no** |", lines[2])
        self.assertIn("| at least 0.3333 | yes |", lines[3])

    def test_at_most_is_the_other_way_round(self):
        self.assertTrue(measure.Bar("", 900, 900, at_least=False).met())
        self.assertFalse(measure.Bar("", 901, 900, at_least=False).met())
        self.assertFalse(measure.Bar("", float("nan"), 900, at_least=False).met())


class Keeping(unittest.TestCase):
    @contextlib.contextmanager
    def somewhere(self):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            (place / "peer_granum").write_text("one build")
            (place / "peer_triad").write_text("")
            before, measure.WORK, measure.BUILD = (measure.WORK, measure.BUILD), place, place
            try:
                yield place
            finally:
                measure.WORK, measure.BUILD = before

    def test_goes_on_where_it_was_interrupted_and_starts_anew_after_a_change(self):
        with self.somewhere() as place:
            kept = measure.Kept("peers")
            kept.get(("granum", 1), lambda: 1.5)
            with open(kept.path, "a") as file:
                file.write('[["granum", 2], {"cut off')
            again = measure.Kept("peers")
            self.assertEqual(again.get(("granum", 1), self.fail), 1.5)
            self.assertEqual(again.get(("granum", 2), lambda: 2.5), 2.5)
            self.assertEqual(measure.Kept("peers").rows, {("granum", 1): 1.5, ("granum", 2): 2.5})
            (place / "peer_granum").write_text("another build")
            self.assertEqual(measure.Kept("peers").rows, {})


if __name__ == "__main__":
    unittest.main()
