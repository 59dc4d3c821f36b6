"""A box that has left the picture: an arrow and words say where it is and how it comes back."""
import os
import sys

import numpy

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_window import HEIGHT, STILL, WIDTH, Window

VIEW = 'view: {kind: spheres, legend: false, camera: {from: [0, 0.5, 3], to: [0, 0.5, 0], fov: 30}}\n'
ARROW = (255, 194, 61)


class Lost(Window):
    def arrow(self):
        """Where the arrow is, from left to right: 0 to 1; None where there is none."""
        picture = numpy.frombuffer(self.display.picture(self.window), 'u1').reshape(HEIGHT, WIDTH, 4)
        at = numpy.nonzero((abs(picture[:, :, 2::-1].astype(int) - ARROW) < 12).all(axis=2))
        return at[1].mean() / WIDTH if len(at[1]) > 20 else None

    def test_an_arrow_shows_the_way_and_a_shows_the_box(self):
        self.write('near.yaml', STILL + VIEW)
        self.open('near.yaml', '--set', 'gravity=[0, 0, 0]')
        self.assertIsNone(self.arrow())
        for _ in range(3):
            self.drag(1, [(60, 200), (200, 200), (400, 200)], 'shift')
        self.wait_for(lambda: (self.arrow() or 0) > 0.9, self.process)
        self.keys('a')
        self.assertTrue(self.figures()['camera_auto'])
        self.wait_for(lambda: self.arrow() is None, self.process)
        self.keys('b')
        self.until(lambda now: abs(now['box_position'][0]) < 1e-3)
        self.keys('a')
        out = self.quit()
        self.assertFalse(out['camera_auto'])  # its own camera sees it again


if __name__ == '__main__':
    command.main()
