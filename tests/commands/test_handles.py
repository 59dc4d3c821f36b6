"""Handles in the window: what a view lets the mouse take, by real events under a virtual display."""
import math
import re

import h5py
import numpy

import command
from test_window import STILL, Window

WIDTH, HEIGHT = 480, 360
FOV = 40
EYE, TO = numpy.array([1.5, 1.1, 2.6]), numpy.array([0, 0.4, 0])
VIEW = f"""\
view:
  kind: slice
  legend: false
  camera: {{from: {list(EYE)}, to: {list(TO)}, fov: {FOV}}}
  slice: {{point: [0, 0.3, 0], normal: [0.6, 0, 0.8]}}
"""
DIAGONAL = math.sqrt(3)  # of the box
ARROW, RING = 0.22 * DIAGONAL, 0.09 * DIAGONAL


LEFT, RIGHT = (0, 239), (241, 239)  # panels: where they begin, and how wide they are


def pixel(place, panel=(0, WIDTH)):
    """Where a place of a box that stands still is in the picture."""
    back = (EYE - TO) / numpy.linalg.norm(EYE - TO)
    right = numpy.cross([0, 1, 0], back)
    right /= numpy.linalg.norm(right)
    up = numpy.cross(back, right)
    away = numpy.asarray(place, float) - EYE
    scale = HEIGHT / 2 / math.tan(math.radians(FOV / 2)) / -(away @ back)
    return round(panel[0] + panel[1] / 2 + scale * (away @ right)), round(HEIGHT / 2 - scale * (away @ up))


