"""A method, a view, an effect, a command, formats, an experiment and an action that the program does not have
(tests/sim/toy_method.h, tests/render/toy_view.h, tests/render/toy_effect.h, tests/app/toy_command.h, tests/app/toy_format.h,
tests/app/toy_experiment.h, tests/app/toy_action.h), linked to it: nothing else names them, and the program knows them."""
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


def pixel(path, x, y):
    return middle(path, f'crop=1:1:{x}:{y}')


def middle(path, crop='crop=1:1'):
    """The pixel in the middle of an image."""
    pixels = subprocess.run(['ffmpeg', '-v', 'error', '-i', path, '-vf', crop, '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-'],
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
        for name, most in (('sim/toy_method.h', 60), ('render/toy_view.h', 60), ('render/toy_effect.h', 60), ('app/toy_command.h', 60), 
                           ('app/toy_format.h', 60), ('app/toy_action.h', 60), ('app/toy_experiment.h', 150)):
            with open(os.path.join(TESTS, name)) as file:
                self.assertLessEqual(len(file.readlines()), most, name)

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

    def test_the_command(self):
        """Help, manual page, completion and messages come from the rows."""
        self.assertEqual(self.said('toy', '--sides', '12', '--word=ab'), '14\n')
        self.assertIn('  slosh toy       [OPTIONS]', self.said('help'))
        self.assertIn('  --sides N              of the die (6)\n', self.said('help', 'toy'))
        self.assertIn('\\fB\\-\\-word\\fR \\fITEXT\\fR\na word more\n', self.said('help', 'man'))
        self.assertIn("    toy)\n        offered='--sides --word --quiet --help '", self.said('help', 'bash'))
        code, said = self.slosh('toy', '--sides', '1')
        self.assertEqual((code, said), (2, 'slosh toy: --sides must be 2 to 20, not 1\n'))
        code, said = self.slosh('run', 'toys.yaml', '--sides', '3')
        self.assertEqual((code, said), (2, "slosh run: unknown option '--sides', which is one of slosh toy; `slosh help run` lists its own\n"))

    def test_the_formats(self):
        """One file, a series, the list, the messages."""
        self.do('run', 'toys.yaml', '-o', 'a.h5part', '--time', '0.04', '--every', '0.04')
        self.do('export', 'a.h5part', '-o', 'a.xyz', '--time', '0')
        lines = self.read('a.xyz').decode().splitlines()
        self.assertEqual((int(lines[0]), lines[1]), (len(lines) - 2, '0 s, frame of the box'))
        self.assertGreater(len(lines), 100)
        self.do('export', 'a.h5part', '-o', 'b.xyz.series')
        files = json.loads(self.read('b.xyz.series'))['files']
        self.assertEqual([file['name'] for file in files], ['b/b-0000.xyz', 'b/b-0001.xyz'])
        self.assertEqual(self.read('b/b-0000.xyz'), self.read('a.xyz'))
        self.do('info', '--json', 'a.json')
        self.assertIn({'name': 'xyz', 'help': 'one snapshot as atoms'}, json.loads(self.read('a.json'))['exports'])
        code, said = self.slosh('export', 'a.h5part', '-o', 'a.abc')
        self.assertEqual((code, said.splitlines()[-1]), (2, "cannot tell the format from 'a.abc'; use .pvd, .vtp, .ply, .ply.series, "
                                                         '.obj, .obj.series, .xyz or .xyz.series'))
        code, said = self.slosh('export', 'a.h5part', '-o', 'a.xyz', '--color-by', 'speed')
        self.assertEqual(code, 2)

    def test_the_format_of_a_video(self):
        self.do('render', 'toys.yaml', '-o', 'a.mkv', '--frames', '2', '--fps', '25', '--set', 'solver.step.dt=0.01', '--size', '65x33')
        probe = ['ffprobe', '-v', 'error', '-count_frames', '-show_entries', 'stream=codec_name,width,height,nb_read_frames', '-of', 'csv=p=0']
        self.assertEqual(subprocess.run([*probe, self.path('a.mkv')], capture_output=True, text=True, check=True).stdout.strip(), 'ffv1,65,33,2')
        self.do('info', '--json', 'a.json')
        self.assertEqual(json.loads(self.read('a.json'))['pictures'][-1], {'name': 'mkv', 'help': 'a video without loss'})
        code, said = self.slosh('render', 'toys.yaml', '-o', 'a.abc')
        self.assertEqual((code, said), (2, "cannot tell the format from 'a.abc'; use .png, .mp4, .gif, .mkv or a folder name\n"))

    def test_the_experiment(self):
        """Trials are kept; a second run makes damaged trials alone; table, chart, JSON, files and messages."""
        words = ['calm', 'scene.yaml', '-o', 'a.svg', '--time', '0.02']
        said = self.said(*words, '--json', 'a.json')
        runs = json.loads(self.read('a.json'))['runs']
        self.assertEqual([run['spacing'] for run in runs], sorted((run['spacing'] for run in runs), reverse=True))
        self.assertEqual(said, ''.join(f"{run['spacing']:8.4g} m {run['energy']:12.4g} J\n" for run in runs))
        self.assertIn('energy of motion, J', self.read('a.svg').decode())
        rows = self.read('a.csv').decode()
        self.assertRegex(rows, r'\Akey,spacing_m,energy_j\n([0-9a-f]{16},[0-9.]+,[0-9.e-]+\n){3}\Z')
        code, told = self.slosh(*words)
        self.assertEqual((code, told), (0, '3 of 3 runs are in a.csv already\n'))
        self.assertEqual(self.read('a.csv').decode(), rows)
        damaged = rows.splitlines(keepends=True)
        damaged[2] = re.sub(',[^,]*\n', ',-1\n', damaged[2])
        self.write('a.csv', ''.join(damaged))
        code, told = self.slosh(*words)
        self.assertIn('a.csv:3: this energy_j is none that slosh calm writes; the row is left out, its run made again\n', told)
        self.assertEqual((code, sorted(self.read('a.csv').decode().splitlines())), (0, sorted(rows.splitlines())))
        self.write('a.csv', 'day,rain\n')
        code, told = self.slosh(*words, '--quiet', '--json', 'a.json')
        self.assertEqual((code, told), (1, 'a.csv: is there already, and no slosh calm wrote it; give the chart another name, or move that file\n'))
        self.assertEqual(json.loads(self.read('a.json')), {'command': 'calm', 'scene': 'scene.yaml', 'output': 'a.svg', 'error': told[:-1]})
        self.assertEqual(self.slosh('calm', 'scene.yaml', '-o', 'a.gif')[0], 2)

    def test_the_action(self):
        """The action is in the help of the window and in a file of mappings."""
        self.assertIn('\n| `count` | F8 | tell how many particles are shown |\n', self.said('help', 'window'))
        self.write('m.yaml', 'dualsense:\n  buttons: {circle: count}\n')
        self.assertIn('  circle         tell how many particles are shown\n', self.said('devices', '--mapping', 'm.yaml'))

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

    def test_the_effect(self):
        """A strip along the lower edge, of pictures of best quality alone."""
        for quality, strip in (('best', 188), ('good', SHADE)):
            self.do('render', 'toys.yaml', '-o', 'a.png', '--time', '0', '--size', '64x64', '--set', f'view.quality={quality}',
                    '--set', 'view.camera={from: [0, 0.5, 0.1], to: [0, 0.5, -1]}', '--set', 'view.legend=false')
            self.assertEqual(pixel(self.path('a.png'), 32, 60), [strip] * 3, quality)
            self.assertEqual(pixel(self.path('a.png'), 32, 40), [SHADE] * 3, quality)

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

    def test_a_key_gives_the_action(self):
        self.start('scene.yaml')
        self.keys('F8')
        self.wait_for(lambda: re.search(r'^[1-9][0-9]* particles are shown$', self.said_now(), re.M), self.process)
        self.quit()


if __name__ == '__main__':
    sys.argv[1] = os.environ['SLOSH_WITH_TOYS']
    command.main()
