"""The list of scenes: titles, ideas, small pictures and the page that shows them."""
import json
import math
import os
import re
import subprocess

import command
from command import CommandTest

SMALL = command.SCENE.replace('spacing: 0.1', 'spacing: 0.25')


class Scenes(CommandTest):
    def listed(self, *arguments):
        return subprocess.run([command.PROGRAM, 'scenes', *arguments], cwd=self.folder, capture_output=True, text=True, check=True).stdout

    def test_each_scene_that_comes_with_slosh_has_a_title_and_an_idea(self):
        text = self.listed()
        self.assertRegex(text, r'(?m)^dam_break +Dam break\n +A column of water, twice as high as wide, whose dam is gone at once\.$')
        rows = json.loads(self.listed('--json', '-'))
        self.assertGreater(len(rows), 25)
        for row in rows:
            self.assertTrue(row['idea'].endswith('.') and row['title'] != row['name'], row)
            self.assertTrue(os.path.isabs(row['path']) and os.path.exists(row['path']), row)

    def test_no_text_of_a_file_is_obeyed_by_a_terminal(self):
        """Names of files and comments, at which YAML does not look."""
        os.mkdir(self.path('own'))
        self.write('own/\x1b[2Ja.yaml', '# One \x1b]0;b\x07idea.\n' + SMALL.replace('title: A small tank', ''))
        self.assertEqual(self.listed('own'), f'{"?[2Ja":13} ?[2Ja\n{"":13} One ?]0;b?idea.\n')

    def test_pictures_and_a_page(self):
        one = 'a#b? 50%&c:é'  # each of them means something in an address
        os.mkdir(self.path('own'))
        self.write(f'own/{one}.yaml', '# One <idea>, over\n# two lines. Another sentence.\n' + SMALL)
        self.write('own/broken.yaml', 'title: "Tools & more"\nbox: {size: 7}\n')
        code, said = self.slosh('scenes', 'own', '-o', 'out')
        self.assertEqual(code, 1)
        self.assertRegex(said, r'(?m)^broken: no picture: own/broken.yaml:2:')
        self.assertIn('out/index.html: 2 scenes, 1 picture made, 0 kept\n', said)
        self.assertEqual(sorted(os.listdir(self.path('out'))), sorted(['index.html', f'{one}.png']))
        page = self.read('out/index.html').decode()
        self.assertIn('<b>A small tank</b><br>One &lt;idea>, over two lines.<br><code>slosh a#b? 50%&amp;c:é</code>', page)
        self.assertIn('<b>Tools &amp; more</b>', page)
        self.assertEqual(re.findall('src="(.*?)"', page), ['a%23b%3F%2050%25%26c%3A%C3%A9.png'])
        os.remove(self.path('own/broken.yaml'))
        before = os.stat(self.path(f'out/{one}.png')).st_mtime_ns
        code, said = self.slosh('scenes', 'own', '-o', 'out')
        self.assertEqual((code, said.splitlines()[-1]), (0, 'out/index.html: 1 scene, 0 pictures made, 1 kept'))
        self.assertEqual(os.stat(self.path(f'out/{one}.png')).st_mtime_ns, before)
        os.utime(self.path(f'out/{one}.png'), (1e9, 1e9))  # older than its scene
        self.assertIn('1 picture made, 0 kept', self.slosh('scenes', 'own', '-o', 'out')[1])

    def test_what_is_no_folder_of_scenes(self):
        os.mkdir(self.path('empty'))
        for name, words in ('nosuch', 'nosuch: No such file or directory'), ('empty', 'empty: no scene (*.yaml) is there'):
            self.assertEqual(self.slosh('scenes', name), (2, words + '\n'))


class New(CommandTest):
    def test_the_smallest_scene_runs_and_says_what_each_line_is(self):
        self.assertEqual(self.slosh('new', 'my.yaml'),
                         (0, 'my.yaml: a scene with a comment on each line; change it, and open it by: slosh my.yaml\n'))
        lines = self.read('my.yaml').decode().splitlines()
        self.assertLess(len(lines), 25)
        self.assertEqual([line for line in lines if '#' not in line], [])
        code, said = self.slosh('run', 'my.yaml', '-o', 'out.h5part', '--time', '0.1', '--quiet')
        self.assertEqual((code, said), (0, ''))  # nothing is to be said of it
        listed = subprocess.run([command.PROGRAM, 'scenes', '.'], cwd=self.folder, capture_output=True, text=True, check=True).stdout
        self.assertRegex(listed, r'my +My scene\n +A block of water falls apart: the smallest scene\.\n')

    def test_what_is_there_stays(self):
        self.write('my.yaml', 'mine')
        self.assertEqual(self.slosh('new', 'my.yaml'), (1, 'my.yaml: is there already; name a new file\n'))
        self.assertEqual(self.read('my.yaml'), b'mine')
        self.assertEqual(self.slosh('new', 'my.yml'), (2, 'my.yml: the name of a scene ends in .yaml\n'))
        self.assertEqual(self.entries(), ['my.yaml'])


class Streams(CommandTest):
    def gaps_and_widths(self, *more):
        """Of the light oil's stream in `bowl`: the widest gap along it in spacings, and its widths at the top and below."""
        import h5py
        import numpy
        code, said = self.slosh('run', 'bowl', '-o', 'out.h5part', '--time', '0.8', '--every', '0.8', '--quiet', *more)
        self.assertEqual(code, 0, said)
        with h5py.File(self.path('out.h5part')) as file:
            last = file[sorted(file, key=lambda name: int(name.rpartition('#')[2]))[-1]]
            x, y, z, fluid = (numpy.array(last[name]) for name in ('x', 'y', 'z', 'fluid'))
        stream = (fluid == 0) & (y > 0.16)
        widths = [numpy.std(z[stream & (y > low) & (y < low + 0.03)]) for low in (0.25, 0.17)]
        return numpy.diff(numpy.sort(y[stream])).max() / 0.009, *widths

    def test_a_stream_stays_whole_and_becomes_thinner(self):
        gap, top, below = self.gaps_and_widths()
        self.assertLess(gap, 0.7)
        self.assertLess(below, 0.8 * top)
        self.assertGreater(self.gaps_and_widths('--set', 'solver.surface_tension=none')[0], 1.2)


class Sample(CommandTest):
    def test_the_recording_of_a_motion_device_holds_the_tray_level(self):
        import h5py
        sample = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), 'scenes/tilt.rec')
        leans = []
        for more in ([], ['--device', 'file:' + sample]):
            code, said = self.slosh('run', 'level', '-o', 'out.h5part', '--particles', '700', '--time', '6.4', '--every', '0.4', '--quiet', *more)
            self.assertEqual(code, 0, said)
            with h5py.File(self.path('out.h5part')) as file:
                poses = [file[f'Step#{k}'].attrs['box_orientation'] for k in range(4, 17)]
            leans.append(max(2 * math.degrees(math.asin(math.hypot(x, z))) for x, _, z, _ in poses))
        self.assertGreater(leans[0], 7)
        self.assertLess(leans[1], 3)


if __name__ == '__main__':
    command.main()
