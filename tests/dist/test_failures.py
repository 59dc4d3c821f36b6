"""What goes wrong on one rank of slosh-dist ends all, with a line that says it and whole snapshots; what only looks wrong, ranks
without particles, does not."""
import os
import resource
import signal
import subprocess
import time
import unittest

import h5py

from ranks import DIST, ENVIRONMENT, MPIRUN, PATIENCE, SLOSH, RanksCase

LONG = ["dam_break", "--particles", "500", "--every", "0.02", "--quiet", "--threads", "1"]


def columns(path):
    with h5py.File(path) as file:
        return [{name: sorted(zip(step["id"][:].tolist(), step[name][:].tolist())) for name in ("x", "velocity_0", "density")}
                for step in file.values()]


class Failures(RanksCase):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "out.h5part"

    def ranks_of(self, ran):
        """Processes of a run whose file is begun; the first rank is the one that has it open."""
        until = time.monotonic() + PATIENCE
        while not (self.path.exists() and self.path.stat().st_size > 150000) and time.monotonic() < until:
            time.sleep(0.02)
        found = subprocess.run(["pgrep", "-P", str(ran.pid), "slosh-dist"], capture_output=True, text=True).stdout.split()
        return [int(pid) for pid in found]

    def ended(self, pids):
        until = time.monotonic() + PATIENCE
        while any(os.path.exists(f"/proc/{pid}") for pid in pids) and time.monotonic() < until:
            time.sleep(0.02)
        self.assertEqual([pid for pid in pids if os.path.exists(f"/proc/{pid}")], [])

    def goes_on(self):
        """What is there is whole, and goes on to the bits of a run that nothing happened to."""
        with h5py.File(self.path) as file:
            until = f"{max(step.attrs['TimeValue'] for step in file.values()) + 0.05:.2f}"
        code, _, errors = self.end(self.start(2, "run", *LONG, "--time", until, "-o", self.path, "--resume"))
        self.assertEqual(code, 0, errors)
        one = self.folder / "one.h5part"
        subprocess.run([SLOSH, "run", *LONG, "--time", until, "-o", one], check=True, capture_output=True, timeout=PATIENCE)
        self.assertTrue(columns(self.path) == columns(one), "other states than those of one process")

    def test_a_scene_that_does_not_fit_is_refused_before_the_start(self):
        """By one rank in one line; with fewer particles it says what each needs."""
        for particles, fits in ((4e6, False), (2000, True)):
            ran = subprocess.run([MPIRUN, "-n", "2", "bash", "-c", 'ulimit -v 1200000; exec "$@"', "-", DIST, "run", "dam_break",
                                  "--particles", f"{particles:.0f}", "--time", "0.01", "--threads", "1", "-o", self.path],
                                 env=ENVIRONMENT, capture_output=True, text=True, timeout=PATIENCE)
            said = [line for line in ran.stderr.splitlines() if "GB" in line]
            self.assertEqual(len(said), 1, ran.stderr)
            self.assertRegex(said[0], r"GB of memory a rank, of 1.23 GB" if fits else
                             r"particles on 2 ranks need about 1.\d+ GB a rank, and one on .* may have 1.23 GB; use more machines")
            self.assertEqual((ran.returncode, self.path.exists()), (0, True) if fits else (2, False), ran.stderr)

    def test_more_ranks_than_particles(self):
        few = ["dam_break", "--particles", "20", "--time", "0.05", "--every", "0.02", "--quiet", "--threads", "1"]
        code, _, errors = self.end(self.start(5, "run", *few, "-o", self.path))
        self.assertEqual(code, 0, errors)
        one = self.folder / "one.h5part"
        subprocess.run([SLOSH, "run", *few, "-o", one], check=True, capture_output=True, timeout=PATIENCE)
        self.assertTrue(columns(self.path) == columns(one), "other states than those of one process")

    def test_a_rank_that_is_killed_ends_all(self):
        ran = self.start(3, "run", *LONG, "--time", "1000", "-o", self.path)
        pids = self.ranks_of(ran)
        self.assertEqual(len(pids), 3)
        os.kill(pids[-1], signal.SIGKILL)
        code, _, errors = self.end(ran)
        self.assertNotEqual(code, 0)
        self.assertIn("signal 9", errors)
        self.ended(pids)
        self.goes_on()

    def test_a_file_that_may_not_grow_ends_all(self):
        """As a full disk does: there is no room for a step, which is found before it is written. The limit leaves room for the step
        that is being written: a write that fails within HDF5 may leave the other rank waiting there."""
        ran = self.start(2, "run", *LONG, "--time", "1000", "-o", self.path)
        pids = self.ranks_of(ran)
        most = self.path.stat().st_size + (1 << 18)
        for pid in pids:
            resource.prlimit(pid, resource.RLIMIT_FSIZE, (most, most))
        code, _, errors = self.end(ran)
        self.assertNotEqual(code, 0)
        self.assertEqual(len([line for line in errors.splitlines() if "File too large" in line]), 1, errors)
        self.ended(pids)
        self.goes_on()


if __name__ == "__main__":
    unittest.main()
