"""A term that a scene does not name costs nothing: not an instruction a step, not a byte a particle, no stage.

Instructions are those that valgrind counts: the same in each run, however busy the machine. What 2 N steps take more
than N leaves the start out."""
import concurrent.futures
import json
import os
import re
import shutil
import subprocess

import command

STEPS = 40
# Of a step's instructions. libgomp allocates in each parallel region, and how the heap happens to lie makes that cheaper
# or dearer by 0.35 % of a step.
EQUAL = 0.005

# 300 particles in a plane: what costs nothing there costs nothing in three dimensions, whose start takes longer.
SCENE = """\
box: {size: [1, 1]}
particles: {spacing: 0.04, support: 2.6}
fluids:
  - fill:
      - block: {min: [-0.5, 0], max: [0.5, 0.5]}
solver: {step: {dt: 0.001, substeps: 1, retries: 0}}
"""
TWO = """\
box: {size: [1, 1]}
particles: {spacing: 0.04, support: 2.6}
fluids:
  - fill:
      - block: {min: [-0.5, 0], max: [0, 0.5]}
  - fill:
      - block: {min: [0, 0], max: [0.5, 0.5]}
solver: {step: {dt: 0.001, substeps: 1, retries: 0}}
"""

NOTHING = SCENE + "solids: []\ndrains: []\nmotion: []\n"
SOLID = SCENE + "solids: [{sphere: {centre: [0, 0.7], radius: 0.1}}]\n"
DRAIN = SCENE + "drains: [{ball: {centre: [0, 0.9], radius: 0.05}}]\n"
EMITTER = SCENE.replace("  - fill:", "  - emit: [{disk: {centre: [0, 0.9], direction: [0, -1], radius: 0.1}, speed: 1}]\n    fill:")

VISCOUS = ["fluids[0].viscosity=2"]
WCSPH = ["solver.method=wcsph", "solver.artificial_viscosity=0"]
TENSE = ["fluids[0].surface_tension=0.1"]

# Name: (scene, settings).
SCENES = {
    "mueller": (SCENE, []),
    "mueller off": (SCENE, ["solver.surface_tension=cohesion", "fluids[0].surface_tension=0", "fluids[0].viscosity=0",
                            "box.slip=none", "solver.delta_sph=0", "solver.shifting=0.2", "box.periodic=[]",
                            "particles.jitter=0"]),
    "empty lists": (NOTHING, []),
    "solid": (SOLID, []),
    "drain": (DRAIN, []),
    "emitter": (EMITTER, ["particles.most=600"]),
    "cohesion": (SCENE, TENSE + ["solver.surface_tension=cohesion"]),
    "colour field": (SCENE, TENSE + ["solver.surface_tension=colour_field"]),
    "viscous": (SCENE, VISCOUS),
    "viscous off": (SCENE, VISCOUS + TENSE + ["solver.surface_tension=none", "box.slip=free"]),
    "viscous, no slip": (SCENE, VISCOUS + ["box.slip=none"]),
    "viscous, two fluids": (TWO, VISCOUS + ["fluids[1].viscosity=1"]),
    "wcsph": (SCENE, WCSPH),
    "wcsph off": (SCENE, WCSPH + ["solver.surface_tension=colour_field", "fluids[0].viscosity=0", "box.slip=none",
                                  "solver.delta_sph=0", "solver.shifting=0", "box.periodic=[]", "solver.viscosity_form=radial"]),
    "wcsph, artificial": (SCENE, ["solver.method=wcsph"]),
    "wcsph, diffusion": (SCENE, WCSPH + ["solver.delta_sph=0.1"]),
    "wcsph, viscous": (SCENE, WCSPH + VISCOUS),
    "wcsph, shifting": (SCENE, WCSPH + ["solver.shifting=0.2"]),
}
# Terms are named, and off: whose cost that is.
SAME = {"mueller off": "mueller", "empty lists": "mueller", "viscous off": "viscous", "wcsph off": "wcsph"}
# Terms are on: what costs less. The sentinel is not among them: its 0.3 to 0.6 % do not stand out from the heap's.
MORE = {"solid": "mueller", "drain": "mueller", "emitter": "mueller", "cohesion": "mueller", "colour field": "mueller", "viscous": "mueller",
        "viscous, no slip": "viscous", "viscous, two fluids": "viscous",
        "wcsph, artificial": "wcsph", "wcsph, diffusion": "wcsph", "wcsph, viscous": "wcsph", "wcsph, shifting": "wcsph"}
