"""A recorded run in the window, driven by real key and mouse events."""
import os

import h5py

import command
from test_window import HEIGHT, WIDTH, Window


class PlayerTest(Window):
    def record(self, *more, name='a.h5part', seconds='0.4', every='0.04'):
        code, said = self.slosh('run', 'scene.yaml', '-o', name, '--time', seconds, '--every', every, '--quiet', *more)
        self.assertEqual(code, 0, said)

    def picture_at(self, at, *more, source='a.h5part'):
        code, said = self.slosh('render', source, '-o', 'at.png', '--time', str(at), '--size', f'{WIDTH}x{HEIGHT}', '--quiet',
                                *more)
        self.assertEqual(code, 0, said)
        picture = self.read('at.png')
        os.remove(self.path('at.png'))
        return picture

    def shoot(self):
        """What the window shows, but for what lies over it."""
        before = self.files('png')
        self.keys('F12')
        self.wait_for(lambda: len(self.files('png')) > len(before), self.process)
        name, = set(self.files('png')) - set(before)
        return self.read(name)

    def assert_time(self, at, *more):
        """When the thread that reads the step has done so."""
        self.rest()
        self.assertEqual(self.shoot(), self.picture_at(at, *more), at)


class Time(PlayerTest):
    def test_steps(self):
        """Each of them as `render` draws it: forth, back, to the ends."""
        self.record()
        self.open('a.h5part')
        self.keys('space', 'r')
        self.assert_time(0)
        self.keys('period', 'period')
        self.assert_time(0.08)
        self.keys('comma')
        self.assert_time(0.04)
        self.keys('comma', 'comma', 'comma')
        self.assert_time(0)
        self.keys('End')
        self.assert_time(0.4)
        self.keys('period')
        self.assert_time(0.4)
        self.keys('comma')
        self.assert_time(0.36)
        self.keys('shift+comma')
        self.assert_time(0)
        out = self.quit()
        self.assertTrue(out['paused'])
        self.assertGreater(out['first_picture_ms'], 0)
        self.assertEqual(self.messages.splitlines()[1:], [line for line in self.messages.splitlines()[1:] if 'slosh-' in line])

    def test_it_runs_and_stops_at_the_end(self):
        self.record()
        self.open('a.h5part')
        self.assert_time(0.4)
        self.keys('minus', 'minus', 'minus', 'minus')  # 1/16: 0.4 s take 6 s
        self.key('r')
        self.until(lambda now: now['time'] == 0)
        self.assertFalse(self.until(lambda now: now['time'] == 0.04)['at_rest'])  # one step after the other, to the end
        self.keys('space')
        self.rest()
        self.assertEqual(self.quit()['speed'], 1 / 16)

    def test_it_begins_anew(self):
        self.record()
        self.open('a.h5part')
        self.keys('o')
        self.until(lambda now: now['simulated_seconds'] > 0.6)
        self.quit()
        self.assertIn('begins anew at the end\n', self.messages)

    def test_the_time_line(self):
        self.record()
        size = (780, 400)
        self.open('a.h5part', size=size)
        self.keys('space')
        shot = set()
        for x in (200, 300, 400):
            self.drag(1, [(x, size[1] - 30), (x + 2, size[1] - 30)])
            self.rest()
            shot.add(self.shoot())
        self.assertEqual(len(shot), 3)
        code, said = self.slosh('render', 'a.h5part', '-o', 'states', '--fps', '25', '--size', f'{size[0]}x{size[1]}', '--quiet')
        self.assertEqual(code, 0, said)
        states = {self.read(f'states/{name}') for name in os.listdir(self.path('states'))}
        self.assertTrue(len(states) > 8 and shot < states)
        self.quit()


