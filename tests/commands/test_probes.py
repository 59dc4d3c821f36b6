"""slosh run --probes: a table a step, that goes on to the same bytes whatever ended a run."""
import csv
import json
import os
import signal

import h5py

import command
import svg_labels
from command import SCENE, CommandTest, limit_files

PROBES = """\
probes:
  - {name: floor, point: {at: [0, 0, 0]}, fields: [pressure, velocity], average: 0.02}
  - {name: level, height: {at: [0.5, 0, 0]}}
  - {name: rake, line: {from: [-0.5, 0, 0], to: [-0.5, 1, 0], count: 3}, fields: [density]}
"""
TIME, EVERY = '0.2', '0.004'


class ProbesTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write('scene.yaml', SCENE + PROBES)

    def go(self, *more, code=0, name='a.h5part', quiet=('--quiet',)):
        done, said = self.slosh('run', 'scene.yaml', '-o', name, '--time', TIME, '--every', EVERY, *quiet, *more)
        self.assertEqual(done, code, said)
        return said

    def rows(self, name):
        return list(csv.DictReader(self.read(name).decode().splitlines()))


class Probes(ProbesTest):
    def test_a_row_a_step(self):
        self.go('--probes', 'a.csv', '--json', 'a.json')
        rows = self.rows('a.csv')
        self.assertEqual(len(rows), 1 + 100)
        for k, row in enumerate(rows):
            self.assertAlmostEqual(float(row['time [s]']), 0.002 * k, 9)
        last = [float(row['floor.pressure [Pa]']) for row in rows[-10:]]
        self.assertAlmostEqual(sum(last) / 10 / float(rows[-1]['floor.pressure_mean [Pa]']), 1, 6)
        self.assertAlmostEqual(float(rows[0]['level.height [m]']), 0.5, delta=0.01)
        self.assertEqual(rows[-1]['rake_2.density [kg/m3]'], '')  # in the air
        with open(self.path('a.json')) as file:
            figures = json.load(file)['probes']
        self.assertEqual(list(figures)[0], 'floor.pressure')
        pressure = [float(row['floor.pressure [Pa]']) for row in rows]
        self.assertAlmostEqual(figures['floor.pressure']['mean'] / (sum(pressure) / 101), 1, 6)
        self.assertAlmostEqual(figures['floor.pressure']['max'] / max(pressure), 1, 6)
        self.assertEqual(figures['rake_2.density'], {'unit': 'kg/m3', 'rows': 0, 'mean': None, 'min': None, 'max': None})

    def test_forces_are_those_of_the_table(self):
        """A row a step whose means over a frame are the rows of --forces, together and alone."""
        self.write('scene.yaml', SCENE + 'probes:\n  - {name: tank, force: {}}\n  - {name: ball, force: {on: solid_0}}\n'
                   'solids: [{sphere: {centre: [0.2, 0.2, 0], radius: 0.15}}]\n')
        self.go('--probes', 'a.csv', '--forces', 'both.csv', '--json', 'a.json')
        self.go('--forces', 'alone.csv', name='b.h5part')
        self.go('--probes', 'b.csv', name='c.h5part')
        self.assertEqual(self.read('a.csv'), self.read('b.csv'))
        both, alone, steps = self.rows('both.csv'), self.rows('alone.csv'), self.rows('a.csv')
        self.assertEqual((len(both), len(alone), len(steps)), (50, 50, 101))
        self.assertEqual(steps[0]['tank.force_y [N]'], '')
        for k, (one, other) in enumerate(zip(both, alone)):
            for name, value in other.items():
                self.assertAlmostEqual(float(one[name]), float(value), delta=1e-6 * max(1, abs(float(value))))
            for probe, column in (('tank', 'box'), ('ball', 'solid_0')):
                for what, unit in (('force_y', 'N'), ('torque_z', 'N m')):
                    mean = sum(float(row[f'{probe}.{what} [{unit}]']) for row in steps[1 + 2 * k:3 + 2 * k]) / 2
                    self.assertAlmostEqual(float(other[f'{column}_{what}']), mean, delta=1e-4 * max(1, abs(mean)))
        with open(self.path('a.json')) as file:
            figures = json.load(file)['probes']
        self.assertEqual((figures['ball.torque_z']['unit'], figures['tank.force_y']['rows']), ('N m', 100))

    def test_they_change_nothing(self):
        """Equal bits with and without, and on any number of threads."""
        self.go('--probes', 'a.csv')
        self.go('--probes', 'b.csv', '--threads', '1', name='b.h5part')
        self.go(name='c.h5part')
        self.assertEqual(self.read('a.csv'), self.read('b.csv'))
        with h5py.File(self.path('a.h5part')) as one, h5py.File(self.path('c.h5part')) as other:
            self.assertEqual(len(one), len(other))
            for step, group in one.items():
                for name in group:
                    self.assertEqual(group[name][:].tobytes(), other[step][name][:].tobytes(), (step, name))

    def test_goes_on_to_the_same_bytes(self):
        self.go('--probes', 'whole.csv', name='whole.h5part')
        self.go('--time', '0.1', '--probes', 'a.csv')
        self.go('--resume', '--probes', 'a.csv')
        self.assertEqual(self.read('whole.csv'), self.read('a.csv'))
        os.remove(self.path('a.h5part'))
        self.go('--time', '0.1')
        said = self.go('--resume', '--probes', 'b.csv')
        self.assertIn('b.csv: there is no such table to go on with; it begins at t = 0.1 s', said)
        self.write('c.csv', b''.join(self.read('whole.csv').splitlines(True)[:20]))
        os.remove(self.path('a.h5part'))
        self.go('--time', '0.1')
        said = self.go('--resume', '--probes', 'c.csv')
        self.assertIn('c.csv: the table ends at t = 0.036 s; rows from there to 0.1 s are missing', said)

    def test_killed(self):
        """Early and late; other moments: tests/long/test_kills.py."""
        self.go('--probes', 'whole.csv', name='whole.h5part')
        for rows in (1, 60):
            code = self.stopped(signal.SIGKILL, self.has_lines('a.csv', rows), 'run', 'scene.yaml', '-o', 'a.h5part', '--time', TIME,
                                '--every', EVERY, '--quiet', '--probes', 'a.csv')
            self.assertEqual(code, -signal.SIGKILL)
            self.go('--resume', '--probes', 'a.csv')
            self.assertEqual(self.read('whole.csv'), self.read('a.csv'))
            os.remove(self.path('a.h5part'))
            os.remove(self.path('a.csv'))

    def test_trouble_leaves_each_time_once(self):
        """Rows of a frame that the sentinel took back are not there."""
        self.write('scene.yaml', (SCENE + PROBES).replace('dt: 0.004, substeps: 2', 'dt: 0.06, substeps: 4'))
        said = self.go('--probes', 'a.csv', '--set', 'solver.negative_pressure=true', '--time', '0.6')
        self.assertIn('back to', said)
        times = [float(row['time [s]']) for row in self.rows('a.csv')]
        self.assertEqual(times, sorted(set(times)))

    def test_a_plot(self):
        said = self.go('--probes', 'a.svg')
        self.assertEqual(said, '')
        picture = self.read('a.svg').decode()
        for word in ('floor.pressure_mean', 'level.height', 'rake_0.density', 'kg/m3', 'A small tank'):
            self.assertIn(word, picture)
        self.assertEqual(svg_labels.faults(picture), [])
        words = [label[0] for label in svg_labels.labels(picture)]
        self.assertTrue({'pressure, Pa', 'height, m'} <= set(words), words)
        self.assertEqual(words.count('time, s'), 1)
        self.assertEqual(len(self.rows('a.csv')), 101)

    def test_a_plot_of_many_curves_has_the_first(self):
        """gnuplot takes minutes over thousands."""
        self.write('scene.yaml', SCENE + 'probes:\n' + ''.join(
            f'  - {{name: l{k}, line: {{from: [-0.5, 0.1, {z}], to: [0.5, 0.1, {z}], count: 101}}, fields: [density]}}\n'
            for k, z in enumerate((-0.2, 0, 0.2))))
        said = self.go('--probes', 'a.svg', '--time', '0.004')
        self.assertEqual(said, 'a.svg: the first 200 curves of a unit are drawn; the table has the 103 others\n')
        picture = self.read('a.svg').decode()
        self.assertIn('and 291 more', picture)
        self.assertEqual(svg_labels.faults(picture), [])
        self.go('--probes', 'a.svg')  # it is of probes, and may be replaced

    def test_a_file_of_another_s_is_kept(self):
        """A table that no probes wrote is never replaced, the scene's own ones neither; one of probes is."""
        self.write('scene.yaml', (SCENE + PROBES).replace('0.5, 0.5]}\nsolver', '0.5, 0.5]}\n        below: heights.csv\nsolver'))
        heights = 'x (m),height (m)\n-0.5,0.4\n0.5,0.5\n'
        self.write('heights.csv', heights)
        for name in ('heights.csv', 'heights.svg'):
            said = self.go('--probes', name, code=2)
            self.assertIn("would replace the scene's table heights.csv; name another file", said)
            self.assertEqual(self.read('heights.csv').decode(), heights)
        self.write('other.csv', heights)
        for name in ('other.csv', 'other.svg'):
            said = self.go('--probes', name, code=1)
            self.assertIn('other.csv: is there already, and no probes wrote it; name another file', said)
            self.assertEqual(self.read('other.csv').decode(), heights)
        self.assertEqual(self.entries(), ['heights.csv', 'other.csv'])
        for name in ('own.svg', 'own.png'):
            self.write(name, 'mine')
            said = self.go('--probes', name, code=1)
            self.assertIn(f'{name}: is there already, and no probes drew it, whose table would be own.csv; name another file', said)
            self.assertEqual(self.read(name), b'mine')
            os.remove(self.path(name))
        self.write('a.csv', '')
        self.go('--probes', 'a.csv')
        self.assertEqual(len(self.rows('a.csv')), 101)
        self.go('--probes', 'a.csv', '--time', '0.1')
        self.assertEqual(len(self.rows('a.csv')), 51)

    def test_a_plot_that_cannot_be(self):
        """Without gnuplot nothing begins; without a number there is no plot; one that fails keeps the JSON."""
        os.mkdir(self.path('bin'))
        done = self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--probes', 'a.svg',
                          env={**os.environ, 'PATH': self.path('bin')})
        self.assertEqual(done[0], 1)
        self.assertIn('a.svg: gnuplot, which draws charts, is not installed', done[1])
        self.assertEqual(self.entries(), ['bin'])
        self.write('bin/gnuplot', '#!/bin/sh\nexit 3\n')
        os.chmod(self.path('bin/gnuplot'), 0o755)
        done = self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', TIME, '--every', EVERY, '--quiet', '--probes',
                          'a.svg', '--json', 'a.json', env={**os.environ, 'PATH': self.path('bin')})
        self.assertEqual(done[0], 1)
        self.assertIn('gnuplot could not draw it', done[1])
        self.assertIn('floor.pressure', json.loads(self.read('a.json'))['probes'])
        self.write('scene.yaml', SCENE + 'probes:\n  - {name: air, point: {at: [0, 0.95, 0]}, fields: [density]}\n')
        said = self.go('--probes', 'b.svg', '--json', 'b.json', name='b.h5part')
        self.assertIn('b.svg: no probe has met fluid; there is nothing to draw\n', said)
        self.assertIn('air.density', json.loads(self.read('b.json'))['probes'])

    def test_a_run_that_ends_early_has_its_plot(self):
        self.go('--probes', 'a.svg', '--set', 'solver.step.dt=0.2', '--set', 'solver.step.retries=0', '--time', '2', code=1)
        self.assertIn('floor.pressure', self.read('a.svg').decode())
        process = self.start('run', 'scene.yaml', '-o', 'b.h5part', '--time', '1000', '--every', EVERY, '--quiet', '--probes',
                             'b.svg')
        self.wait_for(lambda: os.path.exists(self.path('b.csv')) and self.read('b.csv').count(b'\n') > 9, process)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(), 130)
        self.assertIn('floor.pressure', self.read('b.svg').decode())

    def test_what_is_wrong_is_said(self):
        said = self.go('--probes', 'a.txt', code=2)
        self.assertIn("'a.txt' is no name for what probes read; name a FILE.csv, FILE.svg or FILE.png", said)
        self.assertIn('would replace', self.go('--probes', 'a.svg', '--json', 'a.csv', code=2))
        self.go('--probes', 'none/a.csv', code=1)
        self.write('b.csv', 'time\n')
        self.go('--time', '0.1', name='b.h5part')
        said = self.go('--resume', '--probes', 'b.csv', code=1, name='b.h5part')
        self.assertIn("b.csv: is no table of this scene's probes", said)
        self.assertEqual(self.read('b.csv'), b'time\n')
        said = self.go(quiet=())
        self.assertIn('scene.yaml: its probes are not read; --probes FILE.csv writes them', said)
        self.write('scene.yaml', SCENE)
        self.assertIn('scene.yaml has no probes for --probes', self.go('--probes', 'a.csv', code=2, name='c.h5part'))
        self.assertEqual(sorted(self.entries()), ['a.h5part', 'b.csv', 'b.h5part'])

    def test_a_full_disk(self):
        code, said = self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', '9', '--every', '9', '--quiet',
                                '--probes', 'a.csv', before=limit_files(100000))
        self.assertEqual(code, 1, said)
        self.assertIn('a.csv: File too large', said)
        self.go('--time', '1', '--resume', '--probes', 'a.csv')
        self.assertEqual(len(self.rows('a.csv')), 501)

    def test_a_gpu_reads_back(self):
        self.go('--probes', 'cpu.csv')
        said = self.go('--probes', 'a.csv', '--backend', 'compute', name='b.h5part')
        self.assertIn('a.csv: probes read all particles back after each step, for which backend compute waits', said)
        for ours, right in zip(self.rows('a.csv'), self.rows('cpu.csv')):
            self.assertAlmostEqual(float(ours['level.height [m]']), float(right['level.height [m]']), 4)


if __name__ == '__main__':
    command.main()
