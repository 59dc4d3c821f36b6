"""A term that a scene does not name costs nothing: not a byte a particle, no stage, as `bench` tells; tests/long/test_terms.py
counts instructions."""
import json

import command

FRAMES = 20  # a step each

BLOCK = "block: {min: [-0.5, 0], max: [0.5, 0.5]}"


def scene(more="", box="", particles="", fluid="", solver="", fluids=""):
    """800 particles in a plane: what costs nothing there costs nothing in three dimensions, whose start takes longer."""
    return f"""\
box: {{size: [1, 1]{box}}}
particles: {{spacing: 0.025, support: 2.6{particles}}}
fluids: {fluids or f"[{{fill: [{BLOCK}]{fluid}}}]"}
solver: {{step: {{dt: 0.001, substeps: 1, retries: 0}}, {"" if "delta_sph" in solver else "delta_sph: 0, "}numerical_viscosity: 0{solver}}}
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
    "wcsph, artificial": scene(solver=", method: wcsph, artificial_viscosity: 0.05"),
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


class TermsTest(command.CommandTest):
    def bench_words(self):
        """All scenes, one behind the other."""
        names = [f"{k}.yaml" for k in range(len(SCENES))]
        for name, text in zip(names, SCENES.values()):
            self.write(name, text)
        return ["bench", *names, "--view", "none", "--frames", str(FRAMES), "--threads", "1", "--json", "bench.json", "--quiet"]


class Terms(TermsTest):
    def test_terms_off_need_nothing_and_terms_on_something(self):
        code, said = self.slosh(*self.bench_words())
        self.assertEqual(code, 0, said)
        figures = dict(zip(SCENES, json.loads(self.read("bench.json"))))
        for name, found in figures.items():
            self.assertEqual([stage["name"] for stage in found["stages"]], ["grid", "density", "force", "integrate"], name)
        size = {name: found["bytes_per_particle"] for name, found in figures.items()}
        for name, plain in SAME.items():
            with self.subTest(name):
                self.assertEqual(size[name], size[plain])
        for name, less in MORE.items():
            with self.subTest(name):
                self.assertEqual(size[name] > size[less], name in LARGER)


if __name__ == "__main__":
    command.main()
