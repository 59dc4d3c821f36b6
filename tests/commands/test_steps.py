"""Adaptive steps and the sentinel, as a user meets them."""
import json
import os
import re

import h5py

import command
from command import CommandTest, whole_steps


class Steps(CommandTest):
    def go(self, *more, code=0):
        done, said = self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', '0.4', '--json', 'a.json', *more)
        self.assertEqual(done, code, said)
        return said

    def last(self):
        with h5py.File(self.path('a.h5part')) as file:
            return file[f"Step#{len(whole_steps(self.path('a.h5part'))) - 1}"].attrs['TimeValue']

    def test_cfl(self):
        said = self.go('--set', 'solver.step.mode=cfl')
        self.assertRegex(said, r'steps bounded by courant [0-9.]+ % growth [0-9.]+ %\n')
        found = json.loads(self.read('a.json'))
        self.assertEqual(sum(found['limits'].values()), found['steps'])
        self.assertEqual(found['troubles'], 0)
        self.assertGreaterEqual(found['simulated_seconds'], 0.4)
        self.assertLess(found['simulated_seconds'], 0.41)
        self.go('--set', 'solver.step={mode: cfl, max_dt: 0.0002}', '--time', '0.1')
        found = json.loads(self.read('a.json'))
        self.assertGreater(found['limits']['max_dt'], 0.9 * found['steps'])

    def test_snapshots_are_at_even_times(self):
        said = self.go('--set', 'solver.step.mode=cfl', '--every', '0.03')
        self.assertNotIn('uneven', said)
        for k, time in enumerate(whole_steps(self.path('a.h5part'))[:-1]):
            self.assertAlmostEqual(time, 0.03 * k, delta=1e-9)
        said = self.go('--set', 'solver.step.dt=0.02', '--every', '0.03')
        self.assertIn('snapshots are at uneven times: a frame of 0.02 s does not divide the 0.03 s', said)
        self.assertNotIn('uneven', self.go('--set', 'solver.step.dt=0.015', '--every', '0.03'))

    def test_a_frame_of_six_digits_divides_what_it_is_meant_to(self):
        said = self.go('--set', 'solver.step.dt=0.0016667', '--every', '0.005')
        self.assertNotIn('uneven', said)
        for k, time in enumerate(whole_steps(self.path('a.h5part'))[:-1]):
            self.assertAlmostEqual(time, 3 * k * 0.0016667, delta=1e-9)
        said = self.go('--set', 'solver.step.dt=0.0013333', '--every', '0.004')  # the third ends before the time
        self.assertIn('--set solver.step.dt=0.00133334,', said)

    def late(self):
        return json.loads(self.read('late.json'))['picture_late_seconds']

    def render(self, folder, *more):
        done, said = self.slosh('render', 'scene.yaml', '-o', folder, '--frames', '4', '--fps', '75', '--size', '64x64',
                                '--set', 'solver.step={dt: 0.02, substeps: 8}', '--set', 'gravity=[0, -30, 0]',
                                '--json', 'late.json', *more)
        self.assertEqual(done, 0, said)
        with_data = []
        for name in sorted(os.listdir(self.path(folder))):
            with open(self.path(os.path.join(folder, name)), 'rb') as file:
                with_data.append(file.read())
        return said, with_data

    def test_pictures_between_states(self):
        said, without = self.render('a', '--steps')  # 0, 13.3, 26.7 and 40 ms: the states at 0, 20, 40 and 40 ms
        self.assertIn('pictures are at uneven times', said)
        self.assertIn('or leaving --steps out makes them even', said)
        self.assertEqual(without[2], without[3])
        self.assertAlmostEqual(self.late(), 0.04 - 2 / 75)
        said, between = self.render('b')
        self.assertNotIn('uneven', said)
        self.assertEqual((between[0], between[3]), (without[0], without[3]))
        self.assertEqual(len(set(between)), 4)
        self.assertAlmostEqual(self.late(), 0)

    def test_films_are_at_even_times(self):
        """Of a scene, in each mode and beside one another, and of a session; one picture shows a step."""
        film = ('--frames', '4', '--fps', '40', '--size', '64x64', '--json', 'late.json')
        for name in 'film.mp4', 'film.gif', 'film':
            for more in ((), ('--set', 'solver.step.mode=cfl'), ('--compare', 'solver.step.dt=0.02,0.03')):
                code, said = self.slosh('render', 'scene.yaml', '-o', name, *film, '--set', 'solver.step={dt: 0.02, substeps: 8}', *more)
                self.assertEqual((code, self.late() < 1e-6), (0, True), said)
                self.assertNotIn('uneven', said)
        one = ('--time', '0.05', '--set', 'solver.step.dt=0.02', '--size', '64x64', '--json', 'late.json')
        for more, late in ((), 0.01), (['--interpolate'], 0), (['--steps'], 0.01):
            code, said = self.slosh('render', 'scene.yaml', '-o', 'one.png', *one, *more)
            self.assertEqual(code, 0, said)
            self.assertAlmostEqual(self.late(), late)
        code, said = self.slosh('render', 'scene.yaml', '-o', 'one.png', *one, '--steps', '--interpolate')
        self.assertEqual((code, said.count('leave one out')), (2, 1), said)

    def test_cfl_resumes(self):
        cfl = ('--set', 'solver.step.mode=cfl', '--every', '0.01', '--quiet')
        self.assertEqual(self.slosh('run', 'scene.yaml', '-o', 'b.h5part', '--time', '0.4', *cfl)[0], 0)
        self.assertEqual(self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', '0.2', *cfl)[0], 0)
        self.go(*cfl, '--resume')
        with h5py.File(self.path('a.h5part')) as a, h5py.File(self.path('b.h5part')) as b:
            self.assertEqual(len(a), len(b))
            one, other = a[f'Step#{len(a) - 1}'], b[f'Step#{len(a) - 1}']
            self.assertEqual(one.attrs['restart'].tobytes(), other.attrs['restart'].tobytes())
            for name in ('id', 'x', 'velocity_1'):
                self.assertEqual(one[name][:].tobytes(), other[name][:].tobytes())

    def test_bench(self):
        code, said = self.slosh('bench', 'scene.yaml', '--view', 'none', '--frames', '20', '--json', 'b.json', '--set',
                                'solver.step.mode=cfl')
        self.assertEqual(code, 0, said)
        found = json.loads(self.read('b.json'))[0]
        self.assertEqual(found['substeps'], 1)
        self.assertGreater(found['particle_steps_per_second'], 0)

    def test_trouble_is_told_and_cured(self):
        said = self.go('--set', 'solver.step={dt: 0.04, substeps: 1}', '--set', 'fluids[0].start=rest')
        self.assertRegex(said, r't = [0-9.]+ s: a particle moves further than the support radius in one step; '
                               r'back to [0-9.]+ s with 1/2 of the step \(1 of 3\)\n')
        self.assertGreater(json.loads(self.read('a.json'))['troubles'], 0)

    def test_the_same_trouble_is_told_once(self):
        said = self.go('--set', 'solver.step={dt: 0.03, substeps: 1}', '--time', '12', '--every', '10')
        troubles = json.loads(self.read('a.json'))['troubles']
        self.assertGreater(troubles, 2)
        told = re.findall(r'1/[248] of the step', said)
        self.assertEqual(len(told), len(set(told)), said)
        self.assertIn(f'the step was halved {troubles} times in all after trouble\n', said)

    def test_it_gives_up_with_a_snapshot(self):
        said = self.go('--set', 'solver.step={dt: 0.04, substeps: 1, retries: 0}', code=1)
        self.assertNotIn('kept', said)
        said = self.go('--set', 'solver.step={dt: 0.05, substeps: 1, retries: 1}', '--set', 'solver.sound_speed=60',
                       '--every', '10', code=1)
        self.assertRegex(said, r'the simulation blew up at t = [0-9.]+ s: .*; the state at t = [0-9.e-]+ s is kept')
        kept = float(said.split('the state at t = ')[1].split(' ')[0])
        self.assertAlmostEqual(self.last(), kept, places=6)

    FIGURES = ('iterations_mean', 'iterations_p95', 'density_error_mean', 'density_error_max')

    def check_solved(self, found):
        mean, p95, error, worst = (found[name] for name in self.FIGURES)
        self.assertTrue(1 <= mean <= 200 and 1 <= p95 <= 200, found)  # fluid that falls needs some
        self.assertTrue(0 < error <= 0.0005 and error < worst < 0.1, found)  # solver.tolerance by itself

    def test_solvers_are_counted(self):
        said = self.go('--method', 'dfsph', '--threads', '1')
        self.assertRegex(said, r'[0-9.]+ iterations a step \(p95 [0-9]+\), density error [0-9.e-]+ % mean, [0-9.]+ % max\n')
        self.check_solved(json.loads(self.read('a.json')))
        code, said = self.slosh('bench', 'scene.yaml', '--view', 'none', '--frames', '3', '--json', 'b.json', '--method',
                                'dfsph', '--threads', '1')
        self.assertEqual(code, 0, said)
        found = json.loads(self.read('b.json'))[0]
        self.check_solved(found)
        self.assertIn('solve', [stage['name'] for stage in found['stages']])
        self.go('--time', '0.1')
        self.assertEqual([name for name in self.FIGURES if name in json.loads(self.read('a.json'))], [])

    def test_a_tolerance_that_nothing_reaches(self):
        said = self.go('--method', 'dfsph', '--set', 'solver.tolerance=0', '--set', 'solver.iterations=1',
                       '--set', 'fluids[0].start=rest', '--set', 'fluids[1].start=rest', code=1)
        words = r'the solver of density does not converge: solver.iterations 1 leaves [0-9.e-]+ % in the mean, ' \
                r'solver.tolerance is 0 %'
        self.assertEqual(len(re.findall(words + r'; back to [0-9.]+ s with 1/[248] of the step', said)), 3, said)
        self.assertRegex(said, 'the simulation stopped at t = .*' + words + '.*use a smaller solver.step.dt, more '
                               'solver.step.substeps, more solver.iterations or a larger solver.tolerance\n')
        self.assertIn('a.h5part: holds the 1 whole snapshot before that', said)


if __name__ == '__main__':
    command.main()
