"""`render --compare`: panels are the pictures of their settings, with one range, at one time; what is wrong starts nothing."""
import json
import os
import re
import shutil
import signal
import struct
import subprocess

import numpy

import command
from command import CommandTest, video_frames

TITLE = 90  # rows of pixels that a title may cover in these pictures


class CompareTest(CommandTest):
    def picture(self, name):
        width, height = struct.unpack('>II', self.read(name)[16:24])
        raw = subprocess.run(['ffmpeg', '-v', 'error', '-i', name, '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-'],
                             cwd=self.folder, capture_output=True, check=True).stdout
        return numpy.frombuffer(raw, dtype='u1').reshape(height, width, 3)

    def compare(self, *arguments, output='out.png', time='0.1', size='401x300'):
        """What it said, and its JSON."""
        code, said = self.slosh('render', 'scene.yaml', '-o', output, '--time', time, '--size', size, '--json', 'out.json',
                                *arguments)
        self.assertEqual(code, 0, said)
        return said, json.loads(self.read('out.json'))

    def assert_panel(self, whole, panel, *arguments, time='0.1'):
        """The panel of a picture is what render alone draws at its size, below the title."""
        x, y, width, height = panel['place']
        self.once('one.png', 'render', 'scene.yaml', '-o', 'one.png', '--time', time, '--size', f'{width}x{height}', '--quiet',
                  *arguments)
        part, one = whole[y:y + height, x:x + width], self.picture('one.png')
        numpy.testing.assert_array_equal(part[TITLE:], one[TITLE:])
        self.assertTrue((part[:TITLE] != one[:TITLE]).any(), 'there is a title')