class Handles(Window):
    def setUp(self):
        super().setUp()
        self.write('slice.yaml', STILL + VIEW)
        self.point, self.normal = numpy.array([0, 0.3, 0]), numpy.array([0.6, 0, 0.8])

    def settings(self):
        """What the view shows in the end; nothing but the view may have changed."""
        out = self.quit()
        self.assertEqual(out['box_position'], [0, 0, 0])
        numpy.testing.assert_allclose(out['camera_from'], EYE)
        own = {path.split('.')[-1]: setting['value'] for path, setting in out['view_settings'].items()}
        return numpy.array(own['point']), numpy.array(own['normal']), own

    def way(self, *places, panel=(0, WIDTH)):
        self.drag(1, [pixel(place, panel) for place in places])

    def test_the_dot_shifts_the_plane_along_its_normal(self):
        self.open('slice.yaml')
        self.way(*(self.point + by * self.normal for by in (0, 0.05, 0.12, 0.2)))
        point, normal, _ = self.settings()
        numpy.testing.assert_allclose(point, self.point + 0.2 * self.normal, atol=0.02)  # a pixel is 6 mm, and the normal looks at the eye
        numpy.testing.assert_allclose(normal, self.normal)

    def test_the_arrow_turns_the_plane(self):
        end = self.point + ARROW * self.normal
        wanted = numpy.array([0.8, 0.36, 0.48])
        self.open('slice.yaml')
        self.way(end, self.point + ARROW * (wanted + self.normal) / 2, self.point + ARROW * wanted)
        point, normal, _ = self.settings()
        numpy.testing.assert_allclose(point, self.point, atol=1e-9)
        numpy.testing.assert_allclose(normal, wanted, atol=0.03)

    def test_the_ring_shifts_the_handles_within_the_plane(self):
        along = numpy.array([0.8, 0, -0.6])
        grip = self.point + RING * along
        self.open('slice.yaml')
        self.way(grip, grip + [0, 0.05, 0], grip + [0, 0.15, 0])
        point, normal, _ = self.settings()
        numpy.testing.assert_allclose(point, self.point + [0, 0.15, 0], atol=0.015)
        self.assertAlmostEqual((point - self.point) @ self.normal, 0, 5)

    def test_beside_the_handles_the_camera_turns(self):
        self.open('slice.yaml')
        self.drag(1, [(20, 120), (50, 140), (90, 160)])
        out = self.quit()
        self.assertGreater(numpy.linalg.norm(out['camera_from'] - EYE), 0.1)
        self.assertEqual(out['view_settings']['view.slice.point']['value'], [0, 0.3, 0])

    def test_with_shift_the_box_moves_though_a_handle_is_there(self):
        self.open('slice.yaml')
        at = pixel(self.point)
        self.drag(1, [at, (at[0] + 20, at[1]), (at[0] + 40, at[1])], 'shift')
        out = self.quit()
        self.assertNotEqual(out['box_position'], [0, 0, 0])
        self.assertEqual(out['view_settings']['view.slice.point']['value'], [0, 0.3, 0])

    def test_keys_move_the_plane(self):
        self.open('slice.yaml')
        self.keys('k', 'k', 'j')
        point, normal, _ = self.settings()
        extent = 0.6 + 0.8  # of the box along the normal
        numpy.testing.assert_allclose(point, self.point + 0.02 * extent * self.normal, atol=1e-5)
        numpy.testing.assert_allclose(normal, self.normal)

    def test_keys_set_and_turn_the_plane(self):
        """Through the middle of the fluid, which fills the box to 0.4 m."""
        self.open('slice.yaml')
        self.keys('z', 'u')
        point, normal, _ = self.settings()
        numpy.testing.assert_allclose(point, [0, 0.2, 0], atol=0.01)
        numpy.testing.assert_allclose(normal, [-math.sin(math.pi / 36), 0, math.cos(math.pi / 36)], atol=1e-5)

    def test_a_view_without_a_plane_says_so(self):
        self.open('still.yaml')
        self.keys('k')
        self.quit()
        self.assertIn('spheres shows no plane that could be moved; these do: slice', self.messages)

    def test_a_click_gives_a_particle_a_trail(self):
        """The nearest one to the eye under the mouse, in views of particles; a right click or E, and once more takes it away.
        Neither moves the camera."""
        self.write('still.yaml', STILL + VIEW.replace('kind: slice', 'kind: spheres'))
        self.open('still.yaml', '--set', 'gravity=[0, 0, 0]')
        self.keys('space')
        for place in ([0.25, 0.35, 0.45], [-0.25, 0.35, 0.45]):  # of the nearest layer
            self.drag(3, [pixel(place)])
        self.keys('e', 'e')
        self.at(5, 5)
        self.keys('e')
        out = self.quit()
        numpy.testing.assert_allclose(out['camera_from'], EYE)
        found = re.findall(r'particle (\d+) has (a trail|no trail any more)', self.messages)
        self.assertEqual([words for _, words in found], ['a trail', 'a trail', 'no trail any more', 'a trail'])
        ids = [int(id) for id, _ in found]
        self.assertEqual(ids[1:], [ids[1]] * 3)
        self.assertIn('there is no particle under the mouse', self.messages)
        code, said = self.slosh('run', 'still.yaml', '-o', 'a.h5part', '--time', '0')
        self.assertEqual(code, 0, said)
        with h5py.File(self.path('a.h5part'), 'r') as file:
            for id, place in zip(ids, ([0.25, 0.35, 0.45], [-0.25, 0.35, 0.45])):
                i = numpy.flatnonzero(file['Step#0']['id'][:] == id)[0]
                self.assertLess(numpy.linalg.norm([file['Step#0'][axis][i] for axis in 'xyz'] - numpy.array(place)), 0.09)

    def test_two_pins_within_one_picture(self):
        """Both presses come before the next picture, which knows the values: both places are kept."""
        self.open('slice.yaml', '--set', 'view.color_by=density', '--set', 'view.slice.normal=[0.6, 0, 0.8]')
        self.keys('space')
        window = self.display.connection.create_resource_object('window', self.window)
        self.at(*pixel([0, 0.2, 0]))
        for place in ([0.08, 0.2, -0.06], [-0.16, 0.15, 0.12]):
            window.warp_pointer(*pixel(place))
            self.key('m')
        self.drawn()
        out = self.quit()
        self.assertEqual([probe['pinned'] for probe in out['readout']], [True, True, False])

    def test_the_value_under_the_mouse_and_at_pins(self):
        first, second = [0.08, 0.2, -0.06], [-0.16, 0.15, 0.12]  # on the plane
        self.open('slice.yaml', '--set', 'view.color_by=density', '--set', 'view.slice.normal=[0.6, 0, 0.8]')
        self.keys('space')  # what is still is drawn anew for the mouse
        self.at(WIDTH // 2, HEIGHT - 25)  # the time line's, from which it jumps into the picture
        for place in (first, second):
            self.at(*pixel(place))
            self.keys('m')
        self.at(*pixel([0.2, 0.9, -0.15]))
        self.drawn()
        out = self.quit()
        self.assertEqual([probe['pinned'] for probe in out['readout']], [True, True, False])
        self.assertEqual([probe['what'] for probe in out['readout']], ['value', 'value', 'empty'])
        for probe, place in zip(out['readout'], (first, second, [0.2, 0.9, -0.15])):
            self.assertEqual((probe['name'], probe['unit']), ('density', 'kg/m3'))
            numpy.testing.assert_allclose(probe['at'], place, atol=0.01)
        for probe in out['readout'][:2]:
            self.assertAlmostEqual(probe['value'], 1000, delta=50)

    def test_pins_are_of_the_plane_and_are_taken_away(self):
        self.environment['force_gl_renderer'] = 'hardware'  # what is found comes a picture later, of a fluid that moves
        self.open('slice.yaml')
        self.at(*pixel([0.08, 0.2, -0.06]))
        self.keys('m', 'k')
        self.at(5, 5)
        self.keys('m')  # there is nothing
        self.drawn()
        self.keys('space')
        out = self.quit()
        self.assertEqual([(probe['pinned'], probe['what']) for probe in out['readout']], [(True, 'off')])
        self.assertIn('there is no value under the mouse', self.messages)
        self.open('slice.yaml')
        self.at(*pixel([0.08, 0.2, -0.06]))
        self.keys('m', 'shift+m')
        self.at(5, 5)
        self.drawn()
        self.assertEqual(self.quit()['readout'], [])

    def test_a_plane_that_is_taken_stands_still(self):
        self.open('slice.yaml', '--set', 'view.slice.play=0.05', '--set', 'view.slice.normal=[0, 1, 0]')
        self.keys('k')
        point, _, own = self.settings()
        self.assertEqual(own['play'], 0)
        self.assertGreater(point[1], 0.32)

    def two(self, second, *arguments):
        self.open('slice.yaml', '--set', 'views=[{}, %s]' % second, *arguments)

    def test_a_handle_is_dragged_in_the_panel_under_the_mouse(self):
        other, way = numpy.array([0, 0.45, 0]), (0, 0.05, 0.12, 0.2)
        for last in RIGHT, LEFT:
            self.two('{slice: {point: [0, 0.45, 0], normal: [0.6, 0, 0.8]}}')
            self.way(*(other + by * self.normal for by in way), panel=RIGHT)
            self.drag(1, [(last[0] + 10, 10)])  # a click beside the handles chooses
            point, normal, _ = self.settings()
            expected = other + 0.2 * self.normal if last is RIGHT else self.point
            numpy.testing.assert_allclose(point, expected, atol=0.02)
            numpy.testing.assert_allclose(normal, self.normal)

    def test_a_handle_in_the_hand_stays_though_the_mouse_leaves_its_panel(self):
        self.two('{kind: spheres}')
        self.keys('space')
        at = pixel(self.point, LEFT)
        self.drag(1, [at, (at[0] - 20, at[1]), (200, at[1]), (300, at[1]), (at[0], at[1])])
        out = self.quit()
        self.assertEqual(out['chosen_view'], 0)
        numpy.testing.assert_allclose(out['camera_from'], EYE)
        numpy.testing.assert_allclose(out['view_settings']['view.slice.point']['value'], self.point, atol=0.02)

    def test_values_are_of_the_panel_under_the_mouse_and_pins_of_all(self):
        pinned, free = [0.08, 0.2, -0.06], [-0.16, 0.15, 0.12]  # on the plane
        self.two('{color_by: density}')
        self.keys('space')
        self.at(*pixel(pinned, RIGHT))
        self.keys('m')
        self.at(*pixel(free, LEFT))
        self.drawn()
        out = self.quit()
        self.assertEqual([(probe['pinned'], probe['name']) for probe in out['readout']],
                         [(True, 'speed'), (False, 'speed')])
        for probe, place in zip(out['readout'], (pinned, free)):
            numpy.testing.assert_allclose(probe['at'], place, atol=0.01)
        top = [0, 0.4, 0.3]  # of the fluid
        self.two('{kind: spheres, color_by: density}', '--set', 'gravity=[0, 0, 0]')  # no ball leaves its place, however late the key
        self.keys('space')
        self.at(*pixel(top, RIGHT))
        self.keys('m')
        self.drawn()
        out = self.quit()
        self.assertEqual([(probe['what'], probe['name'], probe['pinned']) for probe in out['readout']],
                         [('value', 'density', True), ('value', 'density', False)])
        pinned, free = out['readout']
        self.assertGreaterEqual(free['id'], 0)
        for key in ('id', 'at', 'value'):  # the ball's centre is pinned
            self.assertEqual(pinned[key], free[key])
        self.assertAlmostEqual(free['value'], 1000, delta=200)
        numpy.testing.assert_allclose(free['at'], top, atol=0.11)


if __name__ == '__main__':
    command.main()
