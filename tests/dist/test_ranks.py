"""slosh-dist gives the bits of slosh run on 1, 2, 3 and 4 ranks: each method, a coarse level, a box that moves, solids, emitters and drains,
periodic sides, adaptive steps, a rank with hardly a particle, trouble that is gone back from, and runs that go on on other
ranks."""
import json
import subprocess
import unittest

import h5py
import numpy

from ranks import DIST, ENVIRONMENT, MPIRUN, PATIENCE, SLOSH, RanksCase


def states(path):
    """Of each step its time, its numbers, and its columns by id."""
    with h5py.File(path) as file:
        for k in range(len([name for name in file if name.startswith("Step#")])):
            step = file[f"Step#{k}"]
            order = numpy.argsort(step["id"][:])
            yield (step.attrs["TimeValue"], step.attrs["restart"][:].tobytes(),
                   {name: step[name][:][order].tobytes() for name in step})


class Ranks(RanksCase):
    def run_one(self, *args, name="one"):
        path = self.folder / f"{name}.h5part"
        subprocess.run([SLOSH, "run", *args, "-o", path, "--quiet", "--threads", "1"], check=True, capture_output=True, timeout=PATIENCE)
        return path

    def dist(self, ranks, *args, name="ranks"):
        path = self.folder / f"{name}.h5part"
        done = subprocess.run([MPIRUN, "-n", str(ranks), DIST, "run", *args, "-o", path, "--quiet", "--threads", "1"],
                              env=ENVIRONMENT, capture_output=True, text=True, timeout=PATIENCE)
        return path, done

    def check(self, *args, ranks=(3,), also=()):
        """`also`: options of the ranks alone."""
        one = list(states(self.run_one(*args)))
        self.assertGreater(len(one), 1)
        for count in ranks:
            path, done = self.dist(count, *args, *also)
            self.assertEqual(done.returncode, 0, done.stderr)
            with self.subTest(args=args, ranks=count):
                many = list(states(path))
                self.assertEqual(len(many), len(one))
                for step, (a, b) in enumerate(zip(one, many)):
                    self.assertEqual(a[0], b[0], f"time of step {step}")
                    self.assertEqual(sorted(a[2]), sorted(b[2]))
                    self.assertEqual([name for name in a[2] if a[2][name] != b[2][name]], [], f"columns of step {step}")
                    self.assertEqual(a[1], b[1], f"numbers of step {step}")

    def test_the_same_bits_on_1_to_4_ranks(self):
        """In a box that moves."""
        self.check("box_slosh", "--particles", "800", "--time", "0.2", "--every", "0.1", ranks=(1, 2, 3, 4))

    def test_shares_that_stay(self):
        """Where half of the ranks end with hardly a particle."""
        self.check("dam_break", "--particles", "300", "--time", "0.6", "--every", "0.3", ranks=(4,), also=("--balance", "off"))

    def test_methods(self):
        for method in ("wcsph", "dfsph", "pbf"):
            self.check("dam_break", "--method", method, "--particles", "500", "--time", "0.06", "--every", "0.03")

    def test_coarse_level(self):
        """In deep water that is heaved, where a coarse grid of all ranks corrects the pressure."""
        scene = self.folder / "deep.yaml"
        scene.write_text("""
box: {size: [0.5, 1.2]}
particles: {spacing: 0.025}
fluids:
  - {name: water, density: 1000, fill: [{block: {min: [-0.25, 0], max: [0.25, 1]}}]}
motion:
  - shake: {axis: [0, 1], amplitude: 0.05, frequency: 1.5}
solver: {method: dfsph, step: {mode: cfl}}
""")
        self.check(scene, "--time", "0.1", "--every", "0.05", ranks=(2, 3))

    def test_places_in_a_wide_box(self):
        """What rounding leaves of them goes with them, and a run that goes on on other ranks has it."""
        for method in ("wcsph", "pbf"):
            scene = ["dam_break_2d", "--set", "box.size=[4, 0.9]", "--method", method, "--particles", "400", "--every", "0.05"]
            one = self.run_one(*scene, "--time", "0.1")
            self.assertEqual(self.dist(2, *scene, "--time", "0.05")[1].returncode, 0)
            path, done = self.dist(3, *scene, "--time", "0.1", "--resume")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(list(states(path)), list(states(one)))
            self.assertIn("remainder_0", list(states(path))[-1][2])

    def test_passes_behind_the_kick(self):
        """A shift that carries velocity reads that of ghosts as the kick left it."""
        self.check("box_slosh", "--method", "wcsph", "--set", "solver.shifting=0.2",
                   "--set", "solver.corrected_gradient=true", "--particles", "400", "--time", "0.04", "--every", "0.02",
                   ranks=(3,))

    def test_solids_and_adaptive_steps(self):
        self.check("paddle", "--particles", "800", "--time", "0.05", "--every", "0.02", "--set", "solver.step.mode=cfl",
                   "--backend", "cpu")

    def test_fluid_that_comes_and_goes(self):
        self.check("fountain", "--set", "particles.spacing=0.02", "--time", "0.4", "--every", "0.2", "--backend", "cpu")

    def test_ids_beyond_32_bits(self):
        """A run of which 2^33 particles have come and gone goes on as if they had not, but for the ids."""
        scene = ["fountain", "--set", "particles.spacing=0.02", "--every", "0.2", "--backend", "cpu"]
        whole = list(states(self.run_one(*scene, "--time", "0.4", name="whole")))
        for name in ("one", "ranks"):
            with h5py.File(self.run_one(*scene, "--time", "0.2", name=name), "r+") as file:
                step = file["Step#1"]
                restart = step.attrs["restart"]
                restart[5:7] += 2 ** 33  # emitted, drained
                step.attrs["restart"] = restart
                step["id"][...] = step["id"][:] + 2 ** 33
        one = list(states(self.run_one(*scene, "--time", "0.4", "--resume")))
        path, done = self.dist(2, *scene, "--time", "0.4", "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(list(states(path)), one)
        ids = [numpy.frombuffer(run[2][2].pop("id"), "i8") for run in (whole, one)]
        self.assertEqual((ids[0] + 2 ** 33).tolist(), ids[1].tolist())
        self.assertEqual(whole[2][2], one[2][2])

    def test_periodic_sides_and_few_particles(self):
        self.check("poiseuille", "--particles", "200", "--time", "0.02", "--every", "0.01", "--backend", "cpu", ranks=(4,))

    def test_going_back_and_going_on(self):
        """A step that is too long: the sentinel halves it on all ranks. Two ranks begin a run, three end it."""
        scene = ["dam_break", "--particles", "300", "--every", "0.1", "--set", "solver.step.substeps=2"]
        one = self.run_one(*scene, "--time", "0.4")
        path, done = self.dist(2, *scene, "--time", "0.2")
        self.assertIn("1/2 of the step", done.stderr)
        path, done = self.dist(3, *scene, "--time", "0.4", "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([state[:2] for state in states(path)], [state[:2] for state in states(one)])
        self.assertEqual(list(states(path)), list(states(one)))

    def test_probes_and_json(self):
        """A table of probes byte by byte, gone on with on other ranks; of the summary all but times and looks at all particles."""
        table, scene = {}, ["impact", "--particles", "400", "--every", "0.2", "--backend", "cpu"]
        for name in ("one", "ranks"):
            table[name] = ["--probes", self.folder / f"{name}.csv", "--json", self.folder / f"{name}.json"]
        self.run_one(*scene, "--time", "0.6", *table["one"])
        for ranks, more in ((2, ["--time", "0.2"]), (3, ["--time", "0.6", "--resume"])):
            _, done = self.dist(ranks, *scene, *more, *table["ranks"])
            self.assertEqual(done.returncode, 0, done.stderr)
        one, ranks = ((self.folder / f"{name}.csv").read_text() for name in ("one", "ranks"))
        self.assertTrue(any(row.split(",")[1] not in ("", "0") for row in one.splitlines()[2:]), "nothing hits the wall")
        self.assertEqual(one, ranks)
        one, ranks = (json.loads((self.folder / f"{name}.json").read_text()) for name in ("one", "ranks"))
        self.assertEqual(ranks.pop("ranks"), 3)
        for name in ("output", "wall_seconds", "real_time_factor", "step_seconds", "compression", "limits", "probes"):
            one.pop(name), ranks.pop(name, None)  # limits and probes: of what was gone on with alone
        self.assertEqual(one, ranks)

    def test_solids_that_float_and_forces(self):
        """Each rank moves them by what all ranks sum up; the tables byte by byte."""
        for scene in (["ducks", "--set", "particles.spacing=0.03"], ["impact", "--particles", "300"]):
            table = {name: self.folder / f"{name}.forces.csv" for name in ("one", "ranks")}
            args = [*scene, "--backend", "cpu", "--time", "0.06", "--every", "0.03"]
            one = list(states(self.run_one(*args, "--forces", table["one"])))
            path, done = self.dist(3, *args, "--forces", table["ranks"])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(table["one"].read_text(), table["ranks"].read_text())
            self.assertTrue(list(states(path)) == one, scene)

    def test_a_file_that_cannot_be(self):
        """No question of how it was asked: the exit code of slosh run."""
        for option in "--forces", "--json":
            path, done = self.dist(2, "dam_break", "--time", "0.01", option, self.folder / "none" / "a.csv")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertFalse(path.exists())

    def test_what_befalls_the_fluid_is_told(self):
        """Once, in the words of slosh run: it loses volume, it is faster than sound, emitters wait."""
        scene = self.folder / "pour.yaml"
        scene.write_text("box: {size: [1, 1, 1]}\nparticles: {spacing: 0.1, most: 420}\n"
                         "fluids: [{fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.4, 0.5]}}],\n"
                         "  emit: [{disk: {centre: [0, 0.7, 0], direction: [0, -1, 0], radius: 0.15}, speed: 2.5}]}]\n"
                         "solver: {sound_speed: 3, step: {dt: 0.004, substeps: 1}}\n")
        args, told = [scene, "--time", "0.3", "--every", "0.15"], []
        for name, ran in (("one", lambda *more: subprocess.run(
                [SLOSH, "run", *args, "-o", self.folder / "one.h5part", "--quiet", "--threads", "1", *more], check=True,
                capture_output=True, text=True, timeout=PATIENCE)), ("ranks", lambda *more: self.dist(3, *args, *more)[1])):
            figures = self.folder / f"{name}.json"
            lines = [line for line in ran("--json", figures).stderr.splitlines() if line.startswith("t = ")]
            found = json.loads(figures.read_text())
            mean = found.get("compression", {}).pop("mean", None)
            told.append((lines, found.get("outcome_words"), found.get("compression"), mean))
        self.assertEqual([word in " ".join(told[0][0]) for word in ("squeezed", "too fast", "no more come")], [True] * 3, told)
        self.assertEqual(told[0][:3], told[1][:3])
        self.assertAlmostEqual(told[0][3], told[1][3])

    def test_what_is_not_there_is_refused(self):
        path, done = self.dist(2, "dam_break", "--time", "0.01", "--device", "hand.jsonl")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(len([line for line in done.stderr.splitlines() if "--device" in line]), 1, done.stderr)
        self.assertFalse(path.exists())

    def test_tension_that_pushes_bodies_is_said(self):
        """Once, by several ranks, of fluid that has tension."""
        scene = ["cases/drop", "--particles", "300", "--time", "0.01", "--every", "0.01"]
        for ranks, more, lines in (2, [], 1), (1, [], 0), (2, ["--set", "fluids[0].surface_tension=0"], 0):
            path, done = self.dist(ranks, *scene, *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len([line for line in done.stderr.splitlines() if "curvature: on several ranks" in line]), lines,
                             done.stderr)

    def test_output_that_nobody_gets(self):
        for streams, why in (">&-", "Bad file descriptor"), (">/dev/full", "No space left on device"):
            done = subprocess.run(["sh", "-c", f'exec "$@" {streams}', "sh", DIST, "help"], env=ENVIRONMENT, capture_output=True,
                                  text=True, timeout=PATIENCE)
            self.assertEqual((done.returncode, done.stderr), (1, f"slosh-dist: standard output: {why}\n"))


if __name__ == "__main__":
    unittest.main()
