"""Backends on a GPU as a user meets them: the commands that run them, and what is said where they cannot."""
import json
import os
import re
import resource
import shutil

import command
from command import CommandTest, obey_interrupts

SHADERS = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'shaders')
ON = ['--backend', 'compute', '--set', 'solver.reproducible=true']


class Gpu(CommandTest):
    def test_run_and_resume_give_the_same_bits(self):
        """Stopped half way and gone on, as without a stop; with a solver that iterates."""
        run = lambda out, time, *more: self.slosh('run', 'scene.yaml', *ON, '-o', out, '--time', time, '--every', '0.02',
                                                  '--set', 'solver.viscosity=implicit', '--set', 'fluids[0].viscosity=5', '--json', out + '.json', *more)
        self.assertEqual(run('a.h5part', '0.1')[0], 0)
        self.assertEqual(run('b.h5part', '0.06')[0], 0)
        self.assertEqual(run('b.h5part', '0.1', '--resume')[0], 0)
        for name in ['a', 'b']:
            code, said = self.slosh('export', f'{name}.h5part', '-o', f'{name}.ply')
            self.assertEqual(code, 0, said)
        self.assertEqual(self.read('a.ply'), self.read('b.ply'))
        result = json.loads(self.read('a.h5part.json'))
        self.assertEqual(result['backend'], 'compute')
        self.assertGreater(result['viscosity_iterations_mean'], 0.5)

    def test_render_draws_what_the_cpu_draws(self):
        for backend in ['cpu', 'compute']:
            code, said = self.slosh('render', 'scene.yaml', '--backend', backend, '-o', f'{backend}.png', '--time', '0.05',
                                    '--size', '160x120', '--set', 'view.range=[0, 1]')
            self.assertEqual(code, 0, said)
            self.assertIn('renderer:', said)
        self.assertLess(abs(len(self.read('cpu.png')) - len(self.read('compute.png'))), 100)

    def test_bench_times_its_stages_on_the_gpu(self):
        code, said = self.slosh('bench', 'scene.yaml', '--backend', 'compute', '--view', 'none', '--frames', '3',
                                '--clock', 'finish', '--json', 'b.json')
        self.assertEqual(code, 0, said)
        result = json.loads(self.read('b.json'))[0]
        self.assertEqual({s['name']: s['clock'] for s in result['stages']},
                         dict.fromkeys(['grid', 'density', 'force', 'integrate'], 'finish'))
        self.assertGreater(min(s['median_ms'] for s in result['stages']), 0)
        self.assertAlmostEqual(sum(s['share'] for s in result['stages'] if s['part'] == 'sim'), 1, 6)  # all that the GPU did
        self.assertEqual((result['upload_ms'], result['render_ms']), (0, 0))
        self.assertIsNone(result['gl']['picture'])
        substep = result['gl']['substep']
        self.assertTrue(50 < substep['calls'] < 150 and 5 < substep['dispatches'] < 15 and substep['readbacks'] == 0, substep)
        self.assertTrue(0 < result['sim_ms'] <= result['frame_ms'], result)

    def refused(self, code, words, *arguments):
        """Before anything starts: nothing is created."""
        before = self.entries()
        got, said = self.slosh('run', 'scene.yaml', '-o', 'out.h5part', '--time', '0.1', *arguments)
        self.assertEqual(got, code, said)
        self.assertRegex(said, words)
        self.assertEqual(self.entries(), before)

    def test_what_it_cannot_do_is_said(self):
        self.refused(2, "solver.backend.*'gpu'", '--backend', 'gpu')
        self.refused(1, 'there is no GPU 15', *ON, '--gpu', '15')
        if re.search('renderer: .*; software: [^;]+$', self.slosh('run', 'scene.yaml', *ON, '-o', 'a.h5part', '--time', '0.01')[1], re.M):
            self.refused(1, 'there is no GPU 0: .*; without --gpu a software driver will do', *ON, '--gpu', '0')
        self.refused(1, r'needs a buffer of \d+ bytes for this scene, and this driver allows shaders \d+', *ON, '--particles', '20000000')

    def test_a_gl_error_is_no_success(self):
        """A call that the driver refuses: the uniform that it sets is of another type."""
        shutil.copytree(SHADERS, self.path('shaders'))
        shader = self.path('shaders/common/particles.glsl')
        with open(shader, encoding='utf-8') as file:
            text = file.read()
        with open(shader, 'w', encoding='utf-8') as file:
            file.write(re.sub(r'(#define \w+_stride) (particle_strides\[\d\])', r'\1 uint(\2)',
                              text.replace('uniform uint particle_strides', 'uniform float particle_strides')))
        done = self.start('render', 'scene.yaml', '-o', 'a.png', '--time', '0', '--size', '64x64', '--shaders', 'shaders')
        said = done.communicate(timeout=command.PATIENCE)[1]
        self.assertEqual(done.returncode, 1, said)
        self.assertRegex(said, 'GL error: \\d+ in all; what was drawn or computed may be wrong')

    def test_a_broken_shader_is_named(self):
        shutil.copytree(SHADERS, self.path('shaders'))
        with open(self.path('shaders/sim/compute/kick.comp'), 'a') as file:
            file.write('float broken = ;\n')
        lines = self.read('shaders/sim/compute/kick.comp').count(b'\n')
        self.refused(1, rf'sim/compute/kick.comp:{lines}: .*syntax error', *ON, '--shaders', 'shaders')
        os.remove(self.path('shaders/sim/compute/drift.comp'))
        self.refused(1, 'drift.comp', *ON, '--shaders', 'shaders')

    def test_short_memory_is_said(self):
        """The program starts, and what it then asks for is not there; a driver that dies of it is not ours."""
        def limit():
            obey_interrupts()
            resource.setrlimit(resource.RLIMIT_AS, (1200 << 20, 1200 << 20))
        if self.slosh('--version', before=limit)[0] != 0:
            self.skipTest('a sanitizer needs more memory than that before anything starts')
        before = self.entries()
        code, said = self.slosh('run', 'scene.yaml', *ON, '--particles', '4000000', '-o', 'out.h5part', '--time', '0.1',
                                before=limit)
        self.assertEqual(code, 1, said)
        self.assertRegex(said, 'memory')
        self.assertEqual(self.entries(), before)

    def test_trouble_leaves_the_last_good_state(self):
        """The snapshots that are written are sound, and the last good state is kept."""
        code, said = self.slosh('run', 'scene.yaml', *ON, '-o', 'out.h5part', '--time', '1', '--set',
                                'solver.sound_speed=5000', '--set', 'solver.step.retries=1')
        self.assertEqual(code, 1, said)
        self.assertRegex(said, 'blew up')
        code, said = self.slosh('export', 'out.h5part', '-o', 'last.ply')
        self.assertEqual(code, 0, said)
        self.assertNotIn(b'nan', self.read('last.ply').lower())


if __name__ == '__main__':
    command.main()
