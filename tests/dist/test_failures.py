"""What goes wrong on one rank of slosh-dist ends all, with a line that says it and whole snapshots; what only looks wrong, ranks
without particles, does not. And what bench and model say."""
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py

SLOSH, DIST, MPIRUN = (sys.argv.pop(1) for _ in range(3))
RANKS = dict(OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
             OMPI_MCA_mpi_yield_when_idle="1", OMPI_MCA_hwloc_base_binding_policy="none",
             OMPI_MCA_btl="self,vader", OMPI_MCA_pml="ob1",
             OMPI_MCA_odls_base_sigkill_timeout="0")  # s that mpirun gives the other ranks, twice
LONG = ["dam_break", "--particles", "500", "--every", "0.02", "--quiet", "--threads", "1"]


def columns(path):
    with h5py.File(path) as file:
        return [{name: sorted(zip(step["id"][:].tolist(), step[name][:].tolist())) for name in ("x", "velocity_0", "density")}
                for step in file.values()]


class Failures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder / "out.h5part"

    def start(self, ranks, *args):
        ran = subprocess.Popen([MPIRUN, "-n", str(ranks), DIST, *map(str, args)], env=os.environ | RANKS, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(ran.kill)
        return ran

    def end(self, ran):
        out, errors = ran.communicate(timeout=20)
        return ran.returncode, out, errors

    def ranks_of(self, ran):
        """Processes of a run whose file is begun; the first rank is the one that has it open."""
        until = time.monotonic() + 15
        while not (self.path.exists() and self.path.stat().st_size > 150000) and time.monotonic() < until:
            time.sleep(0.02)
        found = subprocess.run(["pgrep", "-P", str(ran.pid), "slosh-dist"], capture_output=True, text=True).stdout.split()
        return [int(pid) for pid in found]

    def ended(self, pids):
        until = time.monotonic() + 5
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
        subprocess.run([SLOSH, "run", *LONG, "--time", until, "-o", one], check=True, capture_output=True, timeout=30)
        self.assertTrue(columns(self.path) == columns(one), "other states than those of one process")

    def test_more_ranks_than_particles(self):
        few = ["dam_break", "--particles", "20", "--time", "0.05", "--every", "0.02", "--quiet", "--threads", "1"]
        code, _, errors = self.end(self.start(5, "run", *few, "-o", self.path))
        self.assertEqual(code, 0, errors)
        one = self.folder / "one.h5part"
        subprocess.run([SLOSH, "run", *few, "-o", one], check=True, capture_output=True, timeout=30)
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
        """As a full disk does: a write of the first rank fails."""
        ran = self.start(2, "run", *LONG, "--time", "1000", "-o", self.path)
        pids = self.ranks_of(ran)
        for pid in pids:
            resource.prlimit(pid, resource.RLIMIT_FSIZE, (self.path.stat().st_size,) * 2)
        code, _, errors = self.end(ran)
        self.assertNotEqual(code, 0)
        self.assertEqual(len([line for line in errors.splitlines() if "File too large" in line]), 1, errors)
        self.ended(pids)
        self.goes_on()

    def test_bench_and_model(self):
        files = []
        for ranks in (1, 2):
            files.append(self.folder / f"{ranks}.json")
            code, out, errors = self.end(self.start(ranks, "bench", "dam_break", "--particles", "1000", "--frames", "2", "--threads",
                                                    "1", "--json", files[-1]))
            self.assertEqual(code, 0, errors)
            self.assertIn("imbalance", out)
            run = json.loads(files[-1].read_text())
            self.assertEqual(sum(rank["owned"] for rank in run["rank"]), run["particles"])
            self.assertEqual([rank["ghosts"] > 0 and rank["sent"] > 0 and rank["messages"] >= 1 for rank in run["rank"]],
                             [ranks > 1] * ranks)
            parts = sum(run["mean"][name] for name in ("compute", "exchange", "balance", "wait"))
            self.assertLessEqual(parts, 1.01 * run["step"])
            self.assertGreater(parts, 0.5 * run["step"])
        said = subprocess.run([DIST, "model", *files], env=os.environ | RANKS, capture_output=True, text=True, timeout=20)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("PREDICTION", said.stdout)
        self.assertRegex(said.stdout, r"predicted +4096 +4096 +1e\+09 ")
        said = subprocess.run([DIST, "model", files[0]], env=os.environ | RANKS, capture_output=True, text=True, timeout=20)
        self.assertEqual((said.returncode, said.stdout), (2, ""))
        self.assertIn("more than one rank", said.stderr)


if __name__ == "__main__":
    unittest.main()
