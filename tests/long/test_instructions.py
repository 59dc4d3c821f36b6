"""How many instructions each function takes in a step of a small scene, against tests/long/instructions.txt.

Valgrind counts them, in the functions of the program alone: what the C library and OpenMP's take depends on the processor
and on how the heap lies. The set of instructions is forced, the same on each processor that has it. A change that costs or
saves more than SLACK fails, so that what a step costs changes knowingly:

    python3 tests/long/test_instructions.py build/release/slosh --write

writes the file anew; its difference belongs into the commit. Another compiler has other counts: then it is skipped."""
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "commands"))
import command

FILE = pathlib.Path(__file__).with_name("instructions.txt")
SLACK = 0.03
LEAST = 0.01  # of a step: functions that take less are in the sum alone
STEPS = 10

# A thousand particles, out of order from the start on, that begin to fall.
SCENE = """\
box: {size: [1, 1, 1]}
particles: {spacing: 0.08, jitter: 0.2}
fluids:
  - viscosity: 1
    fill:
      - block: {min: [-0.5, 0, -0.5], max: [0.3, 0.7, 0.5]}
solver: {sound_speed: 20, step: {dt: 0.001, substeps: 1, retries: 0}}
"""
SCENES = {
    "mueller": ["solver.method=mueller"],
    "wcsph": ["solver.method=wcsph"],
    "wcsph+terms": ["solver.method=wcsph", "solver.delta_sph=0.1", "solver.shifting=0.2"],
}
SETS = ["baseline", "avx2"]
STEP = ["world_substep"]
WATCHES = ["energy_is_valid", "sentinel_mark", "sentinel_note_solves", "fluid_watch"]


def functions(profile, program):
    """Instructions of each function of the program itself, of a callgrind profile without compressed names."""
    found, place, name, inclusive = {}, "", "", False
    for line in profile.splitlines():
        key, _, value = line.partition("=")
        if key == "ob":
            place = value
        elif key == "fn":
            name = re.sub(r"\.(constprop|isra|part|lto_priv|_omp_fn|cold)\b.*", "", value)
        elif key == "calls":
            inclusive = True  # the next line is what the callee takes
        elif line and line[0] in "0123456789+-*":
            if not inclusive and place == program:
                found[name] = found.get(name, 0) + int(line.split()[1])
            inclusive = False
    return found


def inclusive(profile):
    """Instructions within each function and what it calls, of such a profile: those of all calls of it."""
    found, name = {}, None
    for line in profile.splitlines():
        key, _, value = line.partition("=")
        if key == "cfn":
            name = re.sub(r"\.(constprop|isra|part|lto_priv|cold)\b.*", "", value)
        elif name and line[:1] in tuple("0123456789+-*"):
            found[name] = found.get(name, 0) + int(line.split()[1])
            name = None
    return found


def rows(counts):
    """Of a step: the sum, and the functions that stand out, the dearest first."""
    total = sum(counts.values())
    large = {name: count / STEPS for name, count in counts.items() if count >= LEAST * total}
    return {"(all)": total / STEPS, **dict(sorted(large.items(), key=lambda row: -row[1]))}


def read_file():
    lines = FILE.read_text().splitlines()
    built = next((line.removeprefix("# built: ") for line in lines if line.startswith("# built: ")), "")
    kept = {}
    for scene, set_name, function, count in (line.split() for line in lines if line and line[0] != "#"):
        kept.setdefault((scene, set_name), {})[function] = float(count)
    return built, kept


def write_file(built, found):
    text = ["# Instructions a step: scene, set, function, count. Written by test_instructions.py, which says how.",
            f"# built: {built}"]
    text += [f"{scene} {set_name} {function} {count:.0f}" for (scene, set_name), table in found.items()
             for function, count in table.items()]
    FILE.write_text("\n".join(text) + "\n")


def differences(kept, now):
    """What has become dearer or cheaper, and what is new or gone; a function near LEAST may come and go."""
    said = []
    for function in {**kept, **now}:
        if function in kept and function in now:
            change = now[function] / kept[function] - 1
            if abs(change) > SLACK:
                said.append(f"{function}: {100 * change:+.1f} %, {kept[function]:.0f} to {now[function]:.0f}")
        else:
            count, whole = (kept, kept["(all)"]) if function in kept else (now, now["(all)"])
            if count[function] > 2 * LEAST * whole:
                said.append(f"{function}: {'gone' if function in kept else 'new'}, {count[function]:.0f}")
    return said