class Panels(CompareTest):
    def test_two_worlds_are_each_as_alone(self):
        bare = ('--set', 'view.legend=false')  # that of an automatic range shows that there is more beyond its ends
        said, result = self.compare('--compare', 'particles=300,1000', *bare)
        whole = self.picture('out.png')
        self.assertEqual(whole.shape, (300, 401, 3))
        one, two = result['panels']
        self.assertEqual((one['place'], two['place']), ([0, 0, 199, 300], [202, 0, 199, 300]))
        self.assertEqual([p['setting'] for p in result['panels']], ['particles 300', 'particles 1000'])
        self.assertEqual(one['range'], two['range'])
        scale = f'view.range=[{one["range"][0]:.9g}, {one["range"][1]:.9g}]'
        for panel, count in (one, '300'), (two, '1000'):
            self.assert_panel(whole, panel, '--particles', count, '--set', scale, *bare)
        self.assertEqual(len(numpy.unique(whole[:, 199:202].reshape(-1, 3), axis=0)), 1, 'the line between')
        self.assertIn('view.range auto: one range for all panels of a scalar', said)
        self.assertRegex(said, r'particles 300: --particles 300: a spacing of ')
        self.assertRegex(said, r'particles 1000: \d+ particles, 0\.1\d* s simulated in .* s of steps')
        self.assertRegex(said, r'2 panels, .*: out\.png, 1 picture\n')

    def test_four_views_share_a_world(self):
        cells = '--set', 'view.volume.cells=24'
        said, result = self.compare('--compare', 'view=spheres,splat,volume,slice', *cells, size='501x401')
        whole = self.picture('out.png')
        self.assertEqual([p['world'] for p in result['panels']], [0, 0, 0, 0])
        self.assertEqual(said.count('of steps'), 1, said)
        for panel in result['panels']:
            self.assertEqual(panel['place'][2:], [249, 199])
            self.assert_panel(whole, panel, '--view', panel['view'], *(cells if panel['view'] == 'volume' else ()))

    def test_what_only_a_later_panel_reads(self):
        """Panels that differ in keys of the view share a world, which keeps accelerations for any of them."""
        bare = ('--set', 'view.legend=false', '--set', 'view.range=[0, 20]')
        glyphs = ('--set', 'view.glyphs.show=true')
        for key, first, *more in (('view.color_by', 'velocity_x'), ('view.glyphs.vector', 'velocity', *glyphs)):
            _, result = self.compare('--compare', f'{key}={first},acceleration', *bare, *more)
            self.assertEqual([p['world'] for p in result['panels']], [0, 0])
            self.assert_panel(self.picture('out.png'), result['panels'][1], '--set', f'{key}=acceleration', *bare, *more)

    def test_two_keys_are_a_table(self):
        _, result = self.compare('--compare', 'method=mueller,dfsph', '--compare', 'view.colormap=viridis,gray')
        self.assertEqual([p['setting'] for p in result['panels']],
                         [f'method {m}, view.colormap {c}' for m in ('mueller', 'dfsph') for c in ('viridis', 'gray')])
        self.assertEqual([p['world'] for p in result['panels']], [0, 0, 1, 1])
        self.assertEqual([p['run']['method'] for p in result['panels']], ['mueller', 'mueller', 'dfsph', 'dfsph'])
        scale = 'view.range=[{:.9g}, {:.9g}]'.format(*result['panels'][0]['range'])
        self.assert_panel(self.picture('out.png'), result['panels'][3], '--method', 'dfsph', '--set', 'view.colormap=gray',
                          '--set', scale)

    def test_worlds_on_a_gpu_take_turns(self):
        """Each binds all that it reads."""
        scale = ('--set', 'view.range=[0, 2]')
        _, result = self.compare('--compare', 'backend=compute,fragment', '--compare', 'solver.step.substeps=2,4', *scale, time='0.04')
        whole, made = self.picture('out.png'), [(backend, substeps) for backend in ('compute', 'fragment') for substeps in (2, 4)]
        self.assertEqual([p['world'] for p in result['panels']], [0, 1, 2, 3])
        self.assertEqual([p['run']['backend'] for p in result['panels']], [backend for backend, _ in made])
        for panel, (backend, substeps) in zip(result['panels'], made):
            self.assert_panel(whole, panel, '--backend', backend, '--set', f'solver.step.substeps={substeps}', *scale, time='0.04')

    def test_pictures_of_one_time(self):
        steps, small = ['--compare', 'solver.step.dt=0.004,0.006', '--fps', '50'], {'time': '0.1', 'size': '321x200'}
        said, result = self.compare(*steps, '--steps', output='film.mp4', **small)
        self.assertEqual((video_frames(self.path('film.mp4')), result['pictures']), (5, 5))
        self.assertRegex(said, r"panels show their first states at or after a picture's time, up to 0\.004 s apart; leaving --steps out")
        self.assertEqual(said.count('pictures are at uneven times'), 1, said)
        self.assertIn('solver.step.dt 0.006: pictures are at uneven times', said)
        fluids = '--set', 'view.color_by=fluid'
        said, result = self.compare(*steps, *fluids, output='frames', **small)
        self.assertEqual([p['time'] for p in result['panels']], [0.08, 0.08])
        self.assertNotIn('apart', said)
        x, y, width, height = result['panels'][1]['place']
        code, said = self.slosh('render', 'scene.yaml', '-o', 'one', '--time', '0.1', '--fps', '50', '--size', f'{width}x{height}',
                                '--set', 'solver.step.dt=0.006', *fluids)
        self.assertEqual(code, 0, said)
        numpy.testing.assert_array_equal(self.picture('frames/frame_00004.png')[y:y + height, x:x + width][TITLE:],
                                         self.picture('one/frame_00004.png')[TITLE:])


