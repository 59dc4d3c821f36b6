"""A picture that rests is drawn once more, as a file would have it; so is a screenshot."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import HEIGHT, STILL, WIDTH, Window

LOOK = 'view: {kind: volume, legend: false, volume: {look: water, cells: %d}}\n'


class AtRest(Window):
    def shot(self):
        self.keys('F12')
        self.wait_for(lambda: self.files('png'), self.process)
        self.drawn()
        name = self.files('png')[0]
        found = command.without_text(self.read(name))
        os.remove(self.path(name))
        return found

    def in_file(self, scene):
        code, said = self.slosh('render', scene, '-o', 'a.png', '--time', '0', '--size', f'{WIDTH}x{HEIGHT}', '--quiet')
        self.assertEqual(code, 0, said)
        return command.without_text(self.read('a.png'))

    def test_what_rests_is_as_in_files_and_so_is_a_screenshot(self):
        self.write('water.yaml', STILL + 'gravity: [0, 0, 0]\n' + LOOK % 32)
        self.open('water.yaml')
        self.keys('space', 'r')
        draft = self.display.picture(self.window)
        self.assertNotEqual(draft, self.settled())
        self.assertFalse(self.figures()['finer_to_come'])
        drawn = self.figures()['pictures']
        rests, in_file = self.shot(), self.in_file('water.yaml')
        self.assertEqual(rests, in_file)
        self.assertEqual(self.figures()['pictures'], drawn)  # it was there
        self.keys('a')  # the camera as it is: a draft, then the same again
        self.assertEqual(self.shot(), in_file)
        self.keys('space')
        self.until(lambda now: now['steps'] > 3)
        self.assertGreater(len(self.shot()), 0)  # of a fluid that moves
        self.quit()

    def test_who_names_a_quality_keeps_it(self):
        self.write('water.yaml', STILL + LOOK % 32)
        self.open('water.yaml', '--set', 'view.quality=draft')
        self.keys('space')
        self.assertFalse(self.figures()['finer_to_come'])
        self.quit()


if __name__ == '__main__':
    command.main()
