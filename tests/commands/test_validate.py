"""slosh validate: quick cases keep their tolerances, figures are written, a miss is an exit code, Ctrl-C ends cleanly."""
import json
import os
import runpy
import signal
import subprocess

import command
import svg_labels

TOOLS_DOCS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '../../tools/docs')


METHODS = ('wcsph', 'mueller', 'dfsph', 'pbf')
# A second for all methods at most, and at least one of each kind of flow; tests/long/test_validate_all.py has all cases.
QUICK = ['hydrostatic', 'tilted', 'layers', 'layers_1000', 'growth', 'dam_break_2d', 'dam_pressure', 'free_fall', 'standing_wave',
         'elliptical_drop', 'collision', 'drop', 'laplace', 'taylor_green', 'poiseuille', 'couette']


class ValidateTest(command.CommandTest):
    def run_it(self, *words, **how):
        return subprocess.run([command.PROGRAM, 'validate', *words], cwd=self.folder, capture_output=True,
                              text=True, timeout=command.PATIENCE, check=False, **how)

    def figures(self):
        return json.loads(self.read('out.json'))['cases']

    def run_coarse(self, *names):
        """The cases, or all, within their tolerances, in terminal, JSON, plots and the table of docs; returns the cases' names."""
        done = self.run_it(*names, '--coarse', '--threads', '1', '--json', 'out.json', '-o', 'plots')
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        cases = self.figures()
        names = {c['case'] for c in cases}
        self.assertEqual({c['method'] for c in cases}, set(METHODS))
        for name in names:  # none in silence
            for method in METHODS:
                self.assertTrue(f'{name} with {method} is left out: ' in done.stderr or
                                any(c['case'] == name and c['method'] == method for c in cases), (name, method))
        for c in cases:
            for key in ('case', 'metric', 'method', 'backend', 'value', 'reference', 'error', 'tolerance',
                        'passed', 'seconds'):
                self.assertIn(key, c)
            if c['tolerance'] is None:  # shown without a verdict
                self.assertIsNone(c['passed'], c)
                self.assertGreater(c['reference'], 0, c)
            else:
                self.assertTrue(c['passed'] and c['error'] <= c['tolerance'], c)
            self.assertIn(c['metric'], done.stdout)
        table = runpy.run_path(TOOLS_DOCS)['validation_part']([self.path('out.json')])
        self.assertEqual(table.count('\n'), 2 + len(cases))
        for name in names:
            self.assertIn(f'| `{name}` |', table)
            plot = self.read(f'plots/{name}.svg').decode()
            self.assertIn('</svg>', plot)
            self.assertEqual(svg_labels.faults(plot), [], name)
        return names, done.stderr

    def on_backend(self, backend, *names):
        """The values of cases with wcsph."""
        done = self.run_it(*names, '--coarse', '--quiet', '--threads', '1', '--json', 'out.json', '--method', 'wcsph', '--backend', backend)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [c['value'] for c in self.figures()]

    def assert_near(self, cpu, compute):
        self.assertTrue(len(cpu) == len(compute) > 0)
        for a, b in zip(cpu, compute):
            self.assertAlmostEqual(a, b, delta=2e-3)


