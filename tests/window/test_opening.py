"""What a scene shows when it opens: its name at once, time that waits for the picture, and what can be done."""
import os
import sys

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import HEIGHT, STILL, WIDTH, Window

WEIGHTLESS = '--set', 'gravity=[0, 0, 0]'


class Opening(Window):
    def dark(self):
        """The share of the window's lower third that lies under a box with words."""
        picture = numpy.frombuffer(self.display.picture(self.window), 'u1').reshape(HEIGHT, WIDTH, 4)
        return (picture[2 * HEIGHT // 3:, :, :3].max(axis=2) < 80).mean()

    def begins(self, simulated):
        now = self.until(lambda now: now['time'] > 0.1)
        self.assertAlmostEqual(now['time'], now['simulated_seconds'] - simulated, delta=1e-6)  # of pictures' time

    def test_time_begins_with_the_first_picture(self):
        self.write('zz.yaml', STILL)
        self.open('still.yaml')
        self.begins(0)
        self.keys('space', 'Tab')  # paused, it stays so
        self.opened(2)
        there = self.rest()
        self.assertEqual(there['time'], 0)
        self.key('space')
        self.begins(there['simulated_seconds'])

    def test_its_name_stands_there_before_the_fluid(self):
        self.start('still.yaml', '--particles', '100000', '--set', 'view.kind=spheres')
        seen = []
        self.wait_for(lambda: seen.append(self.dark()) or seen[-1] > 0.02, self.process)
        self.assertLess(self.figures()['pictures'], 1)

    def test_what_it_is_about_until_a_key_is_pressed(self):
        self.write('told.yaml', '# Nothing moves here, and all is calm.\n#\n# A second paragraph.\n' + STILL)
        self.open('told.yaml', *WEIGHTLESS)
        self.wait_for(lambda: self.dark() > 0.1, self.process)
        self.key('shift')
        self.wait_for(lambda: self.dark() < 0.05, self.process)


if __name__ == '__main__':
    command.main('Opening.test_time_begins_with_the_first_picture', 'Opening.test_its_name_stands_there_before_the_fluid',
                 'Opening.test_what_it_is_about_until_a_key_is_pressed')
