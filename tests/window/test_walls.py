"""The walls of the box by the mouse and by keys: commands that are recorded, replayed and undone."""
import math
import os
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), '..', 'commands'))
import command
from test_handles import EYE, VIEW, pixel
from test_window import STILL, Window

ARROW = 0.08 * math.sqrt(3)


class Walls(Window):
    def setUp(self):
        super().setUp()
        self.write('walls.yaml', STILL + VIEW.replace('kind: slice', 'kind: spheres'))

    def recorded(self):
        """The sizes of the saved session."""
        name, = self.files('recording')
        self.assertEqual(self.slosh('replay', name, '--quiet'), (0, ''))
        lines = re.findall(r'^\d+ size (\S+) (\S+) (\S+)$', self.read(name).decode(), re.M)
        return [[float.fromhex(word) for word in line] for line in lines]

    def test_an_arrow_takes_its_wall_along(self):
        self.open('walls.yaml')
        self.keys('shift+b')
        self.drag(1, [pixel([x, 0.5, 0]) for x in (0.5 + ARROW, 0.48 + ARROW, 0.45 + ARROW)])
        self.until(lambda now: now['box_size'][0] < 0.92)
        self.runs(0.3)  # and no farther
        self.keys('ctrl+s')
        self.wait_said('the session')
        out = self.quit()
        self.assertEqual((out['box_position'], out['camera_auto']), ([0, 0, 0], False))
        for a, b in zip(out['camera_from'], EYE):
            self.assertAlmostEqual(a, b)
        sizes = self.recorded()
        self.assertGreater(len(sizes), 10)  # step by step
        self.assertAlmostEqual(sizes[-1][0], 0.9, delta=0.02)
        self.assertEqual([size[1:] for size in sizes], [[1, 1]] * len(sizes))
        self.assertEqual(sorted(sizes, reverse=True), sizes)

    def test_keys_make_it_larger_and_smaller(self):
        self.open('walls.yaml')
        self.keys('ctrl+equal', 'ctrl+minus')
        self.runs(0.3)
        self.keys('space', 'ctrl+s')
        self.wait_said('the session')
        self.keys('Home', 'shift+comma')  # a second back: it is undone
        self.rest()
        self.quit()
        first, *smaller = self.recorded()
        self.assertEqual(first, [1.05, 1.05, 1.05])
        self.assertGreater(len(smaller), 2)  # step by step
        self.assertEqual(sorted([first, *smaller], reverse=True), [first, *smaller])
        self.assertGreater(smaller[-1][0], 0.95)
        self.assertRegex(self.messages, r'the box: 1\.05 x 1\.05 x 1\.05 m(.|\n)*the box: (0\.99\d|1) x ')

    def test_a_full_box_says_so_once(self):
        self.write('walls.yaml', (STILL + VIEW).replace('kind: slice', 'kind: spheres').replace('0.4, 0.5]', '0.97, 0.5]'))
        self.open('walls.yaml')
        self.keys('shift+b')
        self.drag(1, [pixel([x, 0.5, 0]) for x in (0.5 + ARROW, 0.48 + ARROW, 0.45 + ARROW, 0.4 + ARROW, 0.3 + ARROW)])
        self.wait_said('no room in a smaller box')
        self.runs(0.3)
        self.quit()
        self.assertEqual(self.messages.count('no room in a smaller box'), 1)

    def test_open_sides_stay(self):
        self.write('open.yaml', STILL.replace('[1, 1, 1]}', '[1, 1, 1], periodic: [x, y, z]}\ngravity: [0, 0, 0]').replace('0.4,', '1,'))
        self.open('open.yaml')
        self.keys('shift+b')
        self.quit()
        self.assertIn('the walls of this box are open: it keeps its size', self.messages)


if __name__ == '__main__':
    command.main('Walls.test_an_arrow_takes_its_wall_along', 'Walls.test_a_full_box_says_so_once',
                 'Walls.test_keys_make_it_larger_and_smaller Walls.test_open_sides_stay')