class Views(CompareTest):
    def test_views_of_a_scene_are_each_as_alone(self):
        views = [{}, {'kind': 'splat'}, {'kind': 'slice', 'color_by': 'pressure'}]
        code, said = self.slosh('render', 'scene.yaml', '-o', 'out.png', '--time', '0.1', '--size', '501x400', '--json', 'out.json',
                                '--set', 'views=' + json.dumps(views))
        self.assertEqual(code, 0, said)
        self.assertNotIn('no effect', said)
        whole, result = self.picture('out.png'), json.loads(self.read('out.json'))
        self.assertEqual([p['place'] for p in result['panels']],
                         [[0, 0, 249, 400], [252, 0, 249, 199], [252, 201, 249, 199]])
        for panel, view in zip(result['panels'], views, strict=True):
            sets = [word for key, value in view.items() if key != 'kind' for word in ('--set', f'view.{key}={value}')]
            x, y, width, height = panel['place']
            self.once('one.png', 'render', 'scene.yaml', '-o', 'one.png', '--time', '0.1', '--size', f'{width}x{height}', '--quiet',
                      '--view', view.get('kind', 'spheres'), *sets)
            numpy.testing.assert_array_equal(whole[y:y + height, x:x + width], self.picture('one.png'))

    def test_settings_beside_one_another_and_their_views_below(self):
        _, result = self.compare('--compare', 'particles=300,1000', '--set', 'views=[{}, {kind: splat}]')
        self.assertEqual([(p['setting'], p['view']) for p in result['panels']],
                         [('particles 300', 'spheres'), ('particles 1000', 'spheres'),
                          ('particles 300', 'splat'), ('particles 1000', 'splat')])
        code, said = self.slosh('render', 'scene.yaml', '-o', 'no.png', '--compare', 'particles=300,1000', '--set',
                                'views=[{}, {}, {}]')
        self.assertEqual(code, 2, said)
        self.assertIn('2 settings with 3 views each are 6 panels; at most 4 have room', said)


