"""What help says a command takes, it takes; and how the program is called by others."""
import json
import os
import re
import subprocess

import command
from command import CommandTest

SHADERS = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), 'shaders')

# A device that is plugged in and says nothing.
DEVICE = 'slosh device recording 1\n0.000000 1 plugged dualsense 054c:0ce6 usb test\n0.100000 1 unplugged\n'

# A value for each option; None: it takes none.
VALUES = {
    '--time': '0.004', '--frames': '1', '--fps': '250', '--every': '0.004', '--size': '32x32', '--resume': None, '--forces': 'forces.csv', '--probes': 'probes.csv',
    '--set': 'gravity=[0, -5, 0]', '--particles': '100', '--backend': 'cpu', '--method': 'mueller', '--view': 'spheres',
    '--simd': 'baseline', '--threads': '1', '--gpu': '0', '--shaders': SHADERS, '--device': 'file:device.rec', '--mapping': 'mapping.yaml',
    '--json': 'out.json', '--quiet': None, '--clock': 'finish', '--sweep': 'threads=1', '--frame': 'world',
    '--surface': None, '--level': '0.5', '--cell': '1', '--color-by': 'speed', '--record': 'out.rec', '--past': '64', '--watch': None,
    '--seconds': '1', '--coarse': None, '--error': '90', '--frame-ms': '33', '--full': None, '--interpolate': None, '--steps': None, '--help': None,
    '--compare': 'view.colormap=viridis,gray', '--preset': 'honey', '--save': 'saved.yaml'}

# What does not go with the rest, or needs a display: by command.
APART = {'bench': {'--play', '--micro', '--ablate', '--seconds', '--table', '-o'},
         'export': {'--slice', '--trails', '--scalar', '--kernel', '--raw', '--size',  # test_slice.py, test_export.py
                    '--solids', '--fluids'},  # test_meshes.py
         'render': {'--steps'},  # in place of --interpolate: test_steps.py
         'devices': {'--mapping', '--write-mapping', '--record'}}


class Help(CommandTest):
    def listed(self, name):
        text = subprocess.run([command.PROGRAM, 'help', name], capture_output=True, text=True, check=True).stdout
        return re.findall(r'^  (--?[a-z-]+) ', text, re.M)

    def check(self, name, *arguments, output=()):
        """The command with all options that its help lists."""
        arguments = [name, *arguments, *output]
        for option in self.listed(name):
            if option in ('-o', '--help') or option in APART.get(name, ()):
                continue
            value = VALUES[option]
            arguments += [option] if value is None else [option, value]
        code, said = self.slosh(*arguments)
        if 'there is no GPU 0' in said:  # test_gpu.py has that message
            at = arguments.index('--gpu')
            code, said = self.slosh(*arguments[:at], *arguments[at + 2:])
        self.assertEqual(code, 0, f'{arguments}: {said}')

    def test_every_option_that_help_lists_works(self):
        self.write('device.rec', DEVICE)
        self.assertEqual(self.slosh('devices', '--write-mapping', 'mapping.yaml')[0], 0)
        self.write('scene.yaml', command.SCENE + 'probes: [{name: a, point: {at: [0, 0, 0]}}]\n')
        self.check('run', 'scene.yaml', output=['-o', 'out.h5part'])
        self.check('render', 'scene.yaml', output=['-o', 'out'])
        self.check('bench', 'scene.yaml')
        self.check('info', 'scene.yaml')
        self.check('export', 'out.h5part', output=['-o', 'out.ply'])
        self.check('devices')


class Name(CommandTest):
    def test_ps_shows_its_name(self):
        """Though it runs itself again, by a link of another name, to bound the spinning of idle threads."""
        free = {k: v for k, v in os.environ.items() if k not in ('OMP_WAIT_POLICY', 'GOMP_SPINCOUNT')}
        process = subprocess.Popen([command.PROGRAM, 'run', 'scene.yaml', '-o', 'out.h5part', '--time', '1000'], cwd=self.folder,
                                   stderr=subprocess.DEVNULL, env=free)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.wait_for(self.entries, process)
        with open(f'/proc/{process.pid}/comm') as file:
            self.assertEqual(file.read(), 'slosh\n')


class Counted(CommandTest):
    """One thread is no threads."""
    ONE = ['--threads', '1', '--frames', '1', '--view', 'none']

    def test_words_that_are_counted(self):
        done = subprocess.run([command.PROGRAM, 'bench', 'scene.yaml', *self.ONE, '--json', 'b.json'], cwd=self.folder,
                              capture_output=True, text=True, check=True)
        self.assertIn(' 1 thread, ', done.stdout)
        table = subprocess.run([command.PROGRAM, 'bench', '--table', 'paper003-spheres', '--backend', 'cpu', '--view', 'spheres',
                                '--size', '32x32', '--threads', '1', '--frames', '1'], cwd=self.folder,
                               capture_output=True, text=True, check=True)
        self.assertRegex(table.stdout, '1 thread; 32 x 32; medians of 1 frame,')

    def test_bench_says_what_it_measured_on(self):
        self.slosh('bench', 'scene.yaml', *self.ONE, '--json', 'b.json')
        (result,) = json.loads(self.read('b.json'))
        self.assertRegex(result['compiler'], r'^\w+ \d+\.\d+')
        self.assertIn('-ffp-contract=off', result['options'])
        with open('/proc/cpuinfo') as file:
            self.assertIn(result['processor'], file.read())


class Tables(CommandTest):
    def test_all_are_named_whole(self):
        help_ = subprocess.run([command.PROGRAM, 'help', 'bench'], capture_output=True, text=True, check=True).stdout
        names = re.search(r'--table NAME .*: (.*)', help_)[1].split(', ')
        self.assertIn('paper003-voxelize', names)
        code, said = self.slosh('bench', '--table', 'nosuch')
        self.assertEqual(code, 2)
        self.assertEqual(re.findall(r'^  (\S+) ', said, re.M), names)
        self.assertIn('where the slice is drawn\n', said)


if __name__ == '__main__':
    command.main()
