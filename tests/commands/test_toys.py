"""A method and a view that the program does not have (tests/sim/toy_method.h, tests/render/toy_view.h), linked to it:
nothing else names them, and each command knows them."""
import json
import os
import re
import subprocess
import sys

import command
from command import CommandTest
from test_window import Window

TESTS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

TOYS = """\
box: {size: [1, 1, 1]}
particles: {spacing: 0.1}
fluids: [{fill: [{block: {min: [-0.4, 0, -0.4], max: [0.2, 0.5, 0.4]}}]}]
solver: {method: toy, springs: 20, step: {dt: 0.004, substeps: 2}}
view: {kind: toy, toy: {shade: 0.25}}
"""
SHADE = 137  # sRGB of 0.25

RECORDING = """\
slosh recording 1
program {}
scene toys.yaml
text
{}commands
20 set solver.springs=200
20 set view.toy.shade=1
end 40 {}
"""


def middle(path):
    """The pixel in the middle of an image."""
    pixels = subprocess.run(['ffmpeg', '-v', 'error', '-i', path, '-vf', 'crop=1:1', '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-'],
                            capture_output=True, check=True).stdout
    return list(pixels)


def without_usual(said):
    """What is left of the lines: springs keep particles neither apart nor slow nor together, which is told rightly."""
    return re.sub(r'^(renderer:|t = [0-9.]+ s: (clumps|too fast|boils):) .*\n', '', said, flags=re.M)


class Toys(CommandTest):
    def setUp(self):
        super().setUp()
        self.write('toys.yaml', TOYS)

    def said(self, *arguments):
        return subprocess.run([command.PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, check=True).stdout

    def do(self, *arguments):
        """The command goes well and has nothing to complain of."""
        code, said = self.slosh(*arguments, '--quiet')
        self.assertEqual((code, without_usual(said)), (0, ''), arguments)

    def test_each_is_one_small_file(self):
        for name in ('sim/toy_method.h', 'render/toy_view.h'):
            with open(os.path.join(TESTS, name)) as file:
                self.assertLessEqual(len(file.readlines()), 60, name)

    def test_they_are_listed(self):
        self.do('info', '--json', 'a.json')
        info = json.loads(self.read('a.json'))
        self.assertEqual(info['methods'][-1], {'name': 'toy', 'help': 'springs that harden'})
        self.assertEqual(info['views'][-2], {'name': 'toy', 'help': 'one shade for all of the fluid'})
        keys = self.said('help', 'keys')
        self.assertRegex(keys, r'`solver\.springs` .*\| yes \| toy: stiffness when new')
        self.assertRegex(keys, r'`view\.toy\.shade` .*\| yes \| from black to white')
        scene = self.said('info', 'toys.yaml')
        self.assertIn('solver.springs = 20', scene)
        self.assertIn('view.toy.shade = 0.25', scene)

    def test_a_run_goes_on(self):
        import h5py
        self.do('run', 'toys.yaml', '-o', 'a.h5part', '--time', '0.08', '--every', '0.04')
        self.do('run', 'toys.yaml', '-o', 'b.h5part', '--time', '0.04', '--every', '0.04')
        self.do('run', 'toys.yaml', '-o', 'b.h5part', '--time', '0.08', '--every', '0.04', '--resume')
        with h5py.File(self.path('a.h5part')) as a, h5py.File(self.path('b.h5part')) as b:
            self.assertEqual((len(a), len(b)), (3, 3))
            for field in a['Step#2']:
                self.assertEqual(a['Step#2'][field][:].tobytes(), b['Step#2'][field][:].tobytes(), field)
            self.assertGreater(a['Step#2']['age'][:].max(), 10)
        code, said = self.slosh('run', 'toys.yaml', '-o', 'b.h5part', '--time', '1', '--resume', '--set', 'solver.springs=21')
        self.assertEqual(code, 2, said)
        self.assertIn('solver.springs', said)

    def test_it_draws(self):
        self.do('render', 'toys.yaml', '-o', 'a.png', '--time', '0', '--size', '256x256')
        self.assertEqual(middle(self.path('a.png')), [SHADE] * 3)
        self.do('render', 'scene.yaml', '-o', 'b.png', '--time', '0', '--size', '256x256', '--view', 'toy',
                '--set', 'view.toy.shade=0')
        self.assertEqual(middle(self.path('b.png')), [0] * 3)

    def test_bench_has_them(self):
        self.do('bench', 'scene.yaml', '--method', 'toy', '--view', 'toy', '--frames', '1', '--size', '32x32',
                '--json', 'a.json')
        (row,) = json.loads(self.read('a.json'))
        self.assertEqual((row['method'], row['view']), ('toy', 'toy'))

    def test_a_session_is_replayed(self):
        scene = ''.join(f'| {line}\n' for line in TOYS.splitlines())
        version = self.said('--version').split()[1]
        self.write('a.rec', RECORDING.format(version, scene, '0' * 16))
        self.slosh('replay', 'a.rec', '--quiet', '--json', 'a.json')
        value = json.loads(self.read('a.json'))['hash']
        self.write('a.rec', RECORDING.format(version, scene, value))
        self.do('replay', 'a.rec')
        self.write('b.rec', self.read('a.rec').replace(b'springs=200', b'springs=201'))
        code, said = self.slosh('replay', 'b.rec', '--quiet')
        self.assertEqual(code, 1)
        self.assertIn('different after 40 steps', said)

    def test_keys_that_nothing_reads(self):
        code, said = self.slosh('run', 'toys.yaml', '-o', 'a.h5part', '--time', '0', '--method', 'mueller', '--quiet')
        self.assertEqual((code, said), (0, 'toys.yaml:4:23: solver.springs has no effect; it needs solver.method: toy\n'))
        code, said = self.slosh('render', 'scene.yaml', '-o', 'a.png', '--time', '0', '--size', '32x32', '--quiet',
                                '--set', 'view.toy.shade=1')
        self.assertEqual(code, 0)
        self.assertIn('--set view.toy.shade=1: view.toy.shade has no effect; it needs view.kind: toy\n', said)


class InTheWindow(Window):
    def test_it_draws_and_is_recorded(self):
        self.write('toys.yaml', TOYS)
        self.start('toys.yaml', '--record', 'a.rec')
        shade = bytes([SHADE] * 3)
        self.wait_for(lambda: shade * 20 in self.display.picture(self.window).replace(b'\xff', b''), self.process)
        self.quit()
        code, said = self.slosh('replay', 'a.rec', '--quiet')
        self.assertEqual((code, without_usual(said)), (0, ''))


if __name__ == '__main__':
    sys.argv[1] = os.environ['SLOSH_WITH_TOYS']
    command.main()
