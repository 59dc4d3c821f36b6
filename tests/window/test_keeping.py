"""What is kept of a scene as it stands: a scene file, and the scene in a picture."""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import STILL, Window

SETTINGS = ['--set', 'fluids[0].viscosity=0.3', '--set', 'gravity=[0, -3.3333333333333335, 0.1]', '--set', 'view.kind=splat',
            '--particles', '300', '--set', 'view.camera={from: [2, 2, 2], to: [0, 0.1, 0]}']


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
        self.shown(0.1)
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
        self.shown(0.2)
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
    command.main('SavedScene.test_command SavedScene.test_no_paths', 'SavedScene.test_window', 'SavedScene.test_picture')
