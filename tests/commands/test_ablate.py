"""slosh bench --ablate: what each term of a scene costs, and what changes without it."""
import contextlib
import json
import os
import shutil
import signal
import subprocess

import command

# In the plane, with terms of wcsph that matter and one that does nothing: fluid without friction slips past any wall.
SCENE = """\
box: {size: [1, 1], slip: none}
particles: {spacing: 0.05, support: 2.6}
fluids: [{fill: [block: {min: [-0.5, 0], max: [0, 0.6]}]}]
solver: {method: wcsph, delta_sph: 0.1, sound_speed: 30, step: {dt: 0.002, substeps: 4, retries: 0}}
"""


class AblateTest(command.CommandTest):
    def run_it(self, *words, env=None):
        return subprocess.run([command.PROGRAM, 'bench', *words, '--ablate', '--json', 'out.json'], cwd=self.folder,
                              capture_output=True, text=True, timeout=command.PATIENCE, check=False, env=env)

    def rows(self):
        return json.loads(self.read('out.json'))

    def without_valgrind(self):
        """An environment in which it is not found: what it counts is most of the time of small scenes."""
        os.mkdir(self.path('bin'))
        return {**os.environ, 'PATH': self.path('bin')}


class Ablate(AblateTest):

    def test_terms_and_what_they_change(self):
        self.write('tank.yaml', SCENE)
        done = self.run_it('tank.yaml', '--time', '0.2', '--threads', '1')
        self.assertEqual(done.returncode, 0, done.stderr)
        whole, *terms = self.rows()
        self.assertEqual((whole['term'], whole['terms'], whole['runs'], whole['outcome']), (None, len(terms), 4, 'holds'))
        by_name = {row['term']: row for row in terms}
        self.assertEqual(set(by_name), {'box.slip', 'solver.artificial_viscosity', 'solver.delta_sph'})
        for row in terms:
            self.assertIn(f"{row['term']} {row['value']}", done.stdout)
            self.assertEqual(row['runs'], 3)
            self.assertTrue(row['ms_step'] > 0 and row['seconds_per_second'] > 0)
            self.assertAlmostEqual(row['steps_per_second'], 2000, delta=20)
        # nothing to hold: the same bits; and diffusion of density is a loop over pairs of its own
        self.assertEqual(by_name['box.slip']['changes'], 0)
        self.assertIn(by_name['box.slip']['advice'], ('of no account', 'drop it'))
        self.assertGreater(by_name['solver.delta_sph']['changes'], whole['floor'])
        self.assertGreater(by_name['solver.artificial_viscosity']['changes'], whole['floor'])
        if not shutil.which('valgrind'):
            self.fail('valgrind is not installed: apt-get install valgrind')
        self.assertGreater(whole['instructions_step'], 1e5)
        self.assertGreater(by_name['solver.delta_sph']['saves_instructions'], 0.05)
        # copies of so small a scene's arrays take 1 % more or less, by their addresses
        self.assertLess(abs(by_name['box.slip']['saves_instructions']), 0.02)

    def test_interrupt_ends_valgrind(self):
        """It is told of by the process alone, as kill does it; nothing of its own is left."""
        self.write('tank.yaml', SCENE.replace('spacing: 0.05', 'spacing: 0.01'))
        process = subprocess.Popen([command.PROGRAM, 'bench', 'tank.yaml', '--ablate', '--time', '0.0005', '--quiet'], cwd=self.folder,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, preexec_fn=command.obey_interrupts)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        children = f'/proc/{process.pid}/task/{process.pid}/children'

        def valgrind():
            with contextlib.suppress(FileNotFoundError, ProcessLookupError):  # one that has just ended
                with open(children, encoding='utf-8') as file:
                    for child in file.read().split():
                        with open(f'/proc/{child}/cmdline', encoding='utf-8') as line:
                            words = line.read().split('\0')
                        folders = [os.path.dirname(word.split('=', 1)[1]) for word in words if word.startswith('--callgrind-out-file=')]
                        if folders:
                            return child, folders[0]
            return None

        child, folder = self.wait_for(valgrind, process)
        self.assertTrue(os.path.isdir(folder))
        os.kill(int(child), signal.SIGSTOP)  # it would take for ever
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(30), 130)
        self.assertFalse(os.path.exists(f'/proc/{child}'))
        self.assertFalse(os.path.exists(folder))

    def test_a_term_without_which_the_run_breaks(self):
        # thick fluid by explicit friction at that step: the solver that iterates is needed
        self.write('tank.yaml', SCENE.replace('fluids: [{', 'fluids: [{viscosity: 20000, ').replace('method: wcsph, delta_sph: 0.1', 'viscosity: implicit'))
        done = self.run_it('tank.yaml', '--time', '0.1', '--threads', '1', env=self.without_valgrind())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('valgrind is not installed', done.stdout)
        by_name = {row['term']: row for row in self.rows()}
        self.assertEqual(by_name[None]['outcome'], 'holds')
        self.assertIsNone(by_name[None]['instructions_step'])
        broken = by_name['solver.viscosity']
        self.assertEqual((broken['advice'], broken['runs'], broken['changes']), ('needed', 0, None), broken)
        self.assertEqual(broken['outcome'], 'blown up')
        self.assertTrue(broken['outcome_words'])

    def test_a_scene_without_terms(self):
        self.write('tank.yaml', SCENE.replace(', slip: none', '').replace('method: wcsph, delta_sph: 0.1, ', 'numerical_viscosity: 0, '))
        done = self.run_it('tank.yaml', '--time', '0.1')
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('the scene has no term that it could do without', done.stdout)
        self.assertEqual([row['terms'] for row in self.rows()], [0])

    def test_what_stands_alone(self):
        for words in (['--sweep', 'method=mueller,wcsph'], ['--frames', '5'], ['--micro'], ['--play'], ['--time', '0'],
                      ['--clock', 'finish'], ['--size', '64x64'], ['--seconds', '20'], ['--view', 'splat']):
            done = self.run_it('scene.yaml', *words)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn('--ablate', done.stderr)
        self.assertEqual(self.entries(), [])

    def test_interrupt_shows_what_there_is(self):
        self.write('tank.yaml', SCENE)
        process = subprocess.Popen([command.PROGRAM, 'bench', 'tank.yaml', '--ablate', '--time', '10', '--threads', '1', '--json', 'out.json'],
                                   cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True, preexec_fn=command.obey_interrupts, env=self.without_valgrind())
        self.addCleanup(process.kill)
        while 'ablate' not in process.stderr.readline():
            self.assertIsNone(process.poll(), 'the program ended too early')
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=command.PATIENCE)
        self.assertEqual(process.returncode, 130)
        self.assertIn('the whole scene', out)
        self.assertIn('solver.delta_sph 0.1', out)
        self.assertEqual(self.rows()[0]['term'], None)


if __name__ == '__main__':
    command.main()