class Instructions(command.CommandTest):
    def setUp(self):
        super().setUp()
        if not shutil.which("valgrind"):
            self.fail("valgrind is not installed: apt-get install valgrind")
        self.write("scene.yaml", SCENE)

    def built(self):
        code, said = self.slosh("bench", "scene.yaml", "--frames", "1", "--view", "none", "--quiet", "--json", "b.json")
        self.assertEqual(code, 0, said)
        (result,) = json.loads(self.read("b.json"))
        return f"{result['compiler']}, {result['options']}"

    def profile(self, scene, set_name):
        name = f"{scene}.{set_name}"
        program = os.path.realpath(command.PROGRAM)
        settings = [word for setting in SCENES[scene] for word in ("--set", setting)]
        arguments = ["valgrind", "--tool=callgrind", "--toggle-collect=world_substep", "--compress-strings=no",
                     "--compress-pos=no", f"--callgrind-out-file={name}.out", program, "run", "scene.yaml", "-o",
                     f"{name}.h5part", "--time", str(STEPS / 1000), "--every", "10", "--threads", "1", "--quiet", *settings]
        done = subprocess.run(arguments, cwd=self.folder, capture_output=True, text=True, timeout=command.PATIENCE, check=False,
                              env={**os.environ, "OMP_WAIT_POLICY": "passive", "SLOSH_SIMD": set_name})
        self.assertEqual(done.returncode, 0, done.stderr)
        return rows(functions(self.read(f"{name}.out").decode(), program))

    def counted(self, set_name, seconds):
        """Instructions within the steps and within the watches, with what they call, of a run so long."""
        name = f"watch.{set_name}.{seconds}"
        done = subprocess.run(["valgrind", "--tool=callgrind", "--compress-strings=no", "--compress-pos=no",
                               f"--callgrind-out-file={name}.out", command.PROGRAM, "run", "scene.yaml", "-o", f"{name}.h5part",
                               "--time", str(seconds), "--every", "10", "--threads", "1", "--quiet", "--set", "solver.method=mueller",
                               "--set", "solver.step={dt: 0.004, substeps: 4}"],
                              cwd=self.folder, capture_output=True, text=True, timeout=command.PATIENCE, check=False,
                              env={**os.environ, "OMP_WAIT_POLICY": "passive", "SLOSH_SIMD": set_name})
        self.assertEqual(done.returncode, 0, done.stderr)
        taken = inclusive(self.read(f"{name}.out").decode())
        return [sum(taken.get(name, 0) for name in names) for names in (STEP, WATCHES)]

    def test_what_the_watches_take(self):
        """All looks of the sentinel and the fluid's watch, over a hundred steps of the cheapest method, four a frame: less than 1 % of
        them. With wide instructions the steps are three times cheaper and the looks, which copy ids of 64 bits, are not: 1.6 %, over
        the bar of 1 %."""
        flags = pathlib.Path("/proc/cpuinfo").read_text().split()
        for set_name, most in (("baseline", 0.01), ("avx2", 0.019)):
            if set_name not in ("baseline", *flags):
                continue
            with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
                (begun, watched), (steps, watches) = pool.map(lambda seconds, name=set_name: self.counted(name, seconds), (0.11, 0.21))
            with self.subTest(set_name):
                share = (watches - watched) / (steps - begun)
                self.assertLess(share, most)
                self.assertGreater(share, most / 10)  # they look at all

    def measure(self):
        """Of each scene with each set that this processor has."""
        flags = pathlib.Path("/proc/cpuinfo").read_text().split()
        keys = [(scene, set_name) for scene in SCENES for set_name in SETS if set_name == "baseline" or set_name in flags]
        with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
            return dict(zip(keys, pool.map(lambda key: self.profile(*key), keys)))

    def test_a_step_takes_as_many_as_the_file_says(self):
        built, kept = read_file()
        if built != self.built():
            self.skipTest(f"the file is of {built}, this program of {self.built()}")
        for key, now in self.measure().items():
            with self.subTest(" ".join(key)):
                self.assertIn("(all)", kept.get(key, {}))
                self.assertEqual(differences(kept[key], now), [], "if it is meant: --write, see the top of this test")

    def test_what_counts_as_a_difference(self):
        kept = {"(all)": 1000.0, "force": 500.0, "small": 15.0}
        self.assertEqual(differences(kept, {"(all)": 1029.0, "force": 486.0}), [])
        self.assertEqual(len(differences(kept, {"(all)": 1031.0, "force": 484.0})), 2)
        self.assertEqual(len(differences(kept, {"(all)": 1000.0, "small": 15.0, "push": 500.0})), 2)

    def write_anew(self):
        write_file(self.built(), self.measure())


if __name__ == "__main__":
    if "--write" in sys.argv:
        command.PROGRAM = os.path.abspath(sys.argv[1])
        sys.exit(not command.unittest.TextTestRunner().run(Instructions("write_anew")).wasSuccessful())
    command.main()
