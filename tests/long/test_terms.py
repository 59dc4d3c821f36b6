"""A term that a scene does not name costs nothing: not an instruction a step.

One `bench` of all scenes of tests/commands/test_term_sizes.py, one behind the other, under valgrind, which counts the
instructions of each scene's steps: the same in each run, however busy the machine."""
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "commands"))
import command
from test_term_sizes import FRAMES, MORE, SAME, SCENES, TermsTest

# Of a step's instructions. libgomp allocates in each parallel region, and how the heap happens to lie makes that cheaper
# or dearer by 0.35 % of a step.
EQUAL = 0.005


class Terms(TermsTest):
    def setUp(self):
        super().setUp()
        if not shutil.which("valgrind"):
            self.fail("valgrind is not installed: apt-get install valgrind")

    def counts(self):
        """Instructions of each scene's steps. The wait policy is set so that the program need not start itself anew for it."""
        # a file of counts behind each world's end
        done = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=world_substep", "--dump-after=world_destroy",
                               "--callgrind-out-file=counts", command.PROGRAM, *self.bench_words()],
                              cwd=self.folder, capture_output=True, text=True, timeout=command.PATIENCE, check=False,
                              env={**os.environ, "OMP_WAIT_POLICY": "passive"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len([name for name in self.entries() if name.startswith("counts.")]), len(SCENES))
        totals = [next(int(line.split()[1]) for line in self.read(f"counts.{k + 1}").decode().splitlines()
                       if line.startswith("totals: ")) for k in range(len(SCENES))]
        return dict(zip(SCENES, totals))

    def test_terms_off_cost_nothing_and_terms_on_cost_something(self):
        costs = self.counts()
        for name, cost in costs.items():
            print(f"{name}: {cost} instructions")
        for name, plain in SAME.items():
            with self.subTest(name):
                self.assertLess(abs(costs[name] / costs[plain] - 1), EQUAL)
        for name, less in MORE.items():
            with self.subTest(name):
                self.assertGreater(costs[name] / costs[less] - 1, EQUAL)


if __name__ == "__main__":
    command.main()
