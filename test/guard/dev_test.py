#!/usr/bin/env python3
"""What `./dev setup` says on machines it cannot help. The machine is played by stand-ins found first on the path."""
import os
import pathlib
import subprocess
import tempfile
import unittest

DEV = pathlib.Path(__file__).resolve().parents[2] / "dev"
NOTHING_INSTALLED = "exit 1"
EVERYTHING_INSTALLED = "printf installed"


class Setup(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.bin = pathlib.Path(self.folder.name)
        for tool in ("bash", "env", "dirname", "readlink", "nproc", "cat"):
            (self.bin / tool).symlink_to(next(p for p in map(pathlib.Path, ("/usr/bin", "/bin")) if (p / tool).exists()) / tool)
        self.stand_in("id", "echo 1000")
        self.stand_in("apt-get", f'echo "$@" >>{self.bin}/calls')

    def stand_in(self, name, script):
        file = self.bin / name
        file.write_text(f"#!/bin/bash\n{script}\n")
        file.chmod(0o755)

    def calls(self):
        file = self.bin / "calls"
        return file.read_text().splitlines() if file.exists() else []

    def setup_here(self):
        return subprocess.run([DEV, "setup"], env={**os.environ, "PATH": str(self.bin)}, capture_output=True, text=True)

    def test_everything_there_calls_no_package_manager(self):
        self.stand_in("dpkg-query", EVERYTHING_INSTALLED)
        self.assertEqual(self.setup_here().returncode, 0)
        self.assertEqual(self.calls(), [])

    def test_without_root_and_sudo_it_prints_the_line_to_run(self):
        self.stand_in("dpkg-query", NOTHING_INSTALLED)
        result = self.setup_here()
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("no root and no sudo", result.stderr)
        self.assertRegex(result.stderr, r"apt-get install -y --no-install-recommends cmake .*libhypre-dev")
        self.assertEqual(self.calls(), [])

    def test_without_network_it_says_so(self):
        self.stand_in("dpkg-query", NOTHING_INSTALLED)
        self.stand_in("id", "echo 0")
        self.stand_in("apt-get", "exit 100")
        result = self.setup_here()
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("no network", result.stderr)

    def test_as_root_it_updates_then_installs_only_what_is_missing(self):
        self.stand_in("dpkg-query", f'[ "${{@: -1}}" = ccache ] && ! grep -q install {self.bin}/calls && exit 1; printf installed')
        (self.bin / "grep").symlink_to("/usr/bin/grep")
        (self.bin / "calls").write_text("")
        self.stand_in("id", "echo 0")
        result = self.setup_here()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([call.split()[0] for call in self.calls()], ["update", "install"])
        self.assertEqual(self.calls()[1], "install -y --no-install-recommends ccache")

    def test_elsewhere_than_debian_it_names_the_packages(self):
        (self.bin / "apt-get").unlink()
        result = self.setup_here()
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("not a Debian system", result.stderr)
        self.assertIn("libhypre-dev", result.stderr)


if __name__ == "__main__":
    unittest.main()
