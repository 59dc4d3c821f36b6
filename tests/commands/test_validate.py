"""slosh validate: the coarse set keeps its tolerances, figures are written, a miss is an exit code, Ctrl-C ends cleanly."""
import json
import os
import signal
import subprocess
import time

import command


class Validate(command.CommandTest):
    def run_it(self, *words):
        return subprocess.run([command.PROGRAM, 'validate', *words], cwd=self.folder, capture_output=True,
                              text=True, timeout=250, check=False)

    def test_coarse_set_keeps_its_tolerances(self):
        done = self.run_it('--coarse', '--json', 'out.json', '-o', 'plots')
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(os.path.join(self.folder, 'out.json'), encoding='utf-8') as file:
            cases = json.load(file)['cases']
        names = {c['case'] for c in cases}
        self.assertGreaterEqual(len(names), 15)
        for c in cases:
            for key in ('case', 'metric', 'method', 'backend', 'value', 'reference', 'error', 'tolerance',
                        'passed', 'seconds'):
                self.assertIn(key, c)
            self.assertTrue(c['passed'] and c['error'] <= c['tolerance'], c)
            self.assertIn(c['metric'], done.stdout)
        for name in names:
            with open(os.path.join(self.folder, 'plots', name + '.svg'), encoding='utf-8') as file:
                self.assertIn('</svg>', file.read())

    def test_a_miss_is_exit_code_1(self):
        # with sound as slow as the flow the drop is no longer incompressible
        done = self.run_it('elliptical_drop', '--coarse', '--set', 'solver.sound_speed=100')
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn('missed', done.stdout)

    def test_what_is_wrong_is_said(self):
        done = self.run_it('dam_brake')
        self.assertEqual(done.returncode, 2)
        self.assertIn('dam_break', done.stderr)
        self.assertEqual(self.run_it('--full', '--coarse').returncode, 2)
        self.assertEqual(self.run_it('--set', 'no.key=1').returncode, 2)

    def test_interrupt_keeps_what_is_done(self):
        child = subprocess.Popen([command.PROGRAM, 'validate', 'free_fall', 'dam_break_2d', '--json', 'out.json'],
                                 cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                 preexec_fn=command.obey_interrupts)
        while 'kinetic' not in child.stdout.readline():
            time.sleep(0.01)
        child.send_signal(signal.SIGINT)
        rest = child.communicate(timeout=60)
        self.assertEqual(child.returncode, 130, rest)
        with open(os.path.join(self.folder, 'out.json'), encoding='utf-8') as file:
            self.assertEqual({c['case'] for c in json.load(file)['cases']}, {'free_fall'})


if __name__ == '__main__':
    command.main()
