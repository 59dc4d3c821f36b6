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

    def picture(self, *arguments):
        self.ok('render', *arguments, '-o', 'p.png', '--time', '0.1', '--size', '160x120', '--quiet')
        return self.read('p.png')

    def test_command(self):
        """The same settings, the same picture; comments stay, and no file is written over."""
        self.write('still.yaml', STILL.replace('0.1}\n', '0.1} # wide\n', 1))
        self.ok('info', 'still.yaml', *SETTINGS, '--save', 'b.yaml', '--quiet')
        self.assertIn('# wide', self.read('b.yaml').decode())
        self.assertEqual(self.settings('still.yaml', *SETTINGS), self.settings('b.yaml'))
        self.assertEqual(self.picture('still.yaml', *SETTINGS), self.picture('b.yaml'))
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


if __name__ == '__main__':
    command.main()
