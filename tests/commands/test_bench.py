"""`bench` and `info`: what they print is what ran, and adds up."""
import json
import math
import os
import re
import subprocess

import command
import svg_labels

SCENE = 'scene.yaml'

STAGES_SIM = ["grid", "density", "force", "integrate"]
FIELDS = ["scene", "backend", "method", "view", "threads", "simd", "renderer", "size", "processor", "compiler", "options",
          "particles", "troubles", "lost", "time", "neighbours_mean", "dt",
          "dt_substep", "substeps", "frames", "stages", "sim_ms", "upload_ms", "render_ms", "frame_ms",
          "particle_steps_per_second", "real_time_factor", "bytes_per_particle", "outcome"]


class Case(command.CommandTest):
    def slosh_out(self, *arguments, code=0):
        done = subprocess.run([command.PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True,
                              timeout=command.PATIENCE, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done


class BenchTest(Case):
    def bench(self, *arguments, code=0):
        path = os.path.join(self.folder, "bench.json")
        self.slosh_out("bench", SCENE, "--json", path, "--frames", "8", *arguments, code=code)
        with open(path, encoding="utf-8") as file:
            return json.load(file)

    def check_stages(self, result):
        self.assertEqual(list(result), FIELDS + ["gl"])
        self.assertIsNone(result["gl"]["substep"])
        self.assertEqual(set(result["gl"]["picture"]), {"calls", "dispatches", "waits", "readbacks"})
        self.assertTrue(50 < result["gl"]["picture"]["calls"] < 150, result["gl"])
        self.assertAlmostEqual(sum(stage["share"] for stage in result["stages"]), 1, places=6)
        self.assertEqual({stage["clock"] for stage in result["stages"] if stage["part"] == "render"}, {"finish"})
        self.assertEqual([s["name"] for s in result["stages"] if s["part"] == "sim"], STAGES_SIM)
        self.assertEqual([s["name"] for s in result["stages"] if s["part"] == "upload"], ["upload"])
        self.assertEqual(result["view"], "spheres")


class Bench(BenchTest):
    def test_it_begins_where_it_is_told(self):
        (result,) = self.bench('--view', 'none', '--time', '0.2')
        self.assertAlmostEqual(result['time'], 0.2 + 3 * 0.004, 6)

    def test_stages_have_shares_of_the_frame(self):
        (result,) = self.bench("--clock", "finish", "--size", "64x64", "--frames", "3")
        self.check_stages(result)
        for stage in result["stages"]:
            self.assertTrue(0 < stage["share"] < 1 and stage["median_ms"] > 0, stage)
        self.assertEqual((result["size"], result["frames"]), ([64, 64], 3))

    def test_view_none_draws_nothing(self):
        (result,) = self.bench("--view", "none")
        self.assertEqual([s["name"] for s in result["stages"]], STAGES_SIM)
        self.assertIsNone(result["renderer"])
        self.assertAlmostEqual(result["dt"], result["dt_substep"] * result["substeps"], places=9)
        self.assertGreater(result["particle_steps_per_second"], 0)

    def test_splat_tells_coverage_and_fragments(self):
        done = self.slosh_out("bench", SCENE, "--json", "b.json", "--frames", "2", "--size", "160x120",
                              "--view", "splat", "--set", "view.legend=false")
        (result,) = json.loads(self.read("b.json"))
        self.assertEqual(list(result), FIELDS + ["gl", "coverage"])
        self.assertTrue(0.1 < result["coverage"] < 1, result["coverage"])
        fragments = {stage["name"]: stage["fragments"] for stage in result["stages"] if "fragments" in stage}
        self.assertEqual(list(fragments), ["visibility", "blend"])
        self.assertGreater(min(fragments.values()), 1)
        self.assertIn(f"coverage {100 * result['coverage']:.1f} % of the picture", done.stdout)

    def test_query_clock_is_named(self):
        (result,) = self.bench("--clock", "gl", "--size", "64x64")
        self.assertEqual({s["clock"] for s in result["stages"] if s["part"] == "render"}, {"gl"})
        programs = {program["name"]: program for program in result["gl"]["programs"]}
        self.assertEqual(programs["spheres point"]["runs"], 1)
        self.assertTrue(all(p["runs"] > 0 and p["ms"] >= 0 and p["before_ms"] >= 0 for p in programs.values()), programs)
        self.assertGreater(sum(p["ms"] + p["before_ms"] for p in programs.values()), 0)
        (result,) = self.bench("--size", "64x64", "--clock", "finish")
        self.assertIsNone(result["gl"]["programs"])

    def test_sweep_is_the_product(self):
        results = self.bench("--view", "none", "--sweep", "particles=500,1000", "--sweep", "threads=1,2")
        self.assertEqual([r["threads"] for r in results], [1, 2, 1, 2])
        self.assertEqual(results[1]["swept"], "particles=500, threads=2")
        self.assertEqual(results[2]["swept"], "particles=1000, threads=1")
        self.assertLess(results[0]["particles"], results[2]["particles"])
        for result, wanted in zip(results, [500, 500, 1000, 1000]):
            self.assertLess(abs(result["particles"] / wanted - 1), 0.2)  # few particles: few spacings fit

    def test_a_mistake_in_a_sweep_shows_before_anything_runs(self):
        path = os.path.join(self.folder, "never.json")
        done = self.slosh_out("bench", SCENE, "--json", path, "--sweep", "threads=1,-3", "--view", "none", code=2)
        self.assertEqual(done.stdout, "")
        self.assertFalse(os.path.exists(path))

    def test_a_sweep_goes_on_behind_what_blows_up(self):
        """A row with its kind, its time and its words, in terminal, table and JSON; the others are measured."""
        words = ["bench", SCENE, "--view", "none", "--frames", "8", "--json", "b.json", "--sweep", "solver.step.dt=0.004,0.9,0.002"]
        done = self.slosh_out(*words)
        first, broken, last = json.loads(self.read("b.json"))
        self.assertEqual([r["outcome"] for r in (first, last)], ["holds", "holds"])
        self.assertIn(broken["outcome"], ["blown up", "noisy"])
        self.assertGreater(broken["outcome_time"], 0)
        self.assertIn(broken["outcome_words"], broken["error"])
        self.assertEqual((broken["swept"], "frame_ms" in broken), ("solver.step.dt=0.9", False))
        said = f"{broken['outcome']} at t = {broken['outcome_time']:.4g} s: {broken['outcome_words']}"
        self.assertIn(f"mueller on cpu, solver.step.dt=0.9: {said}", done.stdout)
        self.assertIn(f"solver.step.dt=0.9: {broken['error']}", done.stderr)
        self.assertIn("1 of 3 cases failed", done.stderr)
        # a solver that may not leave anything
        self.slosh_out(*words[:-2], "--method", "dfsph", "--set", "solver.iterations=2", "--sweep", "solver.tolerance=0,0.0005")
        stuck, calm = json.loads(self.read("b.json"))
        self.assertEqual((stuck["outcome"], calm["outcome"]), ("does not converge", "holds"))
        self.assertIn(stuck["outcome_words"], stuck["error"])
        # all of a sweep, or a scene alone: nothing was measured
        for wrong in (["--sweep", "solver.step.dt=0.9,0.8"], ["--set", "solver.step.dt=0.9"]):
            self.slosh_out(*words[:-2], *wrong, code=1)
            self.assertEqual({"blown up", "noisy"} | {r["outcome"] for r in json.loads(self.read("b.json"))}, {"blown up", "noisy"})

    def test_table(self):
        done = self.slosh_out("bench", SCENE, "--frames", "4", "--view", "none", code=0)
        for word in STAGES_SIM + ["particle-steps/s", "real-time factor", "neighbours"]:
            self.assertIn(word, done.stdout)
        done = self.slosh_out("bench", SCENE, "--frames", "4", "--view", "none", "--quiet", code=0)
        self.assertEqual(done.stdout + done.stderr, "")

    def test_unwritable_json_is_found_at_once(self):
        done = self.slosh_out("bench", SCENE, "--view", "none", "--json", "/no/such/folder/b.json", code=1)
        self.assertIn("/no/such/folder", done.stderr)


class Charts(Case):
    def chart(self, *arguments):
        self.slosh_out('bench', '-o', 'chart.svg', '--size', '64x64', '--quiet', *arguments)
        chart = self.read('chart.svg').decode()
        self.assertEqual(svg_labels.faults(chart), [])
        return [label[0] for label in svg_labels.labels(chart)]

    def test_a_chart_of_the_stages(self):
        """A bar for each case, with all that tells them apart, and a legend that leaves out no time."""
        self.write('a_second.yaml', self.read(SCENE))
        words = self.chart(SCENE, 'a_second.yaml', '--frames', '2', '--sweep', 'solver.step.substeps=1,2', '--sweep', 'threads=1,2')
        for word, count in (('a_second', 4), ('scene', 4), ('mueller, cpu', 8), ('spheres', 8), ('solver.step.substeps=2', 4), ('threads=1', 4),
                            ('500 particles', 8), ('time of a frame, ms', 1), ('all other stages', 1)):
            self.assertEqual(words.count(word), count, (word, words))
        words = self.chart(SCENE, '--frames', '1', '--view', 'none')
        for word in 'none drawn', 'density', 'force':
            self.assertEqual(words.count(word), 1, (word, words))

    def test_bars_of_a_table(self):
        words = self.chart('--table', 'paper003-voxelize', '--frames', '1', '--set', 'view.volume.method=slabs')
        for word, count in (('slabs', 2), ('1024', 1), ('8192', 1), ('voxelize', 1), ('slice', 1)):
            self.assertEqual(words.count(word), count, (word, words))


class Tables(Case):
    def test_a_published_table_beside_its_figures(self):
        done = self.slosh_out('bench', '--table', 'paper003-spheres', '--view', 'spheres', '--frames', '1', '--size', '64x64', '-o', 'chart.svg',
                              '--json', 'table.json')
        self.assertEqual(len(re.findall('a spacing of .* gives 1024', done.stderr)), 1, done.stderr)  # of three cases
        rows = [line.split() for line in done.stdout.splitlines() if line[:9].strip().isdigit()]
        published = {(row[0], row[3]): row for row in rows if row[4] == 'published'}
        self.assertEqual(len(published), 8)
        self.assertEqual([published['8192', 'GPU,'][k] for k in (5, 8)], ['5.800', '60.000'])
        self.assertIn('GeForce 9800M GS', done.stdout)
        results = json.loads(self.read('table.json'))
        measured = [row for row in rows if row[4] != 'published']
        self.assertEqual([row[3] for row in measured], [r['backend'] for r in results])
        self.assertEqual({(r['backend'], r['substeps']) for r in results} & {('cpu', 1), ('compute', 1)},
                         {('cpu', 1), ('compute', 1)})
        for row, r in zip(measured, results):
            self.assertAlmostEqual(float(row[4]), sum(s['median_ms'] for s in r['stages'] if s['part'] == 'sim'), 2)
            self.assertAlmostEqual(float(row[7]), sum(s['median_ms'] for s in r['stages'] if s['part'] != 'sim'), 2)
        chart = self.read('chart.svg').decode()
        self.assertTrue(chart.rstrip().endswith('</svg>'))
        self.assertEqual(svg_labels.faults(chart), [])
        for words in ['CPU, published', 'compute, spheres', 'particles']:
            self.assertIn(words, chart)

    def test_points_of_transparent_surfaces_beside_the_papers(self):
        sphere = '[{of: sphere, level: 0.3, opacity: 0.5}]'
        done = self.slosh_out('bench', '--table', 'paper001', '--particles', '2000', '--size', '128x128', '--frames', '1', '--json', 't.json',
                              '--set', 'view.pbsr.layers=' + sphere, '--set', 'view.camera={from: [0, 0.5, 10], to: [0, 0.5, 0], fov: 5}')
        found = json.loads(self.read('t.json'))
        rows = {tuple(line.split()[:2]): line.split() for line in done.stdout.splitlines() if len(line.split()) > 4}
        self.assertEqual(len(found['sampling']), 14)
        for rate in found['sampling']:
            row = rows[rate['field'], rate['sampler']]
            self.assertAlmostEqual(float(row[4]) / (1e3 * rate['points'] / rate['ms']), 1, 2)
            asked = 200 if rate['field'] == 'particles' else 2000
            self.assertLess(abs(rate['points'] / asked - 1), 0.25, rate)
        self.assertIn('3 right, published         walk            6.3e+07    3.294e+06     1.91e+04', done.stdout)
        self.assertIn('GeForce GTX 580', done.stdout)
        # ln(1 / (1 - alpha)) points on as much as a pixel shows, all over the sphere, in each of 8 sets
        pixel = (20 * math.tan(math.radians(2.5)) / 128) ** 2
        wanted = 8 * math.log(2) * 4 * math.pi * 0.3 ** 2 / pixel
        self.assertLess(abs(found['rendering']['points'] / wanted - 1), 0.03)
        self.slosh_out('bench', '--table', 'paper001', '-o', 'c.svg', code=2)
        done = self.slosh_out('bench', '--table', 'paper001', '--particles', '2000', '--size', '64x64', '--frames', '1',
                              '--set', 'view.pbsr.layers=[{of: sphere, level: 0.3, opacity: 0}]', code=1)
        self.assertIn('no point of', done.stderr)

    def test_a_table_of_one_backend(self):
        done = self.slosh_out('bench', '--table', 'paper003-spheres', '--backend', 'cpu', '--view', 'spheres', '--frames', '1', '--size', '64x64')
        self.assertNotIn('compute', done.stdout)
        self.assertEqual(sum('spheres   cpu ' in line for line in done.stdout.splitlines()), 4)

    def rows_of(self, table, *more):
        """The published rows of a table, with its words, and the measured ones: each a list of words."""
        done = self.slosh_out('bench', '--table', table, '--backend', 'cpu', '--frames', '1', '--size', '64x48', '--json', 't.json', *more)
        rows = [line.split() for line in done.stdout.splitlines() if line[:9].strip().isdigit()]
        results = json.loads(self.read('t.json'))
        measured = [row for row in rows if 'published' not in row]
        self.assertEqual([(int(row[0]), row[2], row[3]) for row in measured], [(r['particles'], r['view'], r['backend']) for r in results])
        return [row for row in rows if 'published' in row], measured, results

    def test_passes_of_splatting(self):
        """A row for each animation of the paper, below its own; shares of three passes that sum to all, pictures a second."""
        published, measured, results = self.rows_of('paper002-passes', '--particles', '1500')
        self.assertEqual([row[0] for row in published], ['110000', '18000', '59000', '63000'])
        self.assertEqual([float(row[-2]) for row in published], [11, 47, 20, 20])
        self.assertEqual(len(measured), 4)
        for row, r, wanted in zip(measured, results, (1500, 1500, 750, 750)):  # the bowl fills all the time
            times = [next(s['median_ms'] for s in r['stages'] if s['name'] == name) for name in ('visibility', 'blend', 'shade')]
            for place, time in zip((4, 7, 10), times):
                self.assertAlmostEqual(float(row[place]), time, 2)
            self.assertAlmostEqual(sum(float(row[k]) for k in (5, 8, 11)), 100, delta=0.2)
            self.assertAlmostEqual(float(row[14]) * r['render_ms'] / 1000, 1, 1)
            self.assertLess(abs(r['particles'] / wanted - 1), 0.15)

    def test_raycasting(self):
        """The paper's numbers of particles on its processor and its graphics card, and beside them what is here."""
        published, measured, results = self.rows_of('paper003-raycast', '--set', 'view.volume.cells=16')
        self.assertEqual([row[0] for row in published], [n for n in ('1024', '2048', '4096', '8192') for _ in range(2)])
        self.assertEqual(len(measured), 4)
        for row, r, wanted in zip(measured, results, (1024, 2048, 4096, 8192)):
            self.assertLess(abs(r['particles'] / wanted - 1), 0.05)
            times = {s['name']: s['median_ms'] for s in r['stages']}
            for place, name in [(7, 'voxelize'), (10, 'raycast')]:
                self.assertAlmostEqual(float(row[place]), times[name], 2)

    def test_trouble_is_told(self):
        """Halved steps are counted as they ran; what blew up in its last frame is no measurement."""
        loud = ['--view', 'none', '--frames', '8', '--set', 'solver.sound_speed=450',
                '--set', 'fluids[0].start=rest', '--json', 'b.json']
        done = self.slosh_out('bench', SCENE, *loud)
        self.assertIn('the sentinel went back', done.stdout)
        (result,) = json.loads(self.read('b.json'))
        self.assertGreater(result['troubles'], 0)
        self.assertAlmostEqual(result['dt_substep'] * result['substeps'], result['dt'], 9)
        self.assertGreater(result['substeps'], 2)

    def test_what_is_wrong_is_said_before_anything_runs(self):
        for words, *arguments in [('paper003-spheres', '--table', 'paper9'), ('FILE.svg', '--table', 'paper003-spheres', '-o', 'a.gif'),
                                  ('its own scenes', SCENE, '--table', 'paper003-spheres'), ('--table', SCENE, '--micro', '-o', 'a.svg'),
                                  ('FILE.svg', SCENE, '-o', 'a.gif')]:
            done = self.slosh_out('bench', *arguments, code=2)
            self.assertIn(words, done.stderr)
        self.assertEqual(self.entries(), [])

    def test_without_gnuplot_there_is_no_chart(self):
        os.mkdir(self.path('bin'))
        done = subprocess.run([command.PROGRAM, 'bench', '--table', 'paper003-spheres', '--backend', 'cpu', '--view', 'spheres', '--frames', '1',
                               '--size', '64x64', '-o', 'chart.svg'],
                              cwd=self.folder, capture_output=True, text=True, timeout=command.PATIENCE, check=False,
                              env=os.environ | {'PATH': self.path('bin')})
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn('gnuplot', done.stderr)
        self.assertEqual(self.entries(), ['bin'])

    def test_a_damaged_reference_has_its_line(self):
        os.makedirs(self.path('scenes/reference'))
        self.write('scenes/reference/paper003-spheres.csv', '# by hand\nengine,particles\nCPU,1,2\n')
        done = self.slosh_out('bench', '--table', 'paper003-spheres', '--backend', 'cpu', '--view', 'spheres', '--frames', '1', '--size', '64x64', code=1)
        self.assertIn('paper003-spheres.csv:3: 3 cells; the columns are 2', done.stderr)


class Info(Case):
    def test_lists_and_settings(self):
        done = self.slosh_out("info", SCENE, "--set", "solver.sound_speed=12.5", code=0)
        for word in ["cpu", "mueller", "spheres", "renderer", "threads", "solver.sound_speed = 12.5 m/s"]:
            self.assertIn(word, done.stdout)

    def test_what_the_backends_have(self):
        """The table says what a run says: a scene with what a backend lacks is refused."""
        scenes = {'solids': ['pillar'], 'periodic sides': ['poiseuille'],
                  'surface tension': ['drop', '--set', 'fluids[0].surface_tension=0.07', '--set', 'solver.surface_tension=cohesion'],
                  'implicit viscosity': ['drop', '--set', 'solver.viscosity=implicit']}
        done = self.slosh_out('info', '--json', '-', '--quiet', code=0)
        rows = {row['name']: row for row in json.loads(done.stdout)['features']}
        self.assertTrue(all(row['cpu'] for row in rows.values()))
        self.assertTrue(rows['method mueller']['fragment'])
        for name, scene in scenes.items():
            for backend in 'compute', 'fragment':
                has = rows[name][backend]
                self.slosh_out('run', *scene, '--method', 'mueller', '--backend', backend, '--particles', '300', '--time', '0.001', '-o',
                               self.path('o.h5part'), '--quiet', code=0 if has else 2)
        self.assertEqual([rows[name]['fragment'] for name in scenes], [False] * len(scenes))
        self.assertEqual([rows[f'method {name}']['compute'] for name in ('wcsph', 'dfsph', 'pbf')], [True] * 3)

    def test_help_lists_what_works(self):
        done = self.slosh_out("help", code=0)
        for word in ["play", "render", "run", "bench", "replay", "export", "info", "validate", "chart", "stability", "fit", "devices"]:
            self.assertIn(word, done.stdout)


if __name__ == "__main__":
    command.main()
