"""`bench --micro`: each pass alone, beside what the machine could do, and how the figures hang together."""
import json
import subprocess

import command

FEW = ("--micro", "--frames", "2", "--particles", "500")


class Micro(command.CommandTest):
    def micro(self, *arguments):
        done = subprocess.run([command.PROGRAM, "bench", "scene.yaml", *arguments, "--json", "micro.json"], cwd=self.folder,
                              capture_output=True, text=True, timeout=command.PATIENCE, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(self.read("micro.json")), done.stdout

    def check_figures(self, result, figure):
        per_second = figure["particle_steps_per_second"]
        self.assertAlmostEqual(per_second * figure["ms"] / 1000 / result["particles"], 1, 6)
        self.assertGreater(figure["share"], 0, figure)
        bytes_a_particle = figure["bytes_per_particle"]
        self.assertGreaterEqual(bytes_a_particle, 12)
        if "pairs_per_second" in figure:
            neighbours = figure["pairs_per_second"] / per_second
            self.assertAlmostEqual(neighbours / result["neighbours_mean"], 1, 6)
            self.assertAlmostEqual(figure["flops_per_second"] / figure["pairs_per_second"] / figure["flops_per_pair"], 1, 6)
            self.assertAlmostEqual(figure["flops_per_second"] / result["fused"]["flops_per_second"] / figure["flops_share"], 1, 6)
            bytes_a_particle += neighbours * figure["bytes_per_pair"]
        self.assertAlmostEqual(figure["bytes_per_second"] / per_second / bytes_a_particle, 1, 6)

    def test_each_pass_of_each_method_beside_the_ceilings(self):
        results, said = self.micro(*FEW, "--time", "0.02", "--sweep", "method=mueller,wcsph")
        self.assertEqual([(r["method"], r["time"] > 0) for r in results],
                         [("mueller", False), ("mueller", True), ("wcsph", False), ("wcsph", True)])
        for result in results:
            self.assertGreater(min(result[kind]["flops_per_second"] for kind in ("fused", "multiply_add")), 0)
            sizes = [copy["bytes"] for copy in result["copy"]]
            self.assertEqual(sizes, sorted(sizes))
            self.assertGreater(sizes[-1], 100e6)
            names = [figure["name"] for figure in result["passes"]]
            self.assertEqual(names[:2], ["grid", "lists"])
            self.assertIn("force", names)
            for figure in result["passes"]:
                self.check_figures(result, figure)
                self.assertIn(figure["name"], said)
        walks = {f["name"] for f in results[0]["passes"] if "pairs_per_second" in f}
        self.assertEqual(walks, {"lists", "density", "force"})

    def test_terms_have_passes_and_a_price(self):
        (plain, _, _, more), _ = self.micro(*FEW, "--method", "wcsph", "--sweep", "solver.delta_sph=0,0.1", "--sweep", "solver.shifting=0,0.2")
        plain, more = ({f["name"]: f for f in result["passes"]} for result in (plain, more))
        self.assertEqual(set(more) - set(plain), {"slope", "shift"})
        for name in ("continuity", "force"):
            self.assertGreater(more[name]["flops_per_pair"], plain[name]["flops_per_pair"])
            self.assertGreater(more[name]["bytes_per_particle"], plain[name]["bytes_per_particle"])

    def test_counts_that_take_too_long_or_too_much_are_left_out_and_said(self):
        results, said = self.micro("--micro", "--frames", "1", "--seconds", "1e-3", "--sweep", "particles=500,100000,2000000000")
        self.assertEqual(["left_out" in result for result in results], [False, True, True])
        self.assertIn("use --seconds", results[1]["left_out"])
        self.assertIn("more than this machine can hold", results[2]["left_out"])
        for result in results[1:]:
            self.assertIn(result["left_out"], said)

    def test_a_time_that_is_not_reached_is_said(self):
        results, said = self.micro(*FEW, "--seconds", "1e-6", "--time", "0.5")
        self.assertLess(results[1]["time"], results[1]["time_asked"])
        self.assertIn("came before 0.5 s", said)

    def test_a_simulation_that_breaks_on_its_way_is_said(self):
        path = self.path("micro.json")
        code, _ = self.slosh("bench", "scene.yaml", *FEW, "--time", "1", "--set", "solver.step={dt: 0.2, substeps: 1, retries: 0}", "--json", path)
        first, second = json.loads(self.read("micro.json"))
        self.assertEqual((code, first["time"]), (1, 0))
        self.assertIn("blew up", second["left_out"])

    def test_what_it_does_not_measure_is_refused(self):
        for arguments, word in ((("--play",), "--play"), (("--table", "paper003-spheres"), "--table"), (("-o", "a.svg"), "--table"),
                                (("--sweep", "solver.cats=1"), "cats"), (("--backend", "compute"), "compute"),
                                (("--device", "file:a.rec"), "--device")):
            code, said = self.slosh("bench", *FEW, *arguments)
            self.assertEqual(code, 2, said)
            self.assertIn(word, said)


if __name__ == "__main__":
    command.main()