# Of these, those that need an array.
LARGER = set(MORE) - {"drain", "emitter", "viscous", "viscous, no slip", "wcsph, artificial", "wcsph, viscous"}


def settings_of(settings):
    return [word for setting in settings for word in ("--set", setting)]


class Case(command.CommandTest):
    def scene(self, name, text):
        file = re.sub(r"\W+", "_", name) + ".yaml"
        self.write(file, text)
        return file


class Instructions(Case):
    def setUp(self):
        super().setUp()
        if not shutil.which("valgrind"):
            self.fail("valgrind is not installed: apt-get install valgrind")

    def count(self, path, settings, steps):
        """Of a whole run. The wait policy is set so that the program need not start itself anew for it."""
        arguments = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
                     command.PROGRAM, "run", path, "-o", f"{path}.{steps}.h5part", "--time", str(steps / 1000),
                     "--every", "10", "--threads", "1", "--quiet", *settings_of(settings)]
        done = subprocess.run(arguments, cwd=self.folder, capture_output=True, text=True, timeout=200, check=False,
                              env={**os.environ, "OMP_WAIT_POLICY": "passive"})
        found = re.search(r"I +refs: +([\d,]+)", done.stderr)
        self.assertTrue(done.returncode == 0 and found, done.stderr)
        return int(found.group(1).replace(",", ""))

    def costs(self):
        """Instructions a step of each scene."""
        paths = {name: self.scene(name, text) for name, (text, _) in SCENES.items()}
        with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
            runs = {(name, steps): pool.submit(self.count, paths[name], settings, steps)
                    for name, (_, settings) in SCENES.items() for steps in (STEPS, 2 * STEPS)}
        return {name: (runs[name, 2 * STEPS].result() - runs[name, STEPS].result()) / STEPS for name in SCENES}

    def test_terms_off_cost_nothing_and_terms_on_cost_something(self):
        costs = self.costs()
        for name, cost in costs.items():
            print(f"{name}: {cost:.0f} instructions a step")
        for name, plain in SAME.items():
            with self.subTest(name):
                self.assertLess(abs(costs[name] / costs[plain] - 1), EQUAL)
        for name, less in MORE.items():
            with self.subTest(name):
                self.assertGreater(costs[name] / costs[less] - 1, EQUAL)


class Memory(Case):
    """What `bench` says of them: bytes and stages."""

    def bench(self, name):
        text, settings = SCENES[name]
        code, said = self.slosh("bench", self.scene(name, text), "--view", "none", "--frames", "3", "--json",
                                "bench.json", "--quiet", *settings_of(settings))
        self.assertEqual(code, 0, said)
        (result,) = json.loads(self.read("bench.json"))
        return result["bytes_per_particle"], [stage["name"] for stage in result["stages"]]

    def test_terms_off_have_no_array_and_no_stage(self):
        found = {name: self.bench(name) for name in SCENES}
        for name, (_, stages) in found.items():
            self.assertEqual(stages, ["grid", "density", "force", "integrate"], name)
        for name, plain in SAME.items():
            self.assertEqual(found[name], found[plain], name)
        for name, less in MORE.items():
            self.assertEqual(found[name][0] > found[less][0], name in LARGER, name)


if __name__ == "__main__":
    command.main()