class Beside(CompareTest):
    """Panels of one picture that show other states: of other settings, of a file."""
    PLAIN = ('--set', 'view.legend=false', '--set', 'view.range=[0, 1]')

    def record(self, *more, name='run.h5part'):
        self.once(name, 'run', 'scene.yaml', '-o', name, '--time', '0.2', '--every', '0.05', '--quiet', *more)

    def shoot(self, views, *more, source='scene.yaml', time='0.12'):
        code, said = self.slosh('render', source, '-o', 'out.png', '--time', time, '--size', '501x400', '--json', 'out.json',
                                '--set', f'views={views}', *self.PLAIN, *more)
        self.assertEqual(code, 0, said)
        return said, json.loads(self.read('out.json'))

    def assert_alone(self, panel, source, time, *more):
        x, y, width, height = panel['place']
        code, said = self.slosh('render', source, '-o', 'one.png', '--time', time, '--size', f'{width}x{height}', '--quiet',
                                *self.PLAIN, *more)
        self.assertEqual(code, 0, said)
        part, one = self.picture('out.png')[y:y + height, x:x + width], self.picture('one.png')
        numpy.testing.assert_array_equal(part[TITLE:], one[TITLE:])
        self.assertTrue((part[:TITLE] != one[:TITLE]).any(), 'there is a title')

    def test_settings_and_a_run_are_each_as_alone(self):
        self.record('--set', 'solver.step.dt=0.005')
        said, result = self.shoot('[{}, {set: {solver.method: dfsph, particles: {spacing: 0.125}}}, {file: run.h5part, kind: splat}]')
        own, other, run = result['panels']
        self.assertEqual([p['setting'] for p in result['panels']],
                         ['', 'solver.method dfsph, particles.spacing 0.125', 'run.h5part'])
        self.assertEqual((own['run']['method'], other['run']['method'], run['file']), ('mueller', 'dfsph', 'run.h5part'))
        self.assertAlmostEqual(run['time'], 0.15)  # the first step at or after 0.12
        self.assert_alone(other, 'scene.yaml', '0.12', '--method', 'dfsph', '--set', 'particles.spacing=0.125')
        self.assert_alone(run, 'run.h5part', '0.15', '--view', 'splat')
        self.assertRegex(said, r'^solver\.method dfsph, .*: scene.yaml:14:3: solver\.sound_speed has no effect')
        self.assertEqual([re.sub('setting.*', '', line) for line in said.splitlines() if line.startswith('run.h5part')], [])
        _, result = self.shoot('[{}, {file: run.h5part}]', time='0.3')
        self.assertAlmostEqual(result['panels'][1]['time'], 0.2)  # its last one; the title says so

    def test_trails_of_a_run_see_all_its_steps(self):
        """Beside a simulation as alone: the steps between pictures too."""
        trails = ('--view', 'none', '--set', 'view.trails.show=true', '--set', 'view.trails.length=1', '--set', 'view.trails.every=0.01')
        self.record()
        self.shoot('[{}, {file: run.h5part}]', *trails, time='0.2')
        self.assert_alone({'place': [252, 0, 249, 400]}, 'run.h5part', '0.2', *trails)
        trailed = self.picture('one.png')
        self.slosh('render', 'run.h5part', '-o', 'one.png', '--time', '0.2', '--size', '249x400', '--view', 'none', *self.PLAIN)
        self.assertTrue((trailed != self.picture('one.png')).any())

    def test_what_stands_beside_follows_the_scenes_state(self):
        """Its time is that of the scene's state, not of the picture; --interpolate shows all at the picture's."""
        self.record('--set', 'solver.step.dt=0.01')
        views = '[{set: {solver.step.dt: 0.003}}, {}, {file: run.h5part}]'
        for more, times in ((), (0.054, 0.052, 0.1)), (['--interpolate'], (0.0495, 0.0495, 0.05)):
            _, result = self.shoot(views, *more, time='0.0495')
            numpy.testing.assert_allclose([p['time'] for p in result['panels']], times, rtol=1e-6)

    def test_other_times(self):
        """A state at its time, whatever time the picture has, of a scene and of a recorded run; in a film that panel stands still."""
        for source, more in (('scene.yaml', ()), ('run.h5part', ('--set', 'solver.step.dt=0.005'))):
            self.record(*more)
            _, result = self.shoot('[{}, {time: 0.05}, {time: 0.15}]', source=source, time='0.1')
            if source == 'scene.yaml':
                self.assertEqual([p['setting'] for p in result['panels']], ['', 'time 0.05 s', 'time 0.15 s'])
                for panel, time in zip(result['panels'], (0.1, 0.05, 0.15)):
                    self.assertTrue(time - 1e-9 <= panel['time'] < time + 0.01, panel['time'])
            self.assert_alone({'place': [252, 0, 249, 199]}, source, '0.05')
            self.assert_alone({'place': [252, 201, 249, 199]}, source, '0.15')
            code, said = self.slosh('render', source, '-o', 'out.png', '--size', '501x400', '--time', '0.2', '--compare', 'time=0.05,0.15',
                                    *self.PLAIN)
            self.assertEqual((code, '--time 0.2 has no effect: each view shows' in said), (0, True), said)
            self.assert_alone({'place': [252, 0, 249, 400]}, source, '0.15')
        code, said = self.slosh('render', 'run.h5part', '-o', 'film', '--size', '501x400', '--frames', '3', '--fps', '20', '--set',
                                'views=[{}, {time: 0.1}]', *self.PLAIN)
        self.assertEqual(code, 0, said)
        frames = [self.picture(f'film/frame_{k:05}.png')[TITLE:] for k in range(3)]
        numpy.testing.assert_array_equal(frames[0][:, 252:], frames[2][:, 252:])
        self.assertTrue((frames[0][:, :249] != frames[2][:, :249]).any())
        code, said = self.slosh('render', 'run.h5part', '-o', 'out.png', '--compare', 'time=0.1,soon')
        self.assertEqual((code, '--compare time: soon is no time in seconds' in said), (2, True), said)

    def test_an_entrys_own_setting_is_not_compared(self):
        """Its value holds in each setting: one world, one name, the same picture."""
        said, result = self.compare('--compare', 'gravity=[0, -9, 0],[0, -3, 0]', '--set',
                                    'views=[{}, {set: {gravity: [2, -5, 0]}}]', time='0.05')
        panels = result['panels']
        self.assertEqual([p['setting'] for p in panels], ['gravity [0, -9, 0]', 'gravity [0, -3, 0]'] + 2 * ['gravity [2, -5, 0]'])
        self.assertEqual([p['world'] for p in panels], [0, 1, 2, 2])
        self.assertNotIn('makes no difference', said)

    def test_runs_beside_one_another(self):
        self.record()
        self.record('--method', 'dfsph', '--set', 'solver.step.dt=0.03', name='other.h5part')
        _, result = self.shoot('[{}, {file: other.h5part}]', source='run.h5part', time='0.1')
        self.assertEqual(result['particles'], 500)
        self.assert_alone({'place': [252, 0, 249, 400]}, 'other.h5part', '0.12')
        self.record('--set', 'views=[{}, {file: other.h5part}]', name='third.h5part')
        code, said = self.slosh('render', 'third.h5part', '-o', 'out.png', '--size', '64x48')
        self.assertEqual(code, 0, said)
        self.assertIn('third.h5part: views[1].file is left out: what stood beside this run is another file', said)

    def test_what_is_wrong(self):
        self.record()
        for words, views in (("views[1].set solver.metod=x: unknown key 'metod'; did you mean 'method'?",
                              '[{}, {set: {solver.metod: x}}]'),
                             ('each entry of views has a `file`', '[{file: run.h5part}]'),
                             ('views[1].set: view.radius is no setting of what is simulated', '[{}, {set: {view.radius: 1}}]'),
                             ('views[1] has `file` and `set`', '[{}, {file: run.h5part, set: {gravity: 3}}]'),
                             ('only particles of backend fragment have lost', '[{color_by: lost}]'),
                             ('views[1].file: none.h5part: cannot be read', '[{}, {file: none.h5part}]'),
                             ('views[1].file: scene.yaml is no recorded run', '[{}, {file: scene.yaml}]')):
            code, said = self.slosh('render', 'scene.yaml', '-o', 'out.png', '--set', f'views={views}')
            self.assertEqual((code, words in said), (2, True), said)
        code, said = self.slosh('render', 'scene.yaml', '-o', 'out.png', '--set', 'view.file=run.h5part')
        self.assertEqual((code, 'view.file is for entries of views' in said), (2, True), said)
        os.mkdir(self.path('below'))
        shutil.copy(self.path('scene.yaml'), self.path('below'))
        code, said = self.slosh('render', 'below/scene.yaml', '-o', 'out.png', '--set', 'views=[{}, {file: run.h5part}]')
        self.assertEqual(code, 2, said)
        self.assertIn("views[1].file: below/run.h5part is not there: it is found from the scene's folder, not from the present one, where "
                      'there is a run.h5part; write its whole path', said)
        self.assertEqual(self.entries(), ['below', 'run.h5part'])


