"""The backend fragment as a user meets it: what differs from the others."""
import json
import os
import re
import shutil

import command
from command import CommandTest

SHADERS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'shaders')
ON = ['--backend', 'fragment']


class Fragment(CommandTest):
    def test_run_and_resume_give_the_same_bits(self):
        run = lambda out, time, *more: self.slosh('run', 'scene.yaml', *ON, '-o', out, '--time', time, '--every', '0.02',
                                                  *more)
        self.assertEqual(run('a.h5part', '0.06')[0], 0)
        self.assertEqual(run('b.h5part', '0.04')[0], 0)
        self.assertEqual(run('b.h5part', '0.06', '--resume')[0], 0)
        for name in ['a', 'b']:
            code, said = self.slosh('export', f'{name}.h5part', '-o', f'{name}.ply')
            self.assertEqual(code, 0, said)
        self.assertEqual(self.read('a.ply'), self.read('b.ply'))

    def test_lost_particles_end_the_run(self):
        """At once, in the last good state: a smaller step would not mend it."""
        code, said = self.slosh('run', 'overfull', *ON, '-o', 'out.h5part', '--time', '0.1', '--set',
                                'solver.lost_limit=0')
        self.assertEqual(code, 1, said)
        self.assertRegex(said, r'3,\d{3} particles found no place in the grid of backend fragment; raise '
                               r'solver.grid_layers \(1\) or solver.lost_limit \(0\)')
        self.assertNotIn('halved', said)
        code, said = self.slosh('export', 'out.h5part', '-o', 'last.ply')
        self.assertEqual(code, 0, said)

    def test_lost_particles_are_shown(self):
        code, said = self.slosh('bench', 'overfull', *ON, '--view', 'none', '--frames', '1', '--json', 'b.json', '--set',
                                'solver.step.substeps=2')
        self.assertEqual(code, 0, said)
        (bench,) = json.loads(self.read('b.json'))
        lost = bench['lost']
        self.assertGreater(lost, 3500)
        self.assertEqual(bench['outcome'], 'leaks')
        self.assertRegex(bench['outcome_words'], r'\d+ of 8192 particles have no place in the grid')
        code, said = self.slosh('run', 'overfull', *ON, '-o', 'out.h5part', '--time', '0.02', '--quiet')
        found = re.search(r't = .*: (\d+) of 8192 particles find no place in the grid', said)
        self.assertTrue(found and abs(int(found.group(1)) - lost) < 0.05 * lost, said)  # of another step

    def refused(self, exit_code, words, scene, *arguments):
        """Before anything starts: nothing is created."""
        before = self.entries()
        code, said = self.slosh('run', scene, *ON, '-o', 'out.h5part', '--time', '0.1', *arguments)
        self.assertEqual(code, exit_code, said)
        self.assertRegex(said, words)
        self.assertEqual(self.entries(), before)

    def test_what_it_cannot_do_is_said(self):
        self.refused(2, 'backend fragment has no solids; use backend compute or cpu', 'pillar')
        self.refused(2, 'backend fragment has no implicit viscosity; use backend compute or cpu', 'scene.yaml', '--set',
                     'solver.viscosity=implicit')
        self.refused(2, 'backend fragment has no method wcsph', 'scene.yaml', '--method', 'wcsph')
        self.refused(1, 'holds up to 16777216 particles', 'scene.yaml', '--particles', '20000000')

        self.refused(2, 'backend fragment has no method pbf; use backend compute or cpu\n', 'scene.yaml', '--method', 'pbf')

    def test_bench_refuses_before_it_measures(self):
        code, said = self.slosh('bench', 'scene.yaml', 'fountain', *ON, '--view', 'none', '--json', 'b.json')
        self.assertEqual(code, 2, said)
        self.assertEqual(self.entries(), [])

    def test_a_broken_shader_is_named(self):
        shutil.copytree(SHADERS, self.path('shaders'))
        with open(self.path('shaders/sim/mueller/force.frag'), 'a') as file:
            file.write('float broken = ;\n')
        lines = self.read('shaders/sim/mueller/force.frag').count(b'\n')
        self.refused(1, rf'sim/mueller/force.frag:{lines}: .*syntax error', 'scene.yaml', '--shaders', 'shaders')


if __name__ == '__main__':
    command.main()
