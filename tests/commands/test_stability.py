"""slosh stability: finds the largest steps that hold, keeps its trials, says what an axis does not do."""
import json
import os
import signal
import subprocess
import time

import command
import svg_labels

# 50 particles in two dimensions: a trial takes some milliseconds.
TANK = """\
title: A small tank
box: {size: [1, 1]}
particles: {spacing: 0.1, support: 2.1}
fluids:
  - name: water
    density: 1000
    viscosity: 5
    fill:
      - block: {min: [-0.5, 0], max: [0.5, 0.5]}
solver:
  sound_speed: 15
  step: {mode: cfl}
"""

# Next to the limit chance decides whether it breaks.
DAM = """\
box: {size: [1, 1]}
particles: {spacing: 0.04}
fluids: [{name: water, fill: [{block: {min: [-0.5, 0], max: [0, 0.6]}}]}]
solver: {method: wcsph, sound_speed: 20}
"""

SMALL = ['--time', '0.3']
SOUND = ['--axis', 'solver.sound_speed=10:40:3']
BOTH = [*SOUND, '--axis', 'fluids[0].viscosity=1:4000:2']


class Stability(command.CommandTest):
    def setUp(self):
        super().setUp()
        self.write('tank.yaml', TANK)

    def run_it(self, *words, before=command.obey_interrupts, scene='tank.yaml', output='out.svg'):
        return subprocess.run([command.PROGRAM, 'stability', scene, '-o', output, *SMALL, *words], cwd=self.folder,
                              capture_output=True, text=True, timeout=command.PATIENCE, check=False, preexec_fn=before)

    def text(self, name):
        return self.read(name).decode()

    def wait_for_nobody(self):
        """Until no process of the command is left: those that make trials end with it."""
        def here():
            found = []
            for name in filter(str.isdigit, os.listdir('/proc')):
                try:
                    found += [name] if os.readlink(f'/proc/{name}/cwd') == self.folder else []
                except OSError:
                    pass
            return found
        end = time.monotonic() + command.PATIENCE
        while here():
            self.assertLess(time.monotonic(), end, here())
            time.sleep(0.02)

    def outputs(self):
        return {name for name in self.entries() if name != 'tank.yaml'}

    def test_a_map_twice(self):
        first = self.run_it(*BOTH, '--sweep', 'method=mueller,wcsph', '--json', 'out.json')
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertEqual(self.outputs(), {'out.svg', 'out.csv', 'out.json'})
        self.assertIn('mode fixed', first.stderr)
        self.assertRegex(first.stderr, r'stability: +\d+ %')
        self.assertEqual(svg_labels.faults(self.text('out.svg')), [])
        words = [label[0] for label in svg_labels.labels(self.text('out.svg'))]
        self.assertIn('wcsph, cpu: measured / theory', self.text('out.svg'))
        for word in ('viscosity of water, Pa s (fluids[0].viscosity)', 'sound speed, m/s (solver.sound_speed)', 'longest step', 'that holds, ms'):
            self.assertIn(word, words)
        note = ' '.join(words)
        for sign, said in (('*', '; *: from some start a longer one holds'), ('none', '; none: no step holds')):
            self.assertEqual(said in note, any(word.endswith(sign) and len(word) < 8 for word in words), (sign, words))
        self.assertEqual(self.run_it(*BOTH, output='one.svg').returncode, 0)  # half as wide
        self.assertEqual(svg_labels.faults(self.text('one.svg')), [])
        rows, drawn = self.text('out.csv'), self.text('out.svg')
        again = self.run_it(*BOTH, '--sweep', 'method=mueller,wcsph', '--threads', '1')
        self.assertEqual((again.stdout, self.text('out.csv')), (first.stdout, rows))  # nothing ran again
        os.remove(self.path('out.csv'))  # one process or several: the same trials, the same map
        alone = self.run_it(*BOTH, '--sweep', 'method=mueller,wcsph', '--threads', '1')
        self.assertEqual((alone.stdout, self.text('out.csv'), self.text('out.svg')), (first.stdout, rows, drawn))

    def test_json(self):
        done = self.run_it(*BOTH, '--sweep', 'method=mueller,wcsph', '--json', '-', '--quiet')
        self.assertEqual((done.returncode, done.stderr), (0, ''))
        figures = json.loads(done.stdout)
        self.assertEqual([axis['key'] for axis in figures['axes']], ['solver.sound_speed', 'fluids[0].viscosity'])
        self.assertEqual(figures['axes'][0]['values'], [10, 25, 40])
        self.assertEqual([(m['method'], m['backend']) for m in figures['maps']], [('mueller', 'cpu'), ('wcsph', 'cpu')])
        for found in figures['maps']:
            self.assertEqual([cell['at'] for cell in found['cells']], [[c, mu] for c in (10, 25, 40) for mu in (1, 4000)])
            for cell in found['cells']:
                c, mu, theory = *cell['at'], cell['theory']
                self.assertAlmostEqual(theory['courant'], 0.4 * 0.105 / c)
                self.assertTrue(0.7 < theory['sound'] * c / 0.21 < 1.05, theory)
                self.assertLess(theory['lattice'], min(theory['sound'], theory['friction']))
                self.assertAlmostEqual(cell['ratio'], cell['holds'] / theory['lattice'])
                self.assertTrue(0.5 <= cell['ratio'] <= 2, cell)
                self.assertTrue(all(above['step'] > cell['holds'] for above in cell['above']))
                self.assertNotEqual(cell['above'][0]['outcome'], 'holds')
                if mu == 4000:  # friction binds
                    self.assertLess(theory['friction'], theory['sound'])

    def test_samples_above_go_on_to_their_end(self):
        done = self.run_it('--axis', 'particles.support=2.2:3.4:3', '--set', 'fluids[0].viscosity=0', '--set', 'solver.numerical_viscosity=0', '--time', '3', '--json', '-', '--quiet')
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [line.split(',') for line in self.text('out.csv').splitlines()[1:]]
        finders = {(float(row[4]), row[10]): row[6] for row in rows}
        seen = set()
        for cell in json.loads(done.stdout)['maps'][0]['cells']:
            at = 'particles.support={:g}'.format(*cell['at'])
            for above in cell['above']:
                finder = next(who for (step, where), who in reversed(finders.items())
                              if where.split()[0] == at and who != 'nobody' and abs(step / above['step'] - 1) < 1e-6)
                self.assertEqual(finder, 'looks' if above['silent'] else 'sentinel')
                seen.add(finder)
        self.assertEqual(seen, {'looks', 'sentinel'})

    def test_what_hangs_on_chance_is_not_named(self):
        self.write('dam.yaml', DAM)
        done = self.run_it('--axis', 'solver.sound_speed=20:24:2', '--time', '1.5', '--json', '-', '--quiet', scene='dam.yaml')
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [line.split(',') for line in self.text('out.csv').splitlines()[1:]]
        for cell in json.loads(done.stdout)['maps'][0]['cells']:
            at = 'solver.sound_speed={:g}'.format(*cell['at'])
            tried = [(int(row[3]), row[10].removeprefix(at).strip(), row[7]) for row in rows if row[10].split()[0] == at]
            holds = next(int(row[3]) for row in rows if abs(float(row[4]) / cell['holds'] - 1) < 1e-6)
            self.assertEqual({outcome for rung, _, outcome in tried if rung <= holds}, {'holds'})
            self.assertNotEqual({outcome for rung, _, outcome in tried if rung == holds + 1}, {'holds'})
            for rung in (holds, holds - 1):  # from several starts
                self.assertEqual(len({start for other, start, _ in tried if other == rung}), 4)
            chance = any(rung > holds and outcome == 'holds' for rung, _, outcome in tried)
            self.assertEqual(cell['uneven'], chance)

    def test_kill_and_the_same_again(self):
        words = [*SOUND, '--time', '10', '--threads', '1']
        whole = self.run_it(*words, output='whole.svg')
        self.assertEqual(whole.returncode, 0, whole.stderr)
        for number, code in ((signal.SIGKILL, -9), (signal.SIGINT, 130)):
            for name in self.outputs() - {'whole.csv', 'whole.svg'}:
                os.remove(self.path(name))
            process = self.start('stability', 'tank.yaml', '-o', 'out.svg', '--quiet', '--json', 'out.json', *SMALL, *words)
            self.wait_for(lambda: 'out.csv' in self.entries(), process)
            process.send_signal(number)
            self.assertEqual(process.wait(60), code)
            self.wait_for_nobody()
            if number == signal.SIGINT:
                self.assertIn('the same command goes on', json.loads(self.read('out.json'))['error'])
            kept = self.text('out.csv').splitlines()
            self.assertTrue(1 < len(kept) < len(self.text('whole.csv').splitlines()))
            names = [{line.split(',')[0] for line in lines} for lines in (kept, self.text('whole.csv').splitlines())]
            self.assertLess(names[0], names[1])
            done = self.run_it(*words)
            self.assertEqual((done.returncode, done.stdout), (0, whole.stdout))
            self.assertEqual(self.text('out.csv'), self.text('whole.csv'))
            self.assertEqual(self.text('out.svg'), self.text('whole.svg'))

    def test_a_broken_row_is_made_again(self):
        first = self.run_it(*SOUND)
        rows = self.text('out.csv').splitlines()
        self.assertEqual(svg_labels.faults(self.text('out.svg')), [])
        for n, line in ((2, rows[2][:30]), (3, rows[3].replace('holds', 'holes').replace('noisy', 'nosy').replace('blown', 'b')),
                        (1, '')):
            self.write('out.csv', '\n'.join(rows[:n] + [line] + rows[n + 1:]) + '\n')
            done = self.run_it(*SOUND)
            self.assertEqual((done.returncode, done.stdout), (0, first.stdout))
            self.assertIn(f'out.csv:{n + 1}: this row is none that slosh stability writes', done.stderr)
            self.assertEqual(self.text('out.csv').splitlines(), rows)
        self.write('out.csv', 'key,role,method,backend,\n')
        done = self.run_it(*SOUND)
        self.assertEqual(done.returncode, 1)
        self.assertIn('no slosh stability wrote it', done.stderr)
        self.assertEqual(self.text('out.csv'), 'key,role,method,backend,\n')

    def test_two_maps_of_one_name_keep_each_others_trials(self):
        words = [*BOTH, '--time', '3', '--threads', '1']
        self.assertEqual(self.run_it(*SOUND, '--sweep', 'method=wcsph').returncode, 0)
        theirs = self.text('out.csv').splitlines()
        os.remove(self.path('out.csv'))
        process = self.start('stability', 'tank.yaml', '-o', 'out.svg', '--quiet', *SMALL, *words)
        self.wait_for(lambda: 'out.csv' in self.entries(), process)
        process.send_signal(signal.SIGSTOP)
        own = self.text('out.csv').splitlines()
        self.write('out.csv', '\n'.join(own + theirs[1:]) + '\n')
        process.send_signal(signal.SIGCONT)
        self.assertEqual(process.wait(60), 0, process.stderr.read())
        rows = self.text('out.csv').splitlines()
        self.assertGreater(len(rows), len(own) + len(theirs) - 1)
        self.assertLess(set(theirs), set(rows))

    def test_a_map_of_nothing_replaces_no_map(self):
        self.assertEqual(self.run_it(*SOUND).returncode, 0)
        drawn = self.text('out.svg')
        done = self.run_it(*SOUND, '--backend', 'compute', '--gpu', '15')
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn('no cell could be searched', done.stderr)
        self.assertEqual(self.text('out.svg'), drawn)

    def test_an_axis_that_changes_nothing(self):
        done = self.run_it('--axis', 'solver.delta_sph=0:0.1:2')
        self.assertEqual(done.returncode, 2)
        self.assertIn('--axis solver.delta_sph changes nothing: no method of the map reads it', done.stderr)
        done = self.run_it(*SOUND, '--sweep', 'method=mueller,dfsph')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('solver.sound_speed changes nothing with method dfsph: ', done.stderr)
        self.assertEqual(done.stderr.count('changes nothing'), 1)
        done = self.run_it('--axis', 'box.size[0]=1:2')
        self.assertEqual(done.returncode, 2)
        # the fluid is as wide whatever the jitter's grain: all cells are alike
        done = self.run_it('--axis', 'fluids[0].density=1000:1001:2', '--set', 'fluids[0].viscosity=0')
        self.assertIn('--axis fluids[0].density changes nothing: all cells along it have the same step', done.stderr)

    def test_what_never_and_what_always_holds(self):
        # its weight presses it to far more than its density
        done = self.run_it('--axis', 'solver.sound_speed=0.5:1:2')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('no step holds in any cell', done.stderr)
        self.assertRegex(done.stdout, r'holds at no step tried, down to \S+ ms: squeezed \(silent\), ')
        self.assertEqual(svg_labels.faults(self.text('out.svg')), [])
        done = self.run_it('--axis', 'solver.sound_speed=10:11:2', '--time', '0.02')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('every step that was tried holds', done.stderr)

    def test_what_is_wrong_is_said(self):
        for words, code, said in (
                (['--axis', 'solver.sound_sped=1:2'], 2, "did you mean 'solver.sound_speed'?"),
                (['--axis', 'solver.kernel=1:2'], 2, 'is no number'),
                (['--axis', 'solver.step.dt=0.001:0.01'], 2, 'the step is what is searched'),
                (['--axis', 'solver.sound_speed=20:10'], 2, 'write it as 10:20'),
                (['--axis', 'solver.sound_speed=10'], 2, 'takes two numbers a:b'),
                (['--axis', 'solver.sound_speed=10:b'], 2, 'takes two numbers a:b'),
                (['--axis', 'solver.sound_speed=10:20:99'], 2, '2 to 32 points'),
                (['--axis', 'solver.sound_speed'], 2, 'takes KEY=a:b'),
                (['--axis', 'solver.sound_speed=-5:20'], 2, '--axis solver.sound_speed=-5'),
                (['--axis', 'view.radius=1:2'], 2, 'changes nothing that is simulated'),
                ([*SOUND, *SOUND], 2, 'stands there twice'),
                ([*BOTH, '--axis', 'particles.spacing=0.1:0.2'], 2, '2 axes at most'),
                (['--sweep', 'particles.spacing=0.1,0.2'], 2, 'use --axis for particles.spacing'),
                (['--axis', 'particles.spacing=0.05:0.1:2', '--particles', '60'], 2, 'the axis is the spacing; leave --particles out'),
                ([*SOUND, '--sweep', 'method=mueller,mueller'], 2, 'method mueller on cpu twice'),
                (['--time', '0'], 2, '--time must be more than 0'),
                (['--json', 'no/such.json'], 1, 'no/such.json')):
            done = self.run_it(*words)
            self.assertEqual(done.returncode, code, (words, done.stderr))
            self.assertIn(said, done.stderr)
        self.assertEqual(self.run_it(output='out.gif').returncode, 2)
        done = self.run_it(*SOUND, output='no/out.svg')
        self.assertEqual(done.returncode, 1)
        self.assertIn('no/out.svg', done.stderr)
        self.assertEqual(self.outputs(), set())

    def test_a_file_that_cannot_grow(self):
        done = self.run_it(*BOTH, '--time', '2', '--json', 'out.json', before=command.limit_files(4096))
        self.assertEqual(done.returncode, 1)
        self.assertIn('out.csv: cannot be written (File too large)', done.stderr)
        self.assertLessEqual(self.outputs(), {'out.csv', 'out.json'})  # trials that the limit had room for
        self.assertIn('cannot be written', json.loads(self.read('out.json'))['error'])


if __name__ == '__main__':
    command.main()
