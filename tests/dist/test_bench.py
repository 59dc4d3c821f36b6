"""What slosh-dist bench measures, and what is made of it: shares that follow the load, the model of cost."""
import json
import pathlib
import sys
import unittest

from ranks import RanksCase

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "commands"))
import svg_labels


class Bench(RanksCase):
    def bench(self, name, ranks, *args):
        path = self.folder / f"{name}.json"
        out = self.works(ranks, "bench", "dam_break", "--threads", "1", "--json", path, *args)
        self.assertIn("imbalance", out)
        return path, json.loads(path.read_text())

    def test_parts_of_a_step_and_the_model(self):
        files = []
        for ranks in (1, 2):
            path, run = self.bench(f"{ranks}", ranks, "--particles", "1000", "--frames", "2")
            files.append(path)
            self.assertEqual(sum(rank["owned"] for rank in run["rank"]), run["particles"])
            self.assertEqual([rank["ghosts"] > 0 and rank["sent"] > 0 and rank["messages"] >= 1 for rank in run["rank"]],
                             [ranks > 1] * ranks)
            parts = sum(run["mean"][name] for name in ("compute", "exchange", "balance", "wait"))
            self.assertLessEqual(parts, 1.01 * run["step"])
            self.assertGreater(run["mean"]["compute"], 0)  # processor time: beside other work little of the step's
            self.assertIn(run["processor"], open("/proc/cpuinfo").read())
            self.assertTrue(run["host"])
        code, out, errors = self.alone("model", *files)
        self.assertEqual(code, 0, errors)
        self.assertIn("PREDICTION", out)
        self.assertRegex(out, r"predicted +4096 +4096 +1e\+09 ")
        code, out, errors = self.alone("model", files[0])
        self.assertEqual((code, out), (2, ""))
        self.assertIn("more than one rank", errors)
        missing = self.folder / "missing.json"
        code, out, errors = self.alone("scaling", missing)
        self.assertEqual((code, out), (2, ""))
        self.assertTrue(errors.startswith(f"unable to open {missing}: "), errors)

    def test_scaling(self):
        files, rates = [], {}
        for ranks, particles in ((1, 1000), (2, 1000), (1, 500)):
            path, run = self.bench(f"{ranks}.{particles}", ranks, "--particles", particles, "--frames", 2)
            files.append(path)
            rates[path.name] = run["particles"] / run["step"]
        chart, figures = self.folder / "scaling.svg", self.folder / "scaling.out.json"
        code, out, errors = self.alone("scaling", *files, "-o", chart, "--json", figures)
        self.assertEqual(code, 0, errors)
        strong, weak = json.loads(figures.read_text())["series"]
        self.assertEqual([strong["scaling"], weak["scaling"]], ["strong", "weak"])
        for series in (strong, weak):
            one, two = series["runs"]
            self.assertEqual([one["ranks"], two["ranks"]], [1, 2])
            gain = rates["2.1000.json"] / rates["1.1000.json" if series is strong else "1.500.json"]
            self.assertAlmostEqual(two["speedup"], gain)
            self.assertAlmostEqual(two["efficiency"], gain * one["cores"] / two["cores"])
            self.assertIn(f"{two['speedup']:.2f}", out)
        picture = chart.read_text()
        for words in ("strong scaling", "weak scaling", "exchange"):
            self.assertIn(words, picture)
        self.assertEqual(svg_labels.faults(picture), [])
        code, out, errors = self.alone("scaling", files[0], files[0], "-o", self.folder / "none.svg")
        self.assertEqual((code, out), (2, ""))
        self.assertIn("no two runs", errors)
        self.assertFalse((self.folder / "none.svg").exists())

    def test_shares_follow_the_load(self):
        """Behind the dam's break, where half of the box has hardly a particle any more."""
        most = {}
        for balance in ("on", "off"):
            _, run = self.bench(balance, 2, "--particles", "1500", "--time", "0.7", "--frames", "3", "--balance", balance)
            self.assertEqual(run["balance"], balance == "on")
            most[balance] = max(rank["owned"] for rank in run["rank"]) / run["particles"]
            if balance == "off":
                self.assertEqual(run["mean"]["balances"], 0)
        self.assertLess(most["on"], 0.65)
        self.assertGreater(most["off"], 0.75)

    def test_what_is_no_choice_is_refused(self):
        for words in (["--balance", "perhaps"], ["--balance"]):
            code, out, errors = self.alone("bench", "dam_break", *words)
            self.assertEqual((code, out), (2, ""))
            self.assertIn("--balance takes on or off", errors)


if __name__ == "__main__":
    unittest.main()
