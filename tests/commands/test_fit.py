"""slosh fit: searches, keeps its runs, writes a scene that runs; what cannot be had is said."""
import json
import os
import signal
import subprocess

import command

FEW = ['--set', 'particles.spacing=0.1', '--time', '0.1', '--method', 'mueller', '--set', 'solver.preset=play',
       '--threads', '1']
COARSE = ['--set', 'particles.spacing=0.25', '--time', '0.02']  # behind FEW: 32 particles


class FitTest(command.CommandTest):
    def fit(self, *words):
        return subprocess.run([command.PROGRAM, 'fit', *words], cwd=self.folder, capture_output=True,
                              text=True, timeout=command.PATIENCE, check=False)

    def figures(self, *words, code=0):
        done = self.fit(*words, '--quiet', '--json', 'out.json')
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(self.read('out.json')), done.stderr

    def text(self, name):
        return self.read(name).decode()


class Fit(FitTest):
    def test_the_cheapest_within(self):
        done = self.fit('scene.yaml', '--error', '20', '--json', 'out.json', *FEW)
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(self.read('out.json'))
        best = found['runs'][found['best']]
        self.assertEqual(best['fate'], 'best')
        self.assertTrue(best['error'] <= best['worst'] <= 0.2)
        for run in found['runs']:
            within = run['outcome'] == 'holds' and run['error'] <= 0.2
            self.assertIn(run['fate'], ('best',) if run is best else ('within', 'luck', 'repeat') if within else
                          ('broke',) if run['outcome'] != 'holds' else ('beyond',))
            self.assertTrue(run['fate'] != 'within' or run['seconds_per_second'] >= best['seconds_per_second'], run)
        self.assertEqual([run['own'] for run in found['runs']], [True] + [False] * (len(found['runs']) - 1))
        for words in ('chosen', 'the scene as it is', 'of a spacing: ', 'scene_fit.yaml, the cheapest found within 20 % on '):
            self.assertIn(words, done.stdout)
        self.assertTrue(0 < found['floor'] < 1e-3)
        # the same again runs nothing, and finds the same
        again = self.fit('scene.yaml', '--error', '20', *FEW)
        self.assertEqual(again.stdout, done.stdout)
        self.assertRegex(again.stderr, r'(\d+) of \1 runs were in scene_fit.csv already')
        # another error goes on with them
        self.assertRegex(self.fit('scene.yaml', '--error', '25', *FEW).stderr, r'\d+ of \d+ runs were in')

    def test_times_are_of_one_machine(self):
        """Here: of so many processors."""
        words = [word for word in FEW if word not in ('--threads', '1')]
        words = ['scene.yaml', '--error', '200', *words, *COARSE]
        self.assertEqual(self.fit(*words).returncode, 0)
        if len(os.sched_getaffinity(0)) > 1:
            alone = subprocess.run(['taskset', '-c', str(min(os.sched_getaffinity(0))), command.PROGRAM, 'fit', *words],
                                   cwd=self.folder, capture_output=True, text=True, timeout=command.PATIENCE, check=False)
            self.assertNotIn('were in scene_fit.csv already', alone.stderr)
        self.assertRegex(self.fit(*words).stderr, 'were in scene_fit.csv already')

    def test_the_scene_runs_and_is_the_one_that_was_found(self):
        self.write('tank.yaml', command.SCENE + 'metrics: [height]\nview: {color_by: speed}\n')
        found, _ = self.figures('tank.yaml', '--error', '20', '-o', 'new.yaml', '--time', '0.04', '--method', 'wcsph', '--threads', '1')
        best = found['runs'][found['best']]
        text = self.text('new.yaml')
        self.assertTrue(text.startswith('# Written by slosh fit, by\n#   slosh fit tank.yaml --error 20 --time 0.04 --set solver.method=wcsph --set solver.threads=1\n'), text)
        self.assertIn('  spacing: ', text)
        self.assertIn('# was 0.1\n', text)
        self.assertIn('The scene as it was: ', text)
        self.assertEqual(self.slosh('run', 'new.yaml', '-o', 'a.h5part', '--time', '0.02', '--quiet')[0], 0)

        def info(*words):
            said = subprocess.run([command.PROGRAM, 'info', *words], cwd=self.folder, capture_output=True, text=True, check=True)
            return [line for line in said.stdout.splitlines() if ' = ' in line and not line.startswith(' ')]
        sets = [word for setting in best['set'] for word in ('--set', setting)]
        step = [line for line in info('new.yaml') if line.startswith(('solver.step', 'particles.spacing'))]
        self.assertIn(f"particles.spacing = {best['spacing']:.9g} m", step)
        asked = info('tank.yaml', '--method', 'wcsph', *sets, '--set', f"particles.spacing={best['spacing']:.9g}")
        keys = ('title', 'solver.step', 'solver.threads')
        self.assertEqual([line for line in info('new.yaml') if not line.startswith(keys)],
                         [line for line in asked if not line.startswith(keys)])

    def test_letters_that_a_file_escapes(self):
        self.write('odd.yaml', command.SCENE.replace('A small tank', r'"a \\ \"tank\""'))
        self.assertEqual(self.fit('odd.yaml', '--error', '200', *FEW, *COARSE).returncode, 0)
        self.assertIn(r'title: "a \\ \"tank\""', self.text('odd_fit.yaml'))
        self.assertEqual(self.slosh('run', 'odd_fit.yaml', '-o', 'a.h5part', '--time', '0.02', '--quiet')[0], 0)

    def test_a_case(self):
        found, _ = self.figures('free_fall', '--error', '5', '--method', 'mueller', '--threads', '1')
        self.assertEqual(found['error_of'], 'way of the centre')
        self.assertEqual(self.entries(), ['free_fall_fit.csv', 'free_fall_fit.yaml', 'out.json'])
        self.assertEqual(self.slosh('run', 'free_fall_fit.yaml', '-o', 'a.h5part', '--time', '0.01', '--quiet')[0], 0)

    def test_what_is_offered_needs_no_help(self):
        """No line about it, no going back, and the same three times as long."""
        self.write('tank.yaml', command.SCENE)
        done = self.fit('tank.yaml', '--error', '60', *FEW, '--time', '0.2', '--json', 'out.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(self.read('out.json'))
        self.assertTrue(all(run['fate'] == 'broke' for run in found['runs'] if run['backs']), found['runs'])
        rows = [line.split(',') for line in self.text('tank_fit.csv').splitlines()]
        spacing = rows[0].index('spacing_m')
        long = {row[spacing] for row in rows if row[1] == 'long'}
        self.assertIn('{:.9g}'.format(found['runs'][found['best']]['spacing']), long)
        self.assertRegex(self.text('tank_fit.yaml'), r'over 0.2 s; 0.6 s, three times as long,\s')
        code, said = self.slosh('run', 'tank_fit.yaml', '-o', 'a.h5part', '--time', '0.6', '--quiet', '--json', 'a.json')
        self.assertEqual((code, said), (0, ''))
        self.assertEqual(json.loads(self.read('a.json'))['outcome'], 'holds')

    def test_frames(self):
        found, _ = self.figures('scene.yaml', '--frame-ms', '5', *FEW, *COARSE)
        best = found['runs'][found['best']]
        self.assertAlmostEqual(found['goal']['cost'], 0.15)
        self.assertLessEqual(best['seconds_per_second'], 0.15)
        for run in found['runs']:
            if run['outcome'] == 'holds' and run['seconds_per_second'] <= 0.15:
                self.assertGreaterEqual(max(run['error'], run['worst'] or 0) + found['floor'], best['error'])
        with open('/proc/cpuinfo') as file:
            self.assertIn(found['processor'], file.read())
        self.assertIn(found['processor'], self.text('scene_fit.yaml'))
        too_fast = ('--set', 'solver.sound_speed=3000', '--set', 'solver.step.retries=0')  # which ends it at once
        self.assertIn('is longer than a frame of 1/30 s', self.fit('scene.yaml', '--frame-ms', '50', *too_fast, *FEW).stderr)


class Trouble(FitTest):
    def refused(self, code, words, *arguments):
        done = self.fit(*arguments)
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(words, done.stderr)

    def test_what_is_asked(self):
        self.refused(2, '--error must be more than 0', 'scene.yaml', '--error', '0')
        self.refused(2, '--error PERCENT or --frame-ms MS', 'scene.yaml')
        self.refused(2, 'exclude each other', 'scene.yaml', '--error', '5', '--frame-ms', '5')
        self.refused(2, 'name a FILE.yaml', 'scene.yaml', '--error', '5', '-o', 'a.svg')
        self.refused(2, 'no_such', 'no_such', '--error', '5')
        self.refused(2, 'leave --time out', 'free_fall', '--error', '5', '--time', '1')
        self.refused(2, 'would replace the scene', 'scene.yaml', '--error', '5', '-o', 'scene.yaml')
        for name in ('scene_fit.csv', 'scene_fit.yaml', './scene_fit.csv'):  # fit's own, without -o
            self.refused(2, 'would replace each other', 'scene.yaml', '--error', '5', '--json', name)
        self.refused(1, 'no/a.yaml', 'scene.yaml', '--error', '5', '-o', 'no/a.yaml', *FEW)
        self.assertEqual(self.entries(), [])

    def test_nothing_is_within(self):
        found, said = self.figures('scene.yaml', '--error', '0.01', *FEW, '--set', 'particles.spacing=0.2', '--time', '0.05', code=1)
        self.assertIn('no setting that was tried is within 0.01 %; the nearest is mueller', said)
        self.assertEqual((found['best'], found['error']), (None, said.splitlines()[-1]))
        nearest = min(run['error'] for run in found['runs'] if run['outcome'] == 'holds')
        self.assertIn(f'error {100 * nearest:.3g} %', said)
        self.assertEqual(self.entries(), ['out.json', 'scene_fit.csv'])

    def test_below_the_scatter(self):
        found, said = self.figures('scene.yaml', '--error', '1e-9', *FEW, code=1)
        self.assertIn('it cannot be told which settings are within it', said)
        self.assertEqual(found['error'], said.splitlines()[-1])
        self.assertEqual(len(self.text('scene_fit.csv').splitlines()), 1 + 3)  # nothing was run for it

    def test_a_scene_that_breaks(self):
        self.refused(1, 'the scene as it is breaks', 'scene.yaml', '--error', '5', '--set', 'solver.sound_speed=3000',
                     '--set', 'solver.step.retries=0', *FEW)
        self.assertNotIn('scene_fit.yaml', self.entries())
        self.refused(1, 'the finest run, which all are compared with, broke', 'scene.yaml', '--error', '5', '--set',
                     'solver.sound_speed=3000', '--set', 'solver.step.retries=0', *FEW)

    def test_a_step_that_is_too_long_is_mended(self):
        step = ('--set', 'solver.step={dt: 0.04, substeps: 2, retries: 0}')
        found, said = self.figures('scene.yaml', '--error', '30', *step, *FEW, '--time', '0.2')
        self.assertIn('the scene as it is breaks', said)
        self.assertIsNone(found['floor'])
        self.assertIsNone(found['runs'][0]['error'])
        self.assertEqual(found['runs'][found['best']]['outcome'], 'holds')
        self.assertEqual(self.slosh('run', 'scene_fit.yaml', '-o', 'a.h5part', '--time', '0.02', '--quiet')[0], 0)

    def test_files_of_others_are_kept(self):
        for name, content in (('scene_fit.yaml', 'title: mine\n'), ('scene_fit.csv', 'day,rain\n')):
            self.write(name, content)
            done = self.fit('scene.yaml', '--error', '20', *FEW)
            self.assertEqual(done.returncode, 1)
            self.assertIn('there already', done.stderr)
            self.assertEqual(self.entries(), [name])
            self.assertEqual(self.text(name), content)
            os.remove(self.path(name))

    def test_a_scene_that_was_edited_is_kept(self):
        words = ['scene.yaml', '--error', '200', *FEW, *COARSE]
        self.assertEqual(self.fit(*words).returncode, 0)
        self.assertEqual(self.fit(*words).returncode, 0)  # fit's own may be replaced
        own = self.text('scene_fit.yaml')
        for mine in (own.replace('density: 1000', 'density: 1001'), own.replace('# Tried', '# I tried'), own + '# mine\n',
                     own.replace('sum is ', 'sum is 0', 1), own[:-1]):
            self.assertNotEqual(mine, own)
            self.write('scene_fit.yaml', mine)
            done = self.fit(*words)
            self.assertEqual(done.returncode, 1)
            self.assertIn('scene_fit.yaml: was changed since slosh fit wrote it; name another with -o', done.stderr)
            self.assertEqual(self.text('scene_fit.yaml'), mine)

    def test_what_cannot_be_read_is_kept(self):
        for name in ('scene_fit.yaml', 'scene_fit.csv'):
            os.symlink(name, self.path(name))
            done = self.fit('scene.yaml', '--error', '20', *FEW)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, f'^{name}: is .*Too many levels of symbolic links')
            os.remove(self.path(name))

    def test_nothing_changes(self):
        still = command.SCENE[:command.SCENE.index('motion')] + 'metrics: [potential_energy]\ngravity: [0, 0, 0]\n'
        self.write('still.yaml', still)
        self.refused(1, 'no metric changes in the run that all are compared with', 'still.yaml', '--error', '5', *FEW)
        self.assertEqual(self.entries(), ['still.yaml', 'still_fit.csv'])

    def test_stopped_anywhere_it_goes_on(self):
        words = ['fit', 'scene.yaml', '--error', '10', *FEW, '--time', '0.4']
        for end in (signal.SIGINT, signal.SIGKILL, signal.SIGINT, signal.SIGKILL):
            rows = len(self.text('scene_fit.csv').splitlines()) if 'scene_fit.csv' in self.entries() else 0
            process = self.start(*words)
            self.wait_for(lambda: 'scene_fit.csv' in self.entries() and
                          len(self.text('scene_fit.csv').splitlines()) > rows + 1, process)
            process.send_signal(end)
            self.assertEqual(process.wait(60), 130 if end == signal.SIGINT else -end)
            self.assertEqual('the same command goes on' in process.stderr.read(), end == signal.SIGINT)
            self.assertNotIn('scene_fit.yaml', self.entries())
        rows = self.text('scene_fit.csv').splitlines()
        done = self.fit(*words[1:])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.text('scene_fit.csv').splitlines()[:len(rows)], rows)  # none was made twice


class TinyDisk(command.TinyDiskTest, FitTest):
    def test_nothing_half_is_left(self):
        """Runs that were made stay."""
        self.assertIn(self.full('16k', f'fit scene.yaml --error 20 {" ".join(FEW)} -o disk/a.yaml'), ([], ['a.csv']))
        if 'a.csv' in self.entries():
            self.assertEqual(self.fit('scene.yaml', '--error', '20', '-o', 'a.yaml', *FEW).returncode, 0)


if __name__ == '__main__':
    command.main()
