"""slosh chart --views: pictures against a reference picture; none of them is drawn twice."""
import json
import os
import shutil
import signal
import subprocess

import command
import svg_labels

SHADERS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'shaders')
SMALL = ['--views', '--size', '64x64', '--time', '0.05']


class ChartViewsTest(command.CommandTest):
    def run_it(self, *words, size='64x64'):
        return subprocess.run([command.PROGRAM, 'chart', 'scene.yaml', '-o', 'out.svg', *SMALL, '--size', size, *words],
                              cwd=self.folder, capture_output=True, text=True, timeout=command.PATIENCE, check=False)

    def check_views(self, views, worse, *sets):
        """Draws them, and again, and what is lost; what is coarser, (view, settings), is farther off. Returns errors by those."""
        first = self.run_it('--json', 'out.json', *sets)
        self.assertEqual(first.returncode, 0, first.stderr)
        self.assertNotIn('no effect', first.stderr)
        self.assertEqual(svg_labels.faults(self.read('out.svg').decode()), [])
        figures = json.loads(self.read('out.json'))
        self.assertIn(f"renderer: {figures['renderer']}\n", first.stdout)
        self.assertEqual((figures['size'], figures['supersampled'], figures['time']), ([64, 64], 8, 0.05))
        runs = {(run['view'], run['settings']): run for run in figures['runs']}
        self.assertEqual({view for view, _ in runs}, views)
        for run in figures['runs']:
            self.assertTrue(0 < run['error'] < 0.5 and 0 <= run['structure'] < 1 and run['ms'] > 0, run)
        for view in views & {'spheres', 'splat', 'volume'}:
            self.assertTrue(any(run['front'] for run in figures['runs'] if run['view'] == view))
        for view, settings in worse:
            self.assertGreater(runs[view, settings]['error'], 1.02 * runs[view, 'as it is']['error'], (view, settings))
            self.assertGreater(runs[view, settings]['structure'], runs[view, 'as it is']['structure'], (view, settings))

        rows = self.read('out.csv').decode()
        self.assertEqual(len(rows.splitlines()), 1 + len(figures['runs']))
        again = self.run_it(*sets)
        self.assertEqual(again.stdout, first.stdout)  # times and all: nothing is drawn again
        self.assertNotIn('simulate', again.stderr)
        # one lost: that one alone is drawn again, to the same error
        self.write('out.csv', ''.join(line + '\n' for line in rows.splitlines()[:-1]))
        self.assertEqual(self.run_it('--quiet', *sets).returncode, 0)
        kept = self.read('out.csv').decode().splitlines()
        self.assertEqual(kept[:-1], rows.splitlines()[:-1])
        self.assertEqual(kept[-1].split(',')[-2:], rows.splitlines()[-1].split(',')[-2:])
        return {which: run['error'] for which, run in runs.items()}


class ChartViews(ChartViewsTest):
    def test_splats_by_time_and_error(self):
        errors = self.check_views({'splat'}, [('splat', 'antialias=false'), ('splat', 'all coarsest')],
                                  '--set', 'view.kind=splat', '--set', 'view.splat.ior=1.4')
        self.assertAlmostEqual(errors['splat', 'cull=false'], errors['splat', 'as it is'], places=4)  # another way to the same picture

    def test_another_state_or_size_is_drawn_anew(self):
        one = ['--quiet', '--set', 'view.kind=spheres']
        for words, size, rows in ((one, '64x64', 1), (one, '64x64', 1), (one + ['--time', '0.1'], '64x64', 2), (one, '32x32', 3),
                                  (one + ['--set', 'view.color_by=density'], '64x64', 4)):
            done = self.run_it(*words, size=size)
            self.assertEqual((done.returncode, done.stdout), (0, ''), done.stderr)
            self.assertEqual(len(self.read('out.csv').decode().splitlines()), 1 + rows)

    def test_a_large_picture_is_supersampled_less(self):
        done = self.run_it('--set', 'view.kind=spheres', size='2100x16')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('references are supersampled 7 x 7 in place of 8 x 8', done.stderr)
        self.assertIn('7 x 7 supersampled', done.stdout)

    def test_what_cannot_be(self):
        done = self.slosh('chart', 'scene.yaml', '-o', 'out.svg', '--size', '32x32')
        self.assertEqual((done[0], self.entries()), (2, []), done[1])
        self.assertIn('--size is of the pictures of --views', done[1])
        done = self.run_it('--sweep', 'method=mueller')
        self.assertEqual((done.returncode, self.entries()), (2, []), done.stderr)
        self.assertIn('--views has a plan of its own', done.stderr)
        done = self.run_it(size='16384x16384')
        self.assertEqual((done.returncode, self.entries()), (1, []), done.stderr)
        self.assertIn('use a smaller --size', done.stderr)
        done = self.run_it('--set', 'view.kind=none')
        self.assertEqual((done.returncode, self.entries()), (2, []), done.stderr)
        done = self.run_it('--set', 'view.kind=spheres', '--set', 'view.splat.ior=1.5')
        self.assertIn('view.splat.ior has no effect', done.stderr)
        self.write('out.csv', 'day,rain\n')
        done = self.run_it()
        self.assertEqual(done.returncode, 1)
        self.assertIn('no chart of views wrote it', done.stderr)
        self.assertEqual(self.read('out.csv'), b'day,rain\n')
        self.assertEqual(self.run_it('--json', 'out.json').returncode, 1)
        self.assertIn('no chart of views wrote it', json.loads(self.read('out.json'))['error'])

    def test_other_shaders_are_another_picture(self):
        shutil.copytree(SHADERS, self.path('shaders'))
        for rows in (1, 1, 2):
            if rows == 2:
                with open(self.path('shaders/spheres/spheres.frag'), 'a', encoding='utf-8') as shader:
                    shader.write('// other words\n')
            done = self.run_it('--quiet', '--set', 'view.kind=spheres', '--shaders', 'shaders')
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(len(self.read('out.csv').decode().splitlines()), 1 + rows)

    def test_interrupt_keeps_whole_rows(self):
        process = self.start('chart', 'scene.yaml', '-o', 'out.svg', '--quiet', '--json', 'out.json', *SMALL)
        self.wait_for(lambda: 'out.csv' in self.entries(), process)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 130)
        self.assertIn('the same command goes on', process.stderr.read())
        self.assertEqual(self.entries(), ['out.csv', 'out.json'])
        self.assertIn('the same command goes on', json.loads(self.read('out.json'))['error'])
        for row in self.read('out.csv').decode().splitlines()[1:]:
            self.assertEqual(len(row.split(',')), 7)


if __name__ == '__main__':
    command.main()
