"""slosh validate: all of the coarse set keeps its tolerances; cases on compute; any number of threads."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_validate import ValidateTest


class ValidateAll(ValidateTest):
    def test_coarse_set_keeps_its_tolerances(self):
        names, said = self.run_coarse()
        self.assertGreaterEqual(len(names), 15)
        self.assertIn('elliptical_drop with pbf is left out: all of it takes half a step of 1/60 s\n', said)

    def test_the_same_on_compute(self):
        # on a software renderer too, and the same figures each time
        few = ['poiseuille', 'growth']
        cpu, compute = (self.on_backend(backend, *few, 'taylor_green') for backend in ('cpu', 'compute'))
        again = self.on_backend('compute', *few)
        self.assertEqual(compute[:len(again)], again)
        self.assert_near(cpu, compute)

    def test_figures_are_the_same_with_any_threads(self):
        figures = []
        for threads in ('1', '2', '2'):
            done = self.run_it('collision', 'taylor_green', '--coarse', '--quiet', '--threads', threads, '--json', 'out.json')
            self.assertEqual(done.returncode, 0, done.stderr)
            figures.append([(c['case'], c['metric'], c['method'], c['value'], c['error']) for c in self.figures()])
        self.assertEqual(figures[0], figures[1])
        self.assertEqual(figures[1], figures[2])


if __name__ == '__main__':
    command.main()