class Validate(ValidateTest):
    def test_quick_cases_keep_their_tolerances(self):
        names, said = self.run_coarse(*QUICK)
        self.assertEqual(names, set(QUICK))
        self.assertIn('elliptical_drop with pbf is left out: all of it takes half a step of 1/60 s\n', said)

    def test_the_same_on_compute(self):
        self.assert_near(self.on_backend('cpu', 'poiseuille'), self.on_backend('compute', 'poiseuille'))

    def test_a_miss_is_exit_code_1(self):
        # with sound as slow as the flow the drop is no longer incompressible
        done = self.run_it('elliptical_drop', '--coarse', '--set', 'solver.sound_speed=100')
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn('missed', done.stdout)

    def test_what_is_wrong_is_said(self):
        done = self.run_it('dam_brake')
        self.assertEqual(done.returncode, 2)
        self.assertIn("did you mean 'dam_break'?", done.stderr)
        done = self.run_it('free_fall', 'taylor_green', '--coarse', '--quiet', '--method', 'mueller', '--backend', 'fragment')
        self.assertEqual((done.returncode, done.stdout), (0, ''), done.stderr)
        self.assertIn('taylor_green with mueller is left out', done.stderr)
        self.assertEqual(self.run_it('--full', '--coarse').returncode, 2)
        self.assertEqual(self.run_it('--set', 'no.key=1').returncode, 2)

    def test_steps_longer_than_a_window_have_a_value(self):
        self.run_it('dam_pressure', '--coarse', '--quiet', '--method', 'wcsph', '--set', 'solver.preset=play', '--json', 'out.json')
        for c in self.figures():
            self.assertLess(c['error'], 1, c)

    def test_a_case_named_twice_is_one(self):
        done = self.run_it('free_fall', 'collision', 'free_fall', '--coarse', '--quiet', '--json', 'out.json')
        self.assertEqual(done.returncode, 0, done.stderr)
        cases = self.figures()
        self.assertEqual(len(cases), 4 * 2 + 4 * 3)
        keys = {(c['case'], c['metric'], c['method'], c['backend']) for c in cases}
        self.assertEqual(len(keys), len(cases))

    def test_particles_choose_the_spacing_of_a_case(self):
        done = self.run_it('free_fall', '--method', 'mueller', '--particles', '500', '--quiet', '--json', 'out.json')
        self.assertEqual(done.stderr, '')
        self.assertEqual([c['particles'] for c in self.figures()], [486, 486])  # of the lattice nearest to 500

    def test_what_does_not_depend_on_plots_is_written(self):
        os.mkdir(self.path('bin'))
        self.write('bin/gnuplot', '#!/bin/sh\nexit 3\n')
        os.chmod(self.path('bin/gnuplot'), 0o755)
        done = self.run_it('free_fall', '--coarse', '--quiet', '-o', 'plots', '--json', 'out.json',
                           env={**os.environ, 'PATH': self.path('bin')})
        self.assertEqual(done.returncode, 1)
        self.assertIn('gnuplot could not draw it', done.stderr)
        self.assertEqual(len(self.figures()), 4 * 2)
        self.assertEqual(os.listdir(self.path('plots')), [])

    def test_a_full_disk_leaves_no_half_plot(self):
        done = self.run_it('free_fall', '--coarse', '--quiet', '-o', 'plots', preexec_fn=command.limit_files(8192))
        self.assertEqual(done.returncode, 1)
        self.assertIn('is the disk full?', done.stderr)
        self.assertEqual(os.listdir(self.path('plots')), [])

    def test_a_folder_that_cannot_be_is_said_first(self):
        self.write('file', '')
        done = self.run_it('free_fall', '--coarse', '-o', 'file')
        self.assertEqual((done.returncode, done.stdout), (1, ''))
        self.assertIn('file', done.stderr)

    def test_figures_are_the_same_with_any_threads(self):
        figures = []
        for threads in ('1', '2', '2'):
            done = self.run_it('collision', '--coarse', '--quiet', '--threads', threads, '--json', 'out.json', '--method', 'wcsph')
            self.assertEqual(done.returncode, 0, done.stderr)
            figures.append([(c['case'], c['metric'], c['method'], c['value'], c['error']) for c in self.figures()])
        self.assertEqual(figures[0], figures[1])
        self.assertEqual(figures[1], figures[2])

    def test_interrupt_keeps_what_is_done(self):
        child = subprocess.Popen([command.PROGRAM, 'validate', 'free_fall', 'dam_break_2d', '--json', 'out.json'],
                                 cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                 preexec_fn=command.obey_interrupts)
        self.addCleanup(child.kill)
        while 'kinetic' not in (line := child.stdout.readline()):
            self.assertTrue(line, 'the program ended too early')
        child.send_signal(signal.SIGINT)
        rest = child.communicate(timeout=command.PATIENCE)
        self.assertEqual(child.returncode, 130, rest)
        self.assertEqual({c['case'] for c in self.figures()}, {'free_fall'})


if __name__ == '__main__':
    command.main()
