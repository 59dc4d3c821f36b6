"""Several views in the window, by real events: keys, clicks, cameras, files, sizes."""
import numpy

import command
from test_window import Window, png_size

LEFT, RIGHT = (120, 180), (360, 180)  # in the panels of 480 x 360
COARSE = '--set', 'view.volume.cells=16'


class Views(Window):
    def picture(self):
        """The window as it is on the screen."""
        wide = self.display.connection.create_resource_object('window', self.window).get_geometry()
        data = self.display.picture(self.window)
        return numpy.frombuffer(data, dtype='u1').reshape(-1, min(wide.width, 480), 4)[:, :, :3]

    def click(self, x, y):
        self.drag(1, [(x, y), (x, y)])

    def two_are_there(self):
        """A dark line between the panels, and a frame around the chosen one."""
        two = self.picture().astype(int)  # BGR
        blue = two[:, :, 0] > two[:, :, 2] + 60
        return two[180, 239:241].max() < 60 and blue[:, :2].sum() > 300

    def test_one_two_four_and_back(self):
        self.open('still.yaml', '--set', 'view.legend=false')
        self.keys('space', 'w')
        self.wait_for(self.two_are_there, self.process)
        self.keys('F12', 'w', 'w')
        out = self.quit()
        self.assertEqual((out['views'], out['chosen_view']), (1, 0), self.messages)
        self.assertEqual(png_size(self.read(self.files('png')[0])), (480, 360))

    def test_what_acts_acts_on_the_panel_that_was_clicked(self):
        """Each goes from speed to density by itself; cameras go together."""
        self.open('still.yaml')
        self.keys('w')
        self.drag(1, [LEFT, (130, 180), (160, 190)])
        self.click(*RIGHT)
        self.keys('s')
        self.click(*LEFT)
        self.keys('s')
        self.click(*RIGHT)
        out = self.quit()
        self.assertEqual((out['views'], out['chosen_view'], out['color_by'], out['view']), (2, 1, 'density', 'splat'))
        self.assertEqual((self.messages.count('coloured by density\n'), self.messages.count('coloured by')), (2, 2), self.messages)
        self.assertFalse(out['camera_auto'], 'that of the right one went along')

    def test_cameras_that_are_free(self):
        self.open('still.yaml')
        self.keys('w', 'shift+w')
        self.drag(1, [LEFT, (130, 180), (160, 190)])
        self.click(*RIGHT)
        out = self.quit()
        self.assertEqual((out['chosen_view'], out['camera_auto']), (1, True))

    def test_a_drag_turns_the_camera_of_the_panel_it_begins_in(self):
        """And chooses the panel, which stays in sight where fewer are shown."""
        self.open('still.yaml', '--set', 'views=[{}, {}, {}, {}]')  # all cheap to draw
        self.keys('shift+w')
        self.drag(1, [(360, 270), (370, 270), (400, 280)])
        self.keys('s', 'w', 'w')
        out = self.quit()
        self.assertEqual((out['views'], out['chosen_view'], out['color_by'], out['camera_auto']), (2, 1, 'density', False))
        self.assertLess(out['camera_from'][0], 0.9)

    def test_the_camera_begins_where_it_was(self):
        """Though the legend of the other panel is wider than that of the one under the mouse."""
        self.open('still.yaml', '--set', 'views=[{color_by: fluid}, {color_by: speed, range: [0, 1]}]')
        self.keys('space')
        self.settled()
        before = self.picture()
        self.at(*LEFT)
        self.drag(4, [LEFT])
        self.drag(5, [LEFT])  # nearer, and back
        self.at(100, 60)  # the sky, which has no value to show
        self.settled()
        moved = numpy.abs(self.picture().astype(int) - before.astype(int)).max(axis=2) > 40
        self.assertFalse(self.quit()['camera_auto'])
        self.assertLess(int(moved.sum()), 200, 'pixels of edges, no more')

    def test_a_scenes_own_views(self):
        self.open('still.yaml', '--set', 'views=[{}, {kind: slice, color_by: density}, {kind: volume}]', *COARSE, '--set',
                  'solver.backend=compute')
        self.click(360, 90)
        out = self.quit()
        self.assertEqual((out['views'], out['chosen_view'], out['view'], out['color_by']), (3, 1, 'slice', 'density'))

    def test_settings_and_a_run_beside_the_scene(self):
        """Each at its first state at or after the scene's, as `render` draws them, forth and back."""
        code, said = self.slosh('run', 'still.yaml', '-o', 'run.h5part', '--time', '0.3', '--every', '0.03', '--quiet')
        self.assertEqual(code, 0, said)
        views = ('--set', 'views=[{}, {set: {solver.step.dt: 0.015, gravity: [3, -9, 0]}}, {file: run.h5part, kind: splat, quality: good}]')
        self.open('still.yaml', *views)
        self.keys('space', 'period', 'period')
        for keys in ([], ['comma', 'comma'], ['r', 'period', 'period', 'period', 'period']):
            before = self.files('png')
            self.keys(*keys)
            self.settled()
            self.keys('F12')
            self.wait_for(lambda: len(self.files('png')) > len(before), self.process)
            name, = set(self.files('png')) - set(before)
            last = self.read(name)
        out = self.quit()
        time = out['time']
        self.assertAlmostEqual(time, 0.04)
        self.assertEqual([round(at, 6) for at in out['times']], [0.04, 0.045, 0.06])
        code, said = self.slosh('render', 'still.yaml', '-o', 'at.png', '--time', '0.04', '--size', '480x360', '--quiet', *views)
        self.assertEqual(code, 0, said)
        self.assertEqual(last, self.read('at.png'))

    def without_a_number(self):
        """Pixels of the right panel in the colour of no number."""
        blue, green, red = numpy.moveaxis(self.picture()[:, 240:].astype(int), 2, 0)
        return ((red > green + 80) & (blue > green + 80)).sum()

    def test_scalars_of_what_a_panel_shows(self):
        """Accelerations are kept with solvers side by side too; S goes through what one plays with."""
        self.open('still.yaml', '--set', 'views=[{}, {set: {solver.method: dfsph}, color_by: acceleration_x}]')
        self.click(*RIGHT)
        self.wait_for(lambda: self.without_a_number() < 20, self.process)
        self.keys('s')
        out = self.quit()
        self.assertEqual((out['chosen_view'], out['color_by']), (1, 'speed'))
        self.assertNotIn('stays while', self.messages)

    def test_sizes_and_other_scenes(self):
        self.open('still.yaml', *COARSE)
        self.keys('w', 'w')
        for width, height in (301, 203), (2, 2), (1, 1), (3, 301), (401, 300):
            self.xdo('windowsize', self.window, width, height)
            self.until(lambda now, height=height: now['size'][1] == height)  # of few pixels there is no picture to wait for
        self.drawn()
        self.keys('F12', 'Tab', 'w', 'r')
        out = self.quit()
        self.assertEqual(out['size'], [401, 300])
        self.assertEqual(out['views'], 2)
        self.assertEqual(png_size(self.read(self.files('png')[0])), (401, 300))


if __name__ == '__main__':
    command.main()
