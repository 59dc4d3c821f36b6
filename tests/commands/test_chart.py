"""slosh chart: draws, keeps its runs, does none of them twice."""
import json
import os
import signal
import subprocess

import command
import svg_labels

SMALL = ['--set', 'particles.spacing=0.2', '--time', '0.05', '--method', 'mueller']


class Chart(command.CommandTest):
    def run_it(self, *words):
        return subprocess.run([command.PROGRAM, 'chart', *words], cwd=self.folder, capture_output=True,
                              text=True, timeout=command.PATIENCE, check=False)

    def text(self, name):
        return self.read(name).decode()

    def test_a_scene_twice(self):
        self.write('tank.yaml', command.SCENE)
        first = self.run_it('tank.yaml', '-o', 'out.svg', *SMALL)
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertTrue('the finest run is the reference' in self.text('out.svg'))
        self.assertTrue('differ by 1e-6' in self.text('out.svg'))
        self.assertRegex(first.stderr, r'chart: +\d+ %  0:\d\d elapsed, about 0:\d\d left')
        self.assertEqual(svg_labels.faults(self.text('out.svg')), [])
        words = [label[0] for label in svg_labels.labels(self.text('out.svg'))]
        for word, count in (('error, %', 2), ('mueller, cpu, long steps: ', 1), ('mueller, cpu, fine steps: ', 1), ('best for its time: particles, step', 1)):
            self.assertEqual(sum(text.startswith(word) for text in words), count, (word, words))
        rows = self.text('out.csv')
        self.assertEqual(len(rows.splitlines()), 1 + 6 + 1 + 3)
        again = self.run_it('tank.yaml', '-o', 'out.svg', *SMALL)
        self.assertEqual(again.stdout, first.stdout)  # times and all: nothing ran again
        self.assertEqual(self.text('out.csv'), rows)
        # one of them lost: only that one runs again
        self.write('out.csv', ''.join(line + '\n' for line in rows.splitlines()[:-1]))
        self.assertEqual(self.run_it('tank.yaml', '-o', 'out.svg', *SMALL).returncode, 0)
        kept = self.text('out.csv').splitlines()
        self.assertEqual(len(kept), len(rows.splitlines()))
        self.assertEqual(kept[:-1], rows.splitlines()[:-1])

    def test_a_scene_that_changed_runs_again(self):
        tank = command.SCENE
        for text in (tank, tank.replace('sound_speed: 15', 'sound_speed: 20'), tank.replace('small', 'tiny')):
            self.write('tank.yaml', text)
            done = self.run_it('tank.yaml', '-o', 'out.svg', '--quiet', *SMALL)
            self.assertEqual((done.returncode, done.stdout), (0, ''), done.stderr)
        # the other sound has runs of its own; another title is the same flow
        self.assertEqual(len(self.text('out.csv').splitlines()), 1 + 2 * 10)

    def test_another_build_runs_again(self):
        """The same program but for its build id: a note, of which only that number is changed here."""
        with open(command.PROGRAM, 'rb') as file:
            program = bytearray(file.read())
        note = program.index(b'\x03\0\0\0GNU\0', program.index(b'\x14\0\0\0\x03\0\0\0GNU\0')) + 8
        program[note] ^= 1
        self.write('other', bytes(program))
        os.chmod(self.path('other'), 0o755)
        self.write('tank.yaml', command.SCENE)
        for name, runs in ((command.PROGRAM, 1), (self.path('other'), 2), (command.PROGRAM, 2)):
            done = subprocess.run([name, 'chart', 'tank.yaml', '-o', 'out.svg', '--quiet', *SMALL, '--time', '0.01'],
                                  cwd=self.folder, capture_output=True, text=True, timeout=command.PATIENCE, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(self.text('out.csv').splitlines()), 1 + runs * 10)

    def test_a_table_that_changed_runs_again(self):
        self.write('tank.yaml', command.SCENE.replace('0.5, 0.5]}\nsolver', '0.5, 0.5]}\n        below: heights.csv\n    velocity_table: flow.csv\nsolver'))
        heights, flow = 'x (m),height (m)\n-0.5,{}\n0.5,0.5\n', 'x (m),vx (m/s)\n-0.5,{}\n0.5,0\n'
        for high, fast, runs in ((0.5, 0.1, 1), (0.5, 0.1, 1), (0.4, 0.1, 2), (0.4, 0.2, 3)):
            self.write('heights.csv', heights.format(high))
            self.write('flow.csv', flow.format(fast))
            done = self.run_it('tank.yaml', '-o', 'out.svg', '--quiet', *SMALL, '--time', '0.01')
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(self.text('out.csv').splitlines()), 1 + runs * 10)

    def test_a_key_of_one_method_has_an_effect(self):
        words = ['scene.yaml', '-o', 'out.svg', '--set', 'solver.kernel=quintic', *SMALL]
        self.assertIn('solver.kernel has no effect', self.run_it(*words).stderr)
        both = self.run_it(*words[:-1], 'wcsph', '--sweep', 'method=mueller,wcsph')
        self.assertEqual(both.returncode, 0, both.stderr)
        self.assertNotIn('no effect', both.stderr)

    def test_json(self):
        done = self.run_it('scene.yaml', '-o', 'out.svg', '--json', 'out.json', *SMALL)
        self.assertEqual(done.returncode, 0, done.stderr)
        figures = json.loads(self.read('out.json'))
        self.assertEqual([run['role'] for run in figures['runs']], 6 * ['point'] + ['reference'] + 3 * ['floor'])
        self.assertTrue(0 < figures['floor'] < 1e-3)
        for run in figures['runs']:
            self.assertTrue(run['error'] >= 0 and run['seconds_per_second'] > 0 and run['particles'] > 0, run)
        self.assertTrue(any(run['front'] for run in figures['runs']))
        for steps, order in zip(('long', 'fine'), figures['orders']):
            errors = [run['error'] for run in figures['runs'][:6]][3 * (steps == 'fine'):][:3]
            falls = errors[0] > errors[1] > errors[2] > figures['floor']
            self.assertEqual((order['steps'], order['order'] is None, order['why'] is None), (steps, not falls, falls), figures)
            self.assertIn(f'mueller, cpu, {steps} steps: {"order " if falls else "no order"}', done.stdout)

    def test_runs_that_break_are_a_failure(self):
        # sound goes through many spacings a step
        small = [*SMALL, '--set', 'particles.spacing=0.1']
        done = self.run_it('scene.yaml', '-o', 'out.svg', '--json', 'out.json', '--set', 'solver.sound_speed=3000', *small)
        self.assertEqual(done.returncode, 1)
        self.assertIn('broke', done.stderr)
        self.assertRegex(done.stdout, r'  (blown up|noisy) at t = [0-9.e-]+ s: \w')
        self.assertRegex(done.stderr, r'mueller, cpu, \S+ \S+, spacing \S+ m: the simulation blew up at t = ')
        figures = json.loads(self.read('out.json'))
        broken = [run for run in figures['runs'] if run['seconds_per_second'] is None]
        self.assertGreater(len(broken), 3)
        for run in [run for run in broken if run['role'] != 'floor']:
            self.assertIn(f"  {run['outcome']} at t = {run['outcome_time']:.4g} s: {run['outcome_words']}\n", done.stdout)
        again = self.run_it('scene.yaml', '-o', 'out.svg', '--set', 'solver.sound_speed=3000', *small)
        self.assertEqual((again.returncode, again.stdout), (1, done.stdout))  # kept, as all others are
        self.assertTrue(all(run['error'] is None for run in figures['runs'] if run['role'] == 'point'))
        self.assertIsNone(figures['floor'])

    def test_interrupt_keeps_whole_rows(self):
        process = self.start('chart', 'scene.yaml', '-o', 'out.svg', '--quiet', *SMALL, '--time', '20')
        self.wait_for(lambda: 'out.csv' in self.entries(), process)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 130)
        self.assertIn('the same command goes on', process.stderr.read())
        self.assertEqual(self.entries(), ['out.csv'])
        for row in self.text('out.csv').splitlines()[1:]:
            self.assertEqual(len(row.replace(';', ' ').split(',')[-1].split(' ')), 160)

    def test_another_s_file_is_kept(self):
        self.write('out.csv', 'day,rain\n')
        done = self.run_it('scene.yaml', '-o', 'out.svg', *SMALL)
        self.assertEqual(done.returncode, 1)
        self.assertIn('no chart wrote it', done.stderr)
        self.assertEqual(self.text('out.csv'), 'day,rain\n')
        self.assertEqual(self.entries(), ['out.csv'])

    def test_metrics_are_the_scenes(self):
        self.write('tank.yaml', command.SCENE + 'metrics: [front, max_speed, height]\n')
        done = self.run_it('tank.yaml', '-o', 'out.svg', *SMALL)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('error: front, max_speed and height, rms over range', self.text('out.svg'))
        series = self.text('out.csv').splitlines()[1].split(',')[-1].split(';')
        self.assertEqual([len(series), len(series[0].split(' '))], [40, 3])
        # a change of the scene's file, and of what is compared, is another run
        rows = len(self.text('out.csv').splitlines())
        self.write('tank.yaml', command.SCENE + 'metrics: [front]\n')
        self.assertEqual(self.run_it('tank.yaml', '-o', 'out.svg', *SMALL).returncode, 0)
        self.assertEqual(len(self.text('out.csv').splitlines()), 2 * rows - 1)
        # but one of the view is none
        self.write('tank.yaml', command.SCENE + 'metrics: [front]\nview: {background: [0, 0, 0]}\n')
        done = self.run_it('tank.yaml', '-o', 'out.svg', *SMALL)
        self.assertIn('10 of 10 runs are in out.csv already', done.stderr)
        self.assertEqual(len(self.text('out.csv').splitlines()), 2 * rows - 1)

    def test_info_explains_the_metrics(self):
        said = subprocess.run([command.PROGRAM, 'info', 'scene.yaml'], cwd=self.folder, capture_output=True,
                              text=True, timeout=command.PATIENCE, check=True).stdout
        self.assertIn('kinetic_energy    of the motion in the box\'s frame (J)', said)
        self.assertIn('metrics = [centre_of_mass, kinetic_energy]', said)

    def test_backends(self):
        self.write('tank.yaml', command.SCENE)
        done = self.run_it('tank.yaml', '-o', 'out.svg', *SMALL)
        backends = {line.split(',')[3] for line in self.text('out.csv').splitlines()[1:]}
        if 'compute' not in backends:  # a software renderer, or none
            self.assertEqual(backends, {'cpu'})
            for text in (done.stderr, self.text('out.svg')):
                self.assertIn('backend compute, fragment left out: no ', text)
        done = self.run_it('tank.yaml', '-o', 'two.svg', '--sweep', 'backend=cpu,compute', *SMALL)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [line.split(',') for line in self.text('two.csv').splitlines()[1:]]
        self.assertEqual([r[3] for r in rows if r[1] == 'point'].count('compute'), 6)
        self.assertEqual({r[3] for r in rows if r[1] != 'point'}, {'cpu'})  # one reference for both
        cpu, gpu = ([float(r[9]) for r in rows if r[3] == b and r[1] == 'point'] for b in ('cpu', 'compute'))
        for a, b in zip(cpu, gpu):
            self.assertAlmostEqual(a, b, delta=1e-3)  # the same simulation
        self.assertIn('mueller, compute, long steps: ', self.text('two.svg'))

    def test_any_key_is_swept(self):
        """A series each combination; a key that one method does not read gives that method one; the spacings' own axis."""
        both = [*SMALL[:-1], 'wcsph', '--sweep', 'method=mueller,wcsph']
        done = self.run_it('scene.yaml', '-o', 'out.svg', '--json', 'out.json', *both, '--sweep', 'solver.delta_sph=0,0.1',
                           '--sweep', 'particles.spacing=0.1,0.2', '--sweep', 'particles.support=2.1,2.6')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('solver.delta_sph is not swept with method mueller: ', done.stderr)
        figures = json.loads(self.read('out.json'))
        points = [run for run in figures['runs'] if run['role'] == 'point']
        self.assertEqual([round(run['spacing'], 3) for run in points[:2]], [0.177, 0.1])  # 0.2 gives the fills no whole layers: that which ran
        series = {(run['method'], run['swept']) for run in points}
        self.assertEqual(len(points), 2 * 2 * len(series))
        self.assertEqual(series, {('mueller', 'support=2.1'), ('mueller', 'support=2.6'), ('wcsph', 'delta_sph=0 support=2.1'),
                                  ('wcsph', 'delta_sph=0 support=2.6'), ('wcsph', 'delta_sph=0.1 support=2.1'), ('wcsph', 'delta_sph=0.1 support=2.6')})
        self.assertEqual({run['spacing'] for run in figures['runs'] if run['role'] == 'reference'}, {0.05})
        for text in (done.stdout, self.text('out.svg')):
            for series_name in ('mueller, cpu, support=2.1', 'mueller, cpu, support=2.6', 'wcsph, cpu, delta_sph=0 support=2.1',
                                'wcsph, cpu, delta_sph=0.1 support=2.6'):  # the first and the last of the legend
                for steps in 'long', 'fine':
                    self.assertIn(f'{series_name}, {steps} steps: ', text)
        self.assertEqual(svg_labels.faults(self.text('out.svg')), [])
        again = self.run_it('scene.yaml', '-o', 'out.svg', *both, '--sweep', 'particles.support=2.1,2.6', '--sweep', 'particles.spacing=0.2,0.1')
        self.assertIn('are in out.csv already', again.stderr)

    def test_a_sweep_that_changes_nothing_is_refused(self):
        for words, sweep in (('changes nothing', 'solver.delta_sph=0,0.1'), ('changes no run', 'view.radius=1,2'),
                             ('--sweep particles.spacing', 'particles=100,200')):
            done = self.run_it('scene.yaml', '-o', 'out.svg', *SMALL, '--sweep', sweep)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)
        self.assertEqual(os.listdir(self.folder), ['scene.yaml'])

    def test_a_case(self):
        done = self.run_it('free_fall', '-o', 'out.png', '--method', 'mueller')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(os.path.getsize(os.path.join(self.folder, 'out.png')) > 1000)

    def test_what_is_wrong_is_said(self):
        self.assertEqual(self.run_it('dam_break', '-o', 'out.gif').returncode, 2)
        self.assertEqual(self.run_it('no_such_scene', '-o', 'out.svg').returncode, 2)
        self.assertEqual(self.run_it('dam_break', '-o', 'out.svg', '--sweep', 'view=none').returncode, 2)
        self.assertEqual(self.run_it('scene.yaml', '-o', 'out.svg', '--sweep', 'method=mueller,none').returncode, 2)
        self.assertEqual(self.run_it('dam_break', '-o', 'out.svg', '--time', '1').returncode, 2)
        self.assertIn("did you mean the case 'dam_break'?", self.run_it('dam_brake', '-o', 'out.svg').stderr)
        self.assertEqual(os.listdir(self.folder), ['scene.yaml'])


if __name__ == '__main__':
    command.main()