class Views(PlayerTest):
    def test_looks(self):
        self.record()
        look = '--view', 'splat', '--set', 'view.quality=good'
        self.open('a.h5part', *look, '--set', 'view.range=[0, 2]')
        self.keys('space', 'End')
        self.assert_time(0.4, *look, '--set', 'view.range=[0, 2]')
        self.keys('s')
        self.assert_time(0.4, *look, '--set', 'view.color_by=density')
        self.keys('c')
        self.assert_time(0.4, *look, '--set', 'view.color_by=density', '--set', 'view.colormap=inferno')
        self.keys('p', 'h', 'Escape', 'p')
        self.drag(1, [(240, 180), (300, 160)])
        self.keys('Home')
        out = self.quit()
        self.assertEqual((out['color_by'], out['view'], out['camera_auto']), ('density', 'splat', True))
        self.assertEqual((out['particles'], out['steps']), (500, 200))
        self.assertEqual({'backend', 'method', 'threads', 'dt', 'sim_ms', 'limits'} & set(out), set())

    def test_a_scalar_that_the_file_lacks(self):
        self.record()
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            for k in range(11):
                del file[f'Step#{k}']['density']
        self.open('a.h5part')
        self.keys('s')
        out = self.quit()
        self.assertEqual(out['color_by'], 'pressure')
        self.assertIn('a.h5part: has no density; what follows from that cannot be shown', self.messages)
        views = '--set', 'views=[{}, {color_by: density}]'
        self.open('a.h5part', *views)
        self.xdo('mousemove', '--window', self.window, 3 * WIDTH // 4, HEIGHT // 2, 'click', 1)
        self.rest()
        self.assertEqual(self.quit()['color_by'], 'fluid')
        self.assertIn('coloured by fluid', self.messages)
        code, said = self.slosh('render', 'a.h5part', '-o', 'a.png', '--quiet', *views)
        self.assertEqual(code, 2)
        self.assertIn('has no density to colour by', said)

    def test_what_has_no_meaning_is_said_once(self):
        self.record()
        self.open('a.h5part')
        self.keys('space', 'BackSpace', 'ctrl+s')
        self.drag(1, [(240, 180), (300, 160)], 'shift')
        self.drag(1, [(240, 180), (300, 160)], 'shift')
        out = self.quit()
        self.assertEqual(out['box_position'], [0, 0, 0])
        self.assertEqual(self.messages.count('box-home: nothing is simulated, a recorded run is shown\n'), 1)
        self.assertEqual(self.messages.count('save-recording: nothing is simulated, a recorded run is shown\n'), 1)
        self.assertEqual(self.messages.count('a recorded run: its box moves as it did\n'), 1)


class Files(PlayerTest):
    def test_one_that_grows(self):
        writer = command.CommandTest.start(self, 'run', 'scene.yaml', '-o', 'a.h5part', '--time', '100000', '--every', '0.004',
                                           '--quiet')
        self.wait_for(lambda: os.path.exists(self.path('a.h5part')), writer)
        self.open('a.h5part')
        self.keys('space')
        pictures = []
        for _ in range(2):
            before = self.rest()['time']

            def further():
                self.key('End')
                return self.rest()['time'] > before
            self.wait_for(further, writer)
            pictures.append(self.shoot())
        writer.kill()
        writer.wait()
        self.assertNotEqual(*pictures)
        self.quit()

    def test_the_next_one(self):
        """Tab goes to the other files of the folder; scenes and files may follow one another."""
        self.record()
        self.record(name='b.h5part', seconds='0.2')
        self.open('a.h5part')
        self.key('Tab')
        self.opened(2)
        out = self.quit()
        self.assertEqual((out['scene'], out['scenes_opened']), ('./b.h5part', 2))

    def test_counts_that_change(self):
        jet = '    emit: [{disk: {centre: [0, 0.9, 0], direction: [0, -1, 0], radius: 0.2}, speed: 2}]\n'
        self.write('scene.yaml', command.SCENE.replace('    fill:', jet + '    fill:', 1))
        self.record()
        self.open('a.h5part')
        self.keys('space', 'r')
        for k in range(4):
            self.assert_time(0.04 * k)
            self.keys('period')
        out = self.quit()
        self.assertEqual(out['gl_errors'], 0)

    def test_a_step_that_cannot_be_read(self):
        self.record()
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file['Step#5']['y']
        self.open('a.h5part')
        self.keys('space', 'r', 'period', 'period', 'period', 'period')
        self.assert_time(0.16)
        self.keys('period')
        self.assert_time(0.16)
        self.keys('period')
        self.assert_time(0.24)
        self.quit()
        # each time that it is met: by the key, and perhaps as it began to play
        told = self.messages.count("a.h5part: Step#5: 'y' is missing or of another length\n")
        self.assertIn(told, (1, 2))

    def test_refused(self):
        self.record()
        self.write('text.h5part', 'no snapshots')
        for arguments, words in ((['text.h5part'], 'text.h5part: is no file of snapshots'),
                                 (['missing.h5part'], 'missing.h5part: cannot be read: No such file'),
                                 (['a.h5part', '--record', 'a.rec'], '--record makes no sense for a.h5part: nothing is simulated'),
                                 (['a.h5part', '--past', '10'], '--past makes no sense for a.h5part: nothing is simulated'),
                                 (['a.h5part', '--backend', 'cpu'], '--backend cpu makes no sense for a.h5part')):
            code, said = self.slosh(*arguments)
            self.assertEqual(code, 2, said)
            self.assertIn(words, said)


class Panels(PlayerTest):
    def test_views_beside_each_other(self):
        """As `render` draws them, those of the settings and those that W adds; a click chooses one."""
        self.record()
        own = '--set', 'views=[{}, {kind: slice, color_by: density}]'
        self.open('a.h5part', *own)
        self.keys('space', 'r', 'period', 'period')
        self.assert_time(0.08, *own)
        self.keys('comma')
        self.assert_time(0.04, *own)
        self.at(3 * WIDTH // 4, HEIGHT // 2)
        self.xdo('click', 1)
        self.keys('s')
        out = self.quit()
        self.assertEqual((out['views'], out['chosen_view'], out['view']), (2, 1, 'slice'))
        self.assertNotEqual(out['color_by'], 'density')
        self.open('a.h5part', '--set', 'view.kind=spheres', '--set', 'view.quality=good')
        self.keys('space', 'r', 'w')
        self.assert_time(0, '--set', 'views=[{kind: spheres, quality: good}, {kind: splat, quality: good}]')
        self.assertEqual(self.quit()['views'], 2)


if __name__ == '__main__':
    command.main('Time', 'Views Panels', 'Files')
