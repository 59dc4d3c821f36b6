"""A term that a scene does not name costs nothing: not an instruction a step, not a byte a particle, no stage.

One `bench` of all scenes, one behind the other, under valgrind, which counts the instructions of each scene's steps: the
same in each run, however busy the machine."""
import json
import os
import shutil
import subprocess

import command

FRAMES = 20  # a step each
# Of a step's instructions. libgomp allocates in each parallel region, and how the heap happens to lie makes that cheaper
# or dearer by 0.35 % of a step.
EQUAL = 0.005

BLOCK = "block: {min: [-0.5, 0], max: [0.5, 0.5]}"


def scene(more="", box="", particles="", fluid="", solver="", fluids=""):
    """800 particles in a plane: what costs nothing there costs nothing in three dimensions, whose start takes longer."""
    return f"""\
box: {{size: [1, 1]{box}}}
particles: {{spacing: 0.025, support: 2.6{particles}}}
fluids: {fluids or f"[{{fill: [{BLOCK}]{fluid}}}]"}
solver: {{step: {{dt: 0.001, substeps: 1, retries: 0}}{solver}}}
{more}
"""


VISCOUS = ", viscosity: 2"
WCSPH = ", method: wcsph, artificial_viscosity: 0"
TENSE = ", surface_tension: 0.1"

SCENES = {
    "mueller": scene(),
    "mueller off": scene(solver=", surface_tension: cohesion, delta_sph: 0, shifting: 0.2", fluid=", surface_tension: 0, viscosity: 0",
                         box=", slip: none, periodic: []", particles=", jitter: 0"),
    "empty lists": scene("solids: []\ndrains: []\nmotion: []"),
    "solid": scene("solids: [{sphere: {centre: [0, 0.7], radius: 0.1}}]"),
    "drain": scene("drains: [{ball: {centre: [0, 0.9], radius: 0.05}}]"),
    "emitter": scene(particles=", most: 1600", fluid=", emit: [{disk: {centre: [0, 0.9], direction: [0, -1], radius: 0.1}, speed: 1}]"),
    "cohesion": scene(fluid=TENSE, solver=", surface_tension: cohesion"),
    "colour field": scene(fluid=TENSE, solver=", surface_tension: colour_field"),
    "viscous": scene(fluid=VISCOUS),
    "viscous off": scene(fluid=VISCOUS + TENSE, solver=", surface_tension: none", box=", slip: free"),
    "viscous, no slip": scene(fluid=VISCOUS, box=", slip: none"),
    "viscous, two fluids": scene(fluids="""
  - {viscosity: 2, fill: [block: {min: [-0.5, 0], max: [0, 0.5]}]}
  - {viscosity: 1, fill: [block: {min: [0, 0], max: [0.5, 0.5]}]}"""),
    "wcsph": scene(solver=WCSPH),
    "wcsph off": scene(solver=WCSPH + ", surface_tension: colour_field, delta_sph: 0, shifting: 0, corrected_gradient: false, viscosity_form: radial",
                       fluid=", viscosity: 0", box=", slip: none, periodic: []"),
    "wcsph, artificial": scene(solver=", method: wcsph"),
    "wcsph, diffusion": scene(solver=WCSPH + ", delta_sph: 0.1"),
    "wcsph, viscous": scene(solver=WCSPH, fluid=VISCOUS),
    "wcsph, corrected": scene(solver=WCSPH + ", corrected_gradient: true"),
    "wcsph, shifting": scene(solver=WCSPH + ", shifting: 0.2"),
}
# Terms are named, and off: whose cost that is.
SAME = {"mueller off": "mueller", "empty lists": "mueller", "viscous off": "viscous", "wcsph off": "wcsph"}
# Terms are on: what costs less. The sentinel is not among them: its 0.3 to 0.6 % do not stand out from the heap's.
MORE = {"solid": "mueller", "drain": "mueller", "emitter": "mueller", "cohesion": "mueller", "colour field": "mueller", "viscous": "mueller",
        "viscous, no slip": "viscous", "viscous, two fluids": "viscous",
        "wcsph, artificial": "wcsph", "wcsph, diffusion": "wcsph", "wcsph, viscous": "wcsph", "wcsph, corrected": "wcsph",
        "wcsph, shifting": "wcsph"}
# Of these, those that need an array.
LARGER = set(MORE) - {"drain", "emitter", "viscous", "viscous, no slip", "wcsph, artificial", "wcsph, viscous"}


class Terms(command.CommandTest):
    def setUp(self):
        super().setUp()
        if not shutil.which("valgrind"):
            self.fail("valgrind is not installed: apt-get install valgrind")

    def bench(self):
        """Instructions of each scene's steps, and what bench says of it. The wait policy is set so that the program need not
        start itself anew for it."""
        names = [f"{k}.yaml" for k in range(len(SCENES))]
        for name, text in zip(names, SCENES.values()):
            self.write(name, text)
        # a file of counts behind each world's end
        done = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=world_substep", "--dump-after=world_destroy",
                               "--callgrind-out-file=counts", command.PROGRAM, "bench", *names, "--view", "none", "--frames",
                               str(FRAMES), "--threads", "1", "--json", "bench.json", "--quiet"],
                              cwd=self.folder, capture_output=True, text=True, timeout=250, check=False,
                              env={**os.environ, "OMP_WAIT_POLICY": "passive"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len([name for name in self.entries() if name.startswith("counts.")]), len(SCENES))
        totals = [next(int(line.split()[1]) for line in self.read(f"counts.{k + 1}").decode().splitlines()
                       if line.startswith("totals: ")) for k in range(len(SCENES))]
        return dict(zip(SCENES, totals)), dict(zip(SCENES, json.loads(self.read("bench.json"))))

    def test_terms_off_cost_nothing_and_terms_on_cost_something(self):
        costs, figures = self.bench()
        for name, cost in costs.items():
            print(f"{name}: {cost} instructions")
            self.assertEqual([stage["name"] for stage in figures[name]["stages"]], ["grid", "density", "force", "integrate"], name)
        size = {name: figures[name]["bytes_per_particle"] for name in SCENES}
        for name, plain in SAME.items():
            with self.subTest(name):
                self.assertLess(abs(costs[name] / costs[plain] - 1), EQUAL)
                self.assertEqual(size[name], size[plain])
        for name, less in MORE.items():
            with self.subTest(name):
                self.assertGreater(costs[name] / costs[less] - 1, EQUAL)
                self.assertEqual(size[name] > size[less], name in LARGER)


if __name__ == "__main__":
    command.main()