class Words(CompareTest):
    def refused(self, said, *arguments, code=2):
        done = self.slosh('render', 'scene.yaml', '-o', 'out.png', '--time', '0', *arguments)
        self.assertEqual(done[0], code, done[1])
        self.assertIn(said, done[1])
        self.assertNotIn('renderer:', done[1], 'nothing has started')
        self.assertEqual(self.entries(), [])

    def test_what_is_wrong_starts_nothing(self):
        self.refused('--compare shows two or four settings side by side, not 3', '--compare', 'particles=1,2,3')
        self.refused('--compare shows two or four settings side by side, not 1', '--compare', 'particles=1')
        self.refused('not 8; name two or four values of a key', *3 * ['--compare', 'threads=1,2'])
        self.refused("--compare particles takes whole numbers from 1 on, not 'x'", '--compare', 'particles=1,x')
        self.refused('--compare takes KEY=A,B,... such as threads=1,2', '--compare', 'particles')
        self.refused("--compare solver.method=sph: solver.method cannot be 'sph'", '--compare', 'method=mueller,sph')
        self.refused("--compare view.kind=nothing", '--compare', 'view=spheres,nothing')
        self.refused("--compare nosuch=1: unknown key 'nosuch'", '--compare', 'nosuch=1,2')
        # A setting that fits alone, and not the rest of the scene.
        self.refused('with box.size [0.5, 1, 1]: ', '--compare', 'box.size=[1, 1, 1],[0.5, 1, 1]')
        for both in (['--compare', 'particles.spacing=0.1,0.125'], ['--set', 'views=[{}, {set: {particles.spacing: 0.125}}]']):
            self.refused('both choose the spacing; leave one of them out', '--particles', '400', *both)
        self.refused('with particles 2000000000: ', '--compare', 'particles=1000,2000000000')

    def test_too_small_a_picture(self):
        code, said = self.slosh('render', 'scene.yaml', '-o', 'out.png', '--time', '0', '--size', '3x300', '--compare',
                                'view=spheres,splat')
        self.assertEqual((code, self.entries()), (1, []), said)
        self.assertIn('a picture of 3 x 300 pixels has no room for 2 panels; make it larger', said)

    def test_what_makes_no_difference_is_said(self):
        said, _ = self.compare('--compare', 'threads=1,2', '--quiet')
        self.assertIn('threads 1 and threads 2 are the same in every picture: it makes no difference here', said)
        said, _ = self.compare('--compare', 'gravity=[0, -9, 0],[0, -10, 0]', '--quiet')
        self.assertNotIn('the same in every picture', said)

    def test_notes_name_their_panel(self):
        said, _ = self.compare('--compare', 'method=mueller,dfsph', '--quiet')
        self.assertRegex(said, r'^method dfsph: scene.yaml:14:3: solver\.sound_speed has no effect')
        self.assertNotIn('method mueller: ', said)

    def test_what_stands_twice(self):
        for words, arguments in (('--compare gravity has the value 9 twice', ['gravity=9,9']),
                                 ('--compare solver.method stands twice; name all its values in one',
                                  ['method=mueller,dfsph', '--compare', 'solver.method=pbf,wcsph'])):
            code, said = self.slosh('render', 'scene.yaml', '-o', 'out.png', '--compare', *arguments)
            self.assertEqual((code, words in said, self.entries()), (2, True, []), said)
        said, _ = self.compare('--compare', 'method=mueller,wcsph', '--method', 'pbf', '--quiet', '--set', 'view.radius=1')
        self.assertEqual(said.count('has no effect: --compare'), 1)
        self.assertIn('--method pbf has no effect: --compare solver.method decides\n', said)

    def test_trouble_names_its_panel(self):
        code, said = self.slosh('render', 'scene.yaml', '-o', 'out.png', '--time', '1', '--json', 'out.json', '--compare',
                                'solver.step.dt=0.004,0.2')
        self.assertEqual((code, self.entries()), (1, ['out.json']), said)
        self.assertRegex(said, r'^--compare solver\.step\.dt=0\.2: the step of 100 ms is too long')
        self.assertRegex(said, r'\nsolver\.step\.dt 0\.2: t = .* s: .*back to')
        self.assertRegex(said, r'\nsolver\.step\.dt 0\.2: the simulation blew up at')
        self.assertRegex(json.loads(self.read('out.json'))['error'], r'^solver\.step\.dt 0\.2: the simulation blew up')
        code, said = self.slosh('render', 'scene.yaml', '-o', 'frames', '--time', '1', '--fps', '100', '--size', '64x48', '--set',
                                'solver.step.dt=0.2')
        kept = len(os.listdir(self.path('frames')))
        self.assertEqual((code, f'frames: the {kept} picture' in said), (1, True), said)
        self.assertRegex(said, r'pictures? before that (is|are) whole and kept\n')

    def test_stopped_within_the_only_picture(self):
        """Worlds go side by side: none is far ahead of another."""
        process = self.start('render', 'scene.yaml', '-o', 'out.png', '--time', '30', '--size', '64x64', '--compare',
                             'particles=200,300', '--json', 'out.json')
        while ' %' not in process.stderr.readline():
            self.assertIsNone(process.poll(), 'the program ended too early')
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=command.PATIENCE)[1]
        self.assertEqual(process.returncode, 130, said)
        times = [float(t) for t in re.findall(r'particles?, ([0-9.e+-]+) s simulated in', said)]
        self.assertEqual(len(times), 2, said)
        self.assertGreater(min(times), 0.9 * max(times) - 0.02, said)
        self.assertNotIn('panels show their first states', said)

    def test_stopped_by_a_signal(self):
        process = self.start('render', 'scene.yaml', '-o', 'frames', '--time', '100', '--size', '64x64', '--quiet', '--compare',
                             'particles=200,300', '--json', 'out.json')
        self.wait_for(lambda: 'frames' in self.entries(), process)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=command.PATIENCE)[1]
        self.assertEqual(process.returncode, 130, said)
        self.assertRegex(said, r'stopped at t = .* s; frames is whole')
        self.assertTrue(json.loads(self.read('out.json'))['stopped'])


if __name__ == '__main__':
    command.main('Panels Views', 'Beside Words')
