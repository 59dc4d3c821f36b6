"""What is kept of a scene as it stands: a scene file, and the scene in a picture."""
import json
import math
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_handles import VIEW, pixel
from test_window import STILL, Window

SETTINGS = ['--set', 'fluids[0].viscosity=0.3', '--set', 'gravity=[0, -3.3333333333333335, 0.1]', '--set', 'view.kind=splat',
            '--particles', '300', '--set', 'view.camera={from: [2, 2, 2], to: [0, 0.1, 0]}']


HANDS = STILL + VIEW.replace('kind: slice', 'kind: spheres') + """\
touch: {radius: 1.5}
solids: # above the fluid
  - box: {centre: [-0.3, 0.7, 0], size: [0.2, 0.2, 0.2]}
  - sphere: {centre: [0, 0.7, 0], radius: 0.1}
  - mesh: {file: closed.obj, centre: [0.3, 0.7, 0], scale: 0.3}
"""
# A tetrahedron.
CLOSED = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n'


class SavedScene(Window):
    def ok(self, *arguments):
        code, said = self.slosh(*arguments)
        self.assertEqual(code, 0, said)

    def settings(self, *arguments):
        self.ok('info', *arguments, '--json', 'info.json', '--quiet')
        return json.loads(self.read('info.json'))['scene']['settings']

    def picture(self, *arguments, carries=True):
        self.ok('render', *arguments, '-o', 'p.png', '--time', '0.1', '--size', '160x120', '--quiet', '--set', f'view.carries_scene={str(carries).lower()}')
        return self.read('p.png')

    def test_command(self):
        """The same settings, the same picture; comments stay, and no file is written over."""
        self.write('still.yaml', STILL.replace('0.1}\n', '0.1} # wide\n', 1))
        self.ok('info', 'still.yaml', *SETTINGS, '--save', 'b.yaml', '--quiet')
        self.assertIn('# wide', self.read('b.yaml').decode())
        self.assertEqual(self.settings('still.yaml', *SETTINGS), self.settings('b.yaml'))
        self.assertEqual(self.picture('still.yaml', *SETTINGS, carries=False), self.picture('b.yaml', carries=False))
        code, said = self.slosh('info', 'still.yaml', '--save', 'b.yaml', '--quiet')
        self.assertEqual((code, said.strip()), (1, 'b.yaml: is there already; name another file'))
        self.assertEqual(self.slosh('info', '--save', 'b.yaml', '--quiet')[0], 2)

    def test_window(self):
        self.write('still-2.yaml', 'mine')
        self.open('still.yaml')
        self.drag(1, [(240, 180), (300, 150)])
        self.keys('space', 's', 'w', 'ctrl+shift+s', 'ctrl+shift+s')
        self.rest()
        out = self.quit()
        self.assertEqual(self.read('still-2.yaml'), b'mine')
        settings = self.settings('still-3.yaml')
        self.assertEqual(settings['views[0].color_by']['value'], 'density')
        self.assertEqual(settings['views[0].camera.from']['value'], [float(f'{x:.9g}') for x in out['camera_from']])
        self.assertNotEqual(settings['views[1].kind']['value'], out['view'])
        self.assertEqual(settings, self.settings('still-4.yaml'))

    def test_picture(self):
        """A picture carries its scene, settings and camera; cut or without it, that is said."""
        self.open('still.yaml', '--set', 'fluids[0].viscosity=0.25')
        self.drag(1, [(240, 180), (300, 150)])
        self.keys('space', 's', 'i')
        self.rest()
        out = self.quit()
        shot, = self.files('png')
        data = self.read(shot)
        self.assertNotIn(self.folder.encode(), data)
        settings = self.settings(shot)
        self.assertEqual(settings['fluids[0].viscosity']['value'], 0.25)
        self.assertEqual(settings['view.camera.from']['value'], [float(f'{x:.9g}') for x in out['camera_from']])
        self.open(shot)
        again = self.quit()
        self.assertEqual((again['camera_from'], again['color_by']), (out['camera_from'], 'density'))
        self.assertIn(f'{shot}: a picture of still.yaml at', self.messages)

        self.picture('still.yaml')
        self.assertEqual(self.settings('p.png'), self.settings('still.yaml'))
        self.picture('still.yaml', carries=False)
        self.refused('p.png', 'the picture carries no scene; pictures of slosh do')
        self.write('cut.png', data[:150])
        self.refused('cut.png', 'a cut or damaged picture: the file ends too early')
        at = data.index(b'slosh scene') + 40
        self.write('forged.png', data[:at] + b'x' + data[at + 1:])
        self.refused('forged.png', 'a cut or damaged picture: ')

    def test_hands(self):
        """By real events a solid is moved and turned, one taken out and one put, the box made larger, gravity tilted: the saved
        scene begins so, in another folder too, and goes on so when its file is written again."""
        os.mkdir(self.path('scenes'))
        self.write('scenes/hands.yaml', HANDS)
        self.write('scenes/closed.obj', CLOSED)
        self.ok('info', 'scenes/hands.yaml', '--quiet')
        self.open('scenes/hands.yaml', '--record', 'a.rec')
        self.keys('shift+q', 'q')  # hold
        self.drag(1, [pixel([x, 0.7, 0]) for x in (-0.3, -0.35, -0.38)])
        self.runs(0.3)  # it comes there
        self.drag(3, [pixel([x, 0.7, 0]) for x in (-0.38, -0.36, -0.3)])
        self.drag(1, [pixel([x, 0.61, -0.09]) for x in (0.21, 0.23, 0.25)])
        self.at(*pixel([0, 0.7, 0]))
        self.keys('0', '1', 'ctrl+equal')
        self.display.press('ctrl')
        self.drag(1, [(200, 180), (220, 180), (240, 180)], 'shift')
        self.display.release('ctrl')
        self.runs(0.3)
        self.keys('ctrl+shift+s')
        self.write('scenes/hands.yaml', HANDS.replace('dt: 0.01', 'dt: 0.008'))
        self.wait_for(lambda: b'hands.yaml was saved: ' in self.read('said.txt'), self.process)
        self.keys('Escape')  # puts the tool away
        out = self.quit()
        self.assertEqual(out['scenes_opened'], 1, self.messages)
        text = self.read('a.rec').decode()
        moved = {}
        for solid, words in re.findall(r'^\d+ solid move (\d) (.*)$', text, re.M):
            moved[int(solid)] = [float.fromhex(word) for word in words.split()]
        gravity = json.loads('[' + re.findall(r'^\d+ set gravity=\[(.*)\]$', text, re.M)[-1] + ']')
        self.assertIn('hands-2.yaml: the scene with ', self.messages)
        saved = self.settings('hands-2.yaml')
        value = {path: setting['value'] for path, setting in saved.items()}
        self.assertEqual(value['box.size'], [1.05] * 3)
        self.assertEqual(value['gravity'], gravity)
        turn = moved[0][3:]
        angle = 2 * math.degrees(math.atan2(math.hypot(*turn[:3]), turn[3]))
        for path, expected in (('solids[0].box.centre', [-0.3 + moved[0][0], 0.7 + moved[0][1], moved[0][2]]),
                               ('solids[0].box.angle', [angle]),
                               ('solids[1].mesh.centre', [0.3 + moved[2][0], 0.7 + moved[2][1], moved[2][2]])):
            found = value[path] if isinstance(value[path], list) else [value[path]]
            for a, b in zip(found, expected):
                self.assertAlmostEqual(a, b, 5, path)
        self.assertGreater(angle, 5)
        self.assertLess(moved[0][0], -0.05)
        self.assertEqual((value['solids[2].sphere.radius'], value['solids[2].density']), (0.16, 500))
        self.assertNotIn('solids[3].sphere.radius', value)

    def refused(self, name, words):
        code, said = self.slosh('info', name, '--quiet')
        self.assertEqual(code, 2)
        self.assertIn(f'{name}: {words}', said)

    def test_no_paths(self):
        """Of files that the scene names by whole paths the picture has the names."""
        self.write('h.csv', 'x,height\n-0.5,0.2\n0.5,0.4\n')
        self.write('t.yaml', STILL.replace('max: [0.5, 0.4, 0.5]}', f'max: [0.5, 0.4, 0.5]}}, below: {self.path("h.csv")}'))
        self.picture('t.yaml')
        self.assertNotIn('slosh-test', self.slosh('info', 'p.png', '--save', 'u.yaml', '--quiet')[1])
        self.assertIn('"h.csv"', self.read('u.yaml').decode())


if __name__ == '__main__':
    command.main('SavedScene.test_command SavedScene.test_no_paths', 'SavedScene.test_window', 'SavedScene.test_picture',
                 'SavedScene.test_hands')
