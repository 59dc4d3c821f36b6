"""Outputs are whole or not there: what goes right, full disks, folders that can't be written, signals."""
import json
import os
import pathlib
import random
import re
import signal
import subprocess

import command
from command import CommandTest, TinyDiskTest, limit_files, video_frames, whole_steps

SMALL = ['--size', '64x48', '--quiet']


class Whole(CommandTest):
    def test_run(self):
        code, said = self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', '0.1', '--every', '0.01',
                                '--json', 'a.json')
        self.assertEqual(code, 0, said)
        # dt is 0.004 and does not change: the first states at or after 0, 0.01, 0.02, ...
        expected = [0, .012, .02, .032, .04, .052, .06, .072, .08, .092, .1]
        for time_, wanted in zip(whole_steps(self.path('a.h5part')), expected, strict=True):
            self.assertAlmostEqual(time_, wanted, places=9)
        self.assertEqual(self.entries(), ['a.h5part', 'a.json'])
        self.assertRegex(said, r'500 particles, 0\.1 s simulated in .* s \(.* times real time\): a\.h5part, '
                               r'11 snapshots\n')
        self.assertRegex(said, r'run:  5\d %.* elapsed, about .* left\n')
        summary = json.loads(self.read('a.json'))
        self.assertEqual((summary['particles'], summary['snapshots'], summary['steps']), (500, 11, 50))
        self.assertTrue(0 < summary['step_seconds'] < summary['wall_seconds'], summary)
        pressed = summary['compression']
        self.assertTrue(0 < pressed['mean'] < pressed['p999'] <= pressed['max'] < 1, pressed)
        self.assertRegex(said, r'snapshots are pressed by [0-9.]+ % in the mean, [0-9.]+ % at the 99\.9th percentile\n')

    def test_a_carried_density_that_is_held_above_0_is_told(self):
        """Of a ball that flies apart; summed densities know no such floor."""
        self.write('apart.yaml', '''
box: {size: [3, 3, 3]}
gravity: [0, 0, 0]
particles: {spacing: 0.05, support: 3}
fluids:
  - density: 1000
    velocity_formula: {x: 8*x, y: 8*(y-1.5), z: 8*z}
    fill: [{ball: {centre: [0, 1.5, 0], radius: 0.2}}]
solver: {sound_speed: 20}
''')
        for method, least in (('wcsph', 0.3), ('mueller', 1)):
            code, said = self.slosh('run', 'apart.yaml', '-o', f'{method}.h5part', '--time', '0.5', '--every', '0.05',
                                    '--method', method, '--json', 'a.json')
            self.assertEqual(code, 0, said)
            told = re.findall(r'fluid flies apart: densities below half .* by wcsph \(the thinnest particle has \S+ %\)\n', said)
            self.assertEqual(len(told), method == 'wcsph', said)
            self.assertTrue(0 < json.loads(self.read('a.json'))['compression']['least'] < least)

    def test_emitters_that_wait_are_told_once(self):
        jet = '    emit: [{disk: {centre: [0, 0.9, 0], direction: [0, -1, 0], radius: 0.2}, speed: 2}]\n'
        self.write('jet.yaml', command.SCENE.replace('    fill:', jet + '    fill:', 1))
        code, said = self.slosh('run', 'jet.yaml', '-o', 'a.h5part', '--time', '0.3', '--set', 'particles.most=520',
                                '--json', 'a.json')
        self.assertEqual(code, 0, said)
        self.assertEqual(said.count('there are 520 particles, as many as particles.most allows: no more come until some drain'), 1, said)
        summary = json.loads(self.read('a.json'))
        self.assertEqual((summary['particles'], summary['emitted'], summary['drained']), (520, 20, 0))

    def test_what_starts_in_the_way_is_told(self):
        """Once each; and a body that is moved out of a wall has gained no energy that would end the run."""
        self.write('way.yaml', '''
box: {size: [1, 1, 1]}
particles: {spacing: 0.05}
fluids:
  - density: 1000
    fill: [{block: {min: [-0.5, 0, -0.5], max: [0.5, 0.1, 0.5]}}]
    emit:
      - {disk: {centre: [0, 0.9, 0], direction: [0, -1, 0], radius: 0.08}, speed: 4}
      - {disk: {centre: [0.4, 0.9, 0], direction: [-1, 0, 0], radius: 0.05}, speed: 1}
solids:
  - {box: {centre: [0, 0.82, 0], size: [0.3, 0.1, 0.3]}}
  - {sphere: {centre: [0.45, 0.3, 0], radius: 0.15}, density: 500}
  - {sphere: {centre: [0.3, 0.45, 0], radius: 0.15}, density: 500}
  - {box: {centre: [0, 0.6, 0.3], size: [1.3, 0.1, 0.1]}, density: 500}
  - {box: {centre: [0.3, 0.05, -0.4], size: [0.1, 0.1, 0.1]}, density: 500}
  - {box: {centre: [-0.3, 0.03, -0.4], size: [0.1, 0.1, 0.1]}, density: 500, hinge: {at: [-0.3, 0.1, -0.4], axis: [0, 0, 1]}}
drains:
  - {ball: {centre: [0.4, 0.9, 0], radius: 0.1}}
  - {ball: {centre: [-0.4, 0.95, -0.4], radius: 0.04}}
solver: {sound_speed: 15}
''')
        told = ['the solid starts 0.1 m deep in a wall of the box, and is moved out of it in the first step',
                'the solid starts 0.0879 m deep in solids[1], and is moved out of it in the first step',
                'the solid does not fit into the box: it sticks out by 0.15 m',
                'fluids[0].emit[1]: the emitter stands in drains[0], which takes its fluid at once']
        code, said = self.slosh('run', 'way.yaml', '-o', 'a.h5part', '--time', '0.5')
        self.assertEqual(code, 0, said)
        for words in [*told, 's: fluids[0].emit[0]: no particle of the last 20 layers found room; something stands in the way']:
            self.assertEqual(said.count(words), 1, said)
        self.assertEqual(len(re.findall('the solid (?:starts|does)', said)), 3, said)
        self.assertNotIn('drains took nothing', said)
        code, said = self.slosh('run', 'way.yaml', '-o', 'a.h5part', '--time', '0.05', '--set', 'drains=[{ball: {centre: [-0.4, 0.95, -0.4], radius: 0.04}}]')
        self.assertIn('the drains took nothing: no fluid came to them\n', said)

    def test_a_body_within_another_is_told_in_either_order(self):
        sizes = ('[0.06, 0.06, 0.06]', '[0.4, 0.4, 0.4]')
        for first, second in (sizes, sizes[::-1]):
            self.write('within.yaml', f'''
box: {{size: [1, 1, 1]}}
particles: {{spacing: 0.05}}
fluids:
  - fill: [{{block: {{min: [-0.5, 0, -0.5], max: [0.5, 0.2, 0.5]}}}}]
solids:
  - {{box: {{centre: [0, 0.6, 0], size: {first}}}, density: 500}}
  - {{box: {{centre: [0, 0.6, 0], size: {second}}}, density: 500}}
''')
            code, said = self.slosh('info', 'within.yaml')
            self.assertEqual((code, said.count('the solid starts 0.17 m deep in solids[')), (0, 1), said)

    def test_json_on_a_stream(self):
        few = ['run', 'scene.yaml', '-o', 'a.h5part', '--time', '0', '--quiet', '--json']
        for name in ('-', '/dev/stdout', '/dev/fd/1'):
            done = subprocess.run([command.PROGRAM, *few, name], cwd=self.folder, capture_output=True, text=True,
                                  timeout=command.PATIENCE, check=False)
            self.assertEqual((done.returncode, done.stderr, json.loads(done.stdout)['snapshots']), (0, '', 1), name)
        with open(self.path('said'), 'w', encoding='utf8') as said:  # a file that must not be replaced
            said.write('before\n')
            said.flush()
            subprocess.run([command.PROGRAM, *few, '/dev/stdout'], cwd=self.folder, stdout=said, timeout=command.PATIENCE, check=True)
        self.assertRegex(self.read('said').decode(), r'^before\n\{\n')
        self.assertEqual(self.slosh(*few, '/dev/null'), (0, ''))
        self.assertEqual(self.slosh(*few, '/dev/full'),
                         (1, '/dev/full: cannot write the results: No space left on device\n'))
        self.assertEqual(self.entries(), ['a.h5part', 'said'])

    def test_run_replaces_an_old_file(self):
        self.write('a.h5part', 'old')
        code, said = self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', '0', '--quiet')
        self.assertEqual((code, said), (0, ''))
        self.assertEqual(whole_steps(self.path('a.h5part')), [0])

    def test_video(self):
        code, said = self.slosh('render', 'scene.yaml', '-o', 'a.mp4', '--time', '0.4', '--fps', '20',
                                '--size', '65x49')
        self.assertEqual(code, 0, said)
        self.assertEqual(video_frames(self.path('a.mp4')), 8)
        self.assertRegex(said, r'^renderer: \S')
        self.assertIn('render: 100 %', said)
        self.assertIn('a.mp4, 8 pictures\n', said)
        self.assertEqual(self.entries(), ['a.mp4'])

    def test_folder(self):
        code, said = self.slosh('render', 'scene.yaml', '-o', 'frames', '--frames', '3', *SMALL)
        self.assertEqual(code, 0, said)
        self.assertEqual(sorted(os.listdir(self.path('frames'))), [f'frame_0000{k}.png' for k in range(3)])
        code, said = self.slosh('render', 'scene.yaml', '-o', 'frames/', '--frames', '1', *SMALL)
        self.assertEqual(code, 0, said)
        self.assertIn('frames/frame_00001.png and what follows is of an earlier run', said)

    def test_picture_is_of_its_time(self):
        for name, at in (('early.png', '0'), ('late.png', '0.4')):
            code, said = self.slosh('render', 'scene.yaml', '-o', name, '--time', at, *SMALL)
            self.assertEqual(code, 0, said)
            self.assertRegex(said, r'^renderer: [^\n]*\n$')  # no more: --quiet
            self.assertEqual(self.read(name)[:8], b'\x89PNG\r\n\x1a\n')
        self.slosh('render', 'scene.yaml', '-o', 'frames', '--fps', '2.5', '--frames', '2', *SMALL)
        self.assertNotEqual(self.read('early.png'), self.read('late.png'))
        self.assertEqual(self.read('early.png'), self.read('frames/frame_00000.png'))
        self.assertEqual(self.read('late.png'), self.read('frames/frame_00001.png'))

    def test_files_are_of_the_best_quality(self):
        pictures = {}
        for quality in ('auto', 'good', 'best'):
            code, said = self.slosh('render', 'dam_break', '-o', 'a.png', '--time', '0', '--view', 'volume', '--set',
                                    'view.volume.look=water', '--set', f'view.quality={quality}', '--set', 'view.carries_scene=false', '--size', '160x120', '--quiet')
            self.assertEqual(code, 0, said)
            pictures[quality] = self.read('a.png')
        self.assertEqual(pictures['auto'], pictures['best'])
        self.assertNotEqual(pictures['good'], pictures['best'])

    def test_what_pictures_lack_is_said_once(self):
        layers = ['--view', 'pbsr', '--set', 'view.pbsr.layers=[{of: surface}, {of: speed, level: 1000}]']
        code, said = self.slosh('render', 'scene.yaml', '-o', 'a.png', '--time', '0', *SMALL, *layers)
        self.assertEqual(code, 0, said)
        self.assertIn('a.png: warning: nothing of layer 2, speed 1000 m/s\n', said)
        code, said = self.slosh('render', 'scene.yaml', '-o', 'lacks', '--fps', '20', '--frames', '2', *SMALL, *layers)
        self.assertEqual(said.count('warning'), 1, said)
        self.assertIn('lacks: warning: 2 of 2 pictures are not as asked, the first at 0 s: nothing of layer 2', said)
        self.slosh('run', 'scene.yaml', '-o', 'lacks.h5part', '--time', '0.01', '--quiet')
        code, said = self.slosh('render', 'lacks.h5part', '-o', 'b.png', '--time', '0', *SMALL, *layers)
        self.assertIn('b.png: warning: nothing of layer 2, speed 1000 m/s\n', said)


class FullDisk(CommandTest):
    def full(self, *arguments, size, reason='File too large'):
        code, said = self.slosh(*arguments, before=limit_files(size))
        self.assertEqual(code, 1, said)
        self.assertIn(reason, said)

    def test_run_before_the_first_step(self):
        self.write('a.h5part', 'old')
        self.full('run', 'scene.yaml', '-o', 'a.h5part', '--quiet', size=40000)
        self.assertEqual(self.entries(), ['a.h5part'])
        self.assertEqual(self.read('a.h5part'), b'old')

    def test_run_later(self):
        self.full('run', 'scene.yaml', '-o', 'a.h5part', '--quiet', size=400000)
        self.assertEqual(self.entries(), ['a.h5part'])
        self.assertGreater(len(whole_steps(self.path('a.h5part'))), 2)

    def test_png(self):
        self.write('a.png', 'old')
        self.full('render', 'scene.yaml', '-o', 'a.png', '--time', '0', size=8000)
        self.assertEqual(self.entries(), ['a.png'])
        self.assertEqual(self.read('a.png'), b'old')

    def test_folder(self):
        self.full('render', 'scene.yaml', '-o', 'frames', '--frames', '1', size=8000)
        self.assertEqual(self.entries(), [])

    def test_video(self):
        self.write('a.mp4', 'old')
        self.full('render', 'scene.yaml', '-o', 'a.mp4', '--time', '0.5', '--size', '320x240', size=8000)
        self.assertEqual(self.entries(), ['a.mp4'])
        self.assertEqual(self.read('a.mp4'), b'old')

    def test_json(self):
        self.full('run', 'scene.yaml', '-o', 'a.h5part', '--time', '0', '--json', '/dev/full', size=10**9,
                  reason='/dev/full: cannot write the results: No space left on device')
        self.assertEqual(self.entries(), ['a.h5part'])  # the run itself is whole


class TinyDisk(TinyDiskTest):
    def test_run(self):
        self.assertEqual(self.full('64k', 'run scene.yaml -o disk/a.h5part'), [])
        self.assertEqual(self.full('400k', 'run scene.yaml -o disk/a.h5part'), ['a.h5part'])
        self.assertGreater(len(whole_steps(self.path('a.h5part'))), 2)

    def test_png(self):
        self.assertEqual(self.full('64k', 'render scene.yaml -o disk/a.png --time 0'), [])

    def test_folder(self):
        picture = 'render scene.yaml -o frames --frames 1 --size 320x240'
        self.assertEqual(self.slosh(*picture.split())[0], 0)
        size = os.path.getsize(self.path('frames/frame_00000.png'))
        self.full(f'{3 * size // 1024}k', 'render scene.yaml -o disk/tiny --size 320x240')
        names = sorted(os.listdir(self.path('tiny')))
        self.assertIn(len(names), (1, 2))
        for name in names:
            self.assertIn(b'IEND', self.read(f'tiny/{name}')[-12:])

    def test_video(self):
        for size in ('4k', '8k'):
            self.assertEqual(self.full(size, 'render scene.yaml -o disk/a.mp4 --time 0.4 --size 320x240'), [], size)


class Unwritable(CommandTest):
    """Said at once: a simulation of a million seconds never starts."""

    def refused(self, command_, output, reason):
        code, said = self.slosh(command_, 'scene.yaml', '-o', output, '--time', '1000000')
        self.assertEqual(code, 1, said)
        self.assertIn(reason, said)
        self.assertNotIn(' %', said)

    def test_missing_folder(self):
        for command_, output in (('run', 'no/a.h5part'), ('render', 'no/a.png'), ('render', 'no/a.mp4'),
                                 ('render', 'no/frames')):
            self.refused(command_, output, 'No such file or directory')
        self.assertEqual(self.entries(), [])

    def test_unwritable_folder(self):
        os.mkdir(self.path('shut'), 0o555)
        folder = '/proc' if os.geteuid() == 0 else 'shut'  # nobody shuts out root, but for /proc
        for command_, name in (('run', 'a.h5part'), ('render', 'a.png'), ('render', 'a.mp4'),
                               ('render', 'frames')):
            self.refused(command_, f'{folder}/{name}', 'cannot be')

    def test_name_is_a_folder(self):
        for command_, output in (('run', 'a.h5part'), ('render', 'a.png'), ('render', 'a.mp4')):
            os.mkdir(self.path(output))
            self.refused(command_, output, 'is a folder; name a file')

    def test_name_is_a_file(self):
        self.write('frames', '')
        self.refused('render', 'frames', 'is a file, not a folder')

    def test_json(self):
        code, said = self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', '1000000', '--json', 'no/a.json')
        self.assertEqual(code, 1, said)
        self.assertIn('no/a.json: cannot be written', said)
        self.assertEqual(self.entries(), [])


class Failures(CommandTest):
    """What failed is in --json too, with what there is of figures; where the command line is wrong there is no file."""
    BREAKS = ('--set', 'solver.sound_speed=9000', '--set', 'solver.step.retries=0')

    def failed(self, *arguments, code=1):
        done, said = self.slosh(*arguments, '--json', 'a.json')
        self.assertEqual(done, code, said)
        return json.loads(self.read('a.json')), said

    def test_run_and_render(self):
        for name, output, product in (('run', 'a.h5part', 'snapshots'), ('render', 'a.png', 'pictures')):
            found, said = self.failed(name, 'scene.yaml', '-o', output, *self.BREAKS, '--quiet', '--time', '1')
            self.assertIn(found['error'], said.splitlines())
            self.assertIn('the simulation blew up at t = ', found['error'])
            self.assertEqual((found['command'], found['scene'], found['particles']), (name, 'scene.yaml', 500))
            self.assertIn(product, found)
            found, said = self.failed(name, 'scene.yaml', '-o', f'no/{output}', '--quiet')
            self.assertIn(f'no/{output}: cannot be written', found['error'])

    def test_no_context(self):
        found, said = self.failed('render', 'scene.yaml', '-o', 'a.png', '--gpu', '15')
        self.assertEqual(found, {'command': 'render', 'scene': 'scene.yaml', 'output': 'a.png', 'error': said.strip()})

    def test_bench(self):
        """The cases before it and behind it have their figures."""
        found, said = self.failed('bench', 'scene.yaml', '--view', 'none', '--frames', '2', '--quiet',
                                  '--sweep', 'solver.sound_speed=15,9000,20', '--set', 'solver.step.retries=0', code=0)
        self.assertEqual(len(found), 3)
        for measured in (found[0], found[2]):
            self.assertGreater(measured['frame_ms'], 0)
            self.assertNotIn('error', measured)
        self.assertIn('solver.sound_speed=9000: ' + found[1].pop('error'), said.splitlines())
        self.assertGreater(found[1].pop('outcome_time'), 0)
        self.assertEqual(found[1], {'scene': 'scene.yaml', 'backend': 'cpu', 'method': 'mueller', 'view': 'none',
                                    'outcome': 'blown up', 'swept': 'solver.sound_speed=9000',
                                    'outcome_words': 'a particle moves further than the support radius in one step'})
        (found,), said = self.failed('bench', 'scene.yaml', '--view', 'none', '--frames', '2', '--quiet', *self.BREAKS)
        self.assertIn(found['error'], said.splitlines())

    def test_validate(self):
        self.write('file', '')
        found, said = self.failed('validate', 'free_fall', '--coarse', '--quiet', '-o', 'file/plots')
        self.assertEqual(found, {'cases': [], 'error': said.strip()})
        found, said = self.failed('validate', 'dam_break_2d', '--coarse', '--quiet', '--method', 'mueller',
                                  '--set', 'solver.step={mode: fixed, dt: 1, substeps: 1, retries: 0}')
        self.assertIn('the simulation blew up', found['cases'][0]['failure'])
        self.assertNotIn('error', found)

    def test_chart(self):
        found, said = self.failed('chart', 'scene.yaml', '-o', 'no/a.svg', '--quiet')
        self.assertEqual(found, {'command': 'chart', 'scene': 'scene.yaml', 'output': 'no/a.svg', 'error': said.splitlines()[-1]})
        found, said = self.failed('chart', 'scene.yaml', '-o', 'a.svg', '--quiet', '--time', '0.02', '--backend', 'cpu',
                                  '--particles', '60', '--set', 'solver.step={dt: 1, retries: 0}')
        self.assertIn(found['error'], said.splitlines())
        self.assertGreater(len(found['runs']), 1)

    def test_the_window(self):
        env = {'DISPLAY': ':none', 'PATH': os.environ['PATH']}
        for name, of in (('bench', lambda found: found[0]), ('play', lambda found: found)):
            more = ['--play'] if name == 'bench' else []
            done = subprocess.run([command.PROGRAM, name, 'scene.yaml', *more, '--json', 'a.json'], cwd=self.folder, env=env,
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertEqual(of(json.loads(self.read('a.json'))), {'scene': 'scene.yaml', 'error': done.stderr.strip()})

    def test_export_and_replay(self):
        self.assertEqual(self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', '0', '--quiet')[0], 0)
        found, said = self.failed('export', 'a.h5part', '-o', 'no/a.vtp')
        self.assertEqual(found, {'command': 'export', 'input': 'a.h5part', 'output': 'no/a.vtp', 'error': said.strip()})
        text = ''.join(f'| {line}\n' for line in command.SCENE.splitlines())
        self.write('a.rec', f'slosh recording 1\nprogram 0.1\nscene a.yaml\ntext\n{text}commands\nend 9 {"0" * 16}\n')
        found, said = self.failed('replay', 'a.rec', '-o', 'no/a.h5part')
        self.assertEqual((found['recording'], found['output']), ('a.rec', 'no/a.h5part'))
        self.assertIn(found['error'], said)

    def test_a_wrong_command_line_leaves_no_file(self):
        for name, *more in (('run', '-o', 'a.h5part'), ('render', '-o', 'a.png'), ('bench',), ('info',)):
            code, said = self.slosh(name, 'scene.yaml', *more, '--set', 'solver.step.dt=-1', '--json', 'a.json')
            self.assertEqual(code, 2, said)
        self.assertEqual(self.entries(), [])


class Info(CommandTest):
    def info(self, *arguments):
        done = subprocess.run([command.PROGRAM, 'info', *arguments, '--json', 'a.json'], cwd=self.folder,
                              capture_output=True, text=True, check=True)
        return done.stdout, json.loads(self.read('a.json'))

    def test_all_that_is_printed(self):
        printed, found = self.info()
        self.assertEqual(found['command'], 'info')
        self.assertNotIn('scene', found)
        self.assertIn(f"threads\n  {found['threads']}\n", printed)
        self.assertIn(f"renderer\n  {found['renderer']}\n", printed)
        names = [row['name'] for rows in found.values() if isinstance(rows, list) for row in rows]
        rows = [line[2:] for line in re.sub(r'^(renderer|threads)\n.*\n', '', printed, flags=re.M).splitlines()
                if line.startswith('  ') and line[2] != ' ']
        self.assertEqual(names, [row[:len(name)] for name, row in zip(names, rows)])
        self.assertEqual(len(names), len(rows))
        for key in ('backends', 'methods', 'presets', 'views', 'scalars', 'exports', 'metrics', 'motions'):
            self.assertGreater(len(found[key]), 1, key)
        self.assertEqual({'name': 'cpu', 'runs': True}, {key: found['backends'][0][key] for key in ('name', 'runs')})
        self.assertEqual(found['scalars'][0], {'name': 'speed', 'unit': 'm/s'})

    def test_a_scene(self):
        printed, found = self.info('scene.yaml', '--set', 'fluids[1].viscosity=[[0, 1], [2, 0.5]]',
                                   '--set', 'title="7"', '--set', 'metrics=[centre_of_mass, kinetic_energy]')
        scene = found['scene']
        self.assertEqual((scene['path'], scene['particles']), ('scene.yaml', 500))
        settings = scene['settings']
        self.assertEqual(list(settings), [line.split(' = ')[0] for line in printed.splitlines()
                                          if ' = ' in line and not line.startswith(' ')])
        self.assertEqual(settings['box.size'], {'value': [1, 1, 1], 'unit': 'm'})
        self.assertEqual(settings['fluids[1].viscosity'], {'value': [[0, 1], [2, 0.5]], 'unit': 'Pa s'})
        self.assertEqual(settings['fluids[1].name'], {'value': 'oil'})
        self.assertEqual(settings['solver.step.realtime'], {'value': True})
        self.assertEqual(settings['title'], {'value': '7'})
        self.assertEqual(settings['metrics'], {'value': ['centre_of_mass', 'kinetic_energy']})

    def test_quiet_and_a_file_that_cannot_be(self):
        self.assertEqual(self.info('--quiet')[0], '')
        code, said = self.slosh('info', '--json', 'no/a.json')
        self.assertEqual(code, 1)
        self.assertIn('no/a.json: cannot be written', said)


class Usage(CommandTest):
    def refused(self, *arguments, reason):
        code, said = self.slosh(*arguments)
        self.assertEqual(code, 2, said)
        self.assertIn(reason, said)
        self.assertEqual(self.entries(), [])

    def test_extension(self):
        for name in ('a.jpg', 'a.webm', 'a.h5part', 'b.c/a.tiff'):
            self.refused('render', 'scene.yaml', '-o', name, reason='use .png, .mp4, .gif or a folder name')

    def test_run_extension(self):
        self.refused('run', 'scene.yaml', '-o', 'a.mp4', reason='name a FILE.h5part')

    def test_no_output(self):
        self.refused('render', 'scene.yaml', reason='-o')
        self.refused('run', 'scene.yaml', reason='-o')

    def test_frames_of_one_picture(self):
        self.refused('render', 'scene.yaml', '-o', 'a.png', '--frames', '3', reason='--frames')


class Clashes(CommandTest):
    """Outputs that are each other, or something that is read: refused before anything is done."""

    def refused(self, *arguments, reason):
        before = {name: self.read(name) for name in os.listdir(self.folder) if os.path.isfile(self.path(name))}
        code, said = self.slosh(*arguments)
        self.assertEqual(code, 2, said)
        self.assertIn(reason + '; name another file\n', said)
        self.assertEqual(said.count('\n'), 1, said)
        self.assertEqual({name: self.read(name) for name in before}, before)

    def test_each_other(self):
        run = ('run', 'scene.yaml', '-o')
        self.refused(*run, 'k.h5part', '--json', 'k.h5part',
                     reason='slosh run: -o k.h5part and --json k.h5part would replace each other')
        self.refused(*run, 'k.h5part', '--json', './/k.h5part', reason='would replace each other')
        os.symlink('.', self.path('here'))
        self.refused(*run, 'k.h5part', '--json', 'here/k.h5part', reason='would replace each other')
        self.refused(*run, 'no/k.h5part', '--json', self.path('no/k.h5part'), reason='would replace each other')
        os.symlink('later.h5part', self.path('link.h5part'))  # leads to what is not there yet
        self.refused(*run, 'link.h5part', '--json', 'later.h5part', reason='would replace each other')
        self.write('one.h5part', 'old')
        os.link(self.path('one.h5part'), self.path('other.h5part'))
        self.refused(*run, 'one.h5part', '--json', 'other.h5part', reason='would replace each other')
        self.refused('bench', '--table', 'paper003-substeps', '-o', 'a.svg', '--json', 'a.svg', reason='each other')
        self.refused('play', 'scene.yaml', '--record', 'a', '--json', 'a', reason='--record a and --json a would replace '
                     'each other')
        self.refused('devices', '--record', 'a', '--json', 'a', reason='would replace each other')
        self.refused('info', 'scene.yaml', '--save', 'a.yaml', '--json', 'a.yaml', reason='--save a.yaml and --json a.yaml would '
                     'replace each other')

    def test_what_comes_with_an_output(self):
        self.refused('chart', 'scene.yaml', '-o', 'a.b.svg', '--json', 'a.b.csv',
                     reason='the figures of -o a.b.csv and --json a.b.csv would replace each other')
        self.refused('export', 'x.h5part', '-o', 'a.pvd', '--json', 'a/a-0000.vtp',
                     reason='the folder of -o a and --json a/a-0000.vtp would replace each other')
        self.refused('export', 'a/x.h5part', '-o', 'a.ply.series',
                     reason='the folder of -o a would replace the file of snapshots a/x.h5part')
        self.refused('render', 'scene.yaml', '-o', 'frames', '--json', 'frames/frame_00003.png', reason='each other')
        self.refused('render', 'scene.yaml', '-o', 'frames/', '--json', 'frames', reason='each other')
        self.refused('validate', 'free_fall', '-o', 'plots', '--json', 'plots/free_fall.svg', reason='each other')

    def test_what_is_read(self):
        would = '{} would replace {}'.format
        self.refused('run', 'scene.yaml', '-o', 'a.h5part', '--json', 'scene.yaml',
                     reason='slosh run: ' + would('--json scene.yaml', 'the scene scene.yaml'))
        self.refused('info', 'scene.yaml', '--json', './scene.yaml', reason=would('--json ./scene.yaml', 'the scene scene.yaml'))
        self.write('two.yaml', command.SCENE)
        os.link(self.path('two.yaml'), self.path('hard.yaml'))
        self.refused('bench', 'scene.yaml', 'two.yaml', '--json', 'hard.yaml',
                     reason=would('--json hard.yaml', 'the scene two.yaml'))
        self.refused('play', 'scene.yaml', '--record', 'scene.yaml', reason=would('--record scene.yaml', 'the scene'
                                                                                  ' scene.yaml'))
        self.refused('export', 'two.yaml', '-o', 'a.vtp', '--json', 'two.yaml',
                     reason=would('--json two.yaml', 'the file of snapshots two.yaml'))
        self.refused('replay', 'two.yaml', '--json', 'two.yaml', reason=would('--json two.yaml', 'the recording two.yaml'))
        self.refused('run', 'scene.yaml', '-o', 'a.h5part', '--device', 'file:two.yaml', '--json', 'hard.yaml',
                     reason=would('--json hard.yaml', '--device two.yaml'))
        self.refused('devices', '--device', 'file:two.yaml', '--json', 'two.yaml',
                     reason=would('--json two.yaml', '--device two.yaml'))
        self.refused('run', 'scene.yaml', '-o', 'a.h5part', '--device', 'file:x', '--mapping', 'two.yaml',
                     '--json', 'two.yaml', reason=would('--json two.yaml', '--mapping two.yaml'))
        os.mkdir(self.path('shaders'))
        self.refused('run', 'scene.yaml', '-o', 'a.h5part', '--shaders', 'shaders', '--json', 'shaders/a.frag',
                     reason=would('--json shaders/a.frag', '--shaders shaders'))

    def test_tables_that_a_scene_names(self):
        would = '{} would replace {}'.format
        tables = command.SCENE.replace('0.5, 0.5]}\nsolver', '0.5, 0.5]}\n        below: heights.csv\nsolver')
        os.mkdir(self.path('in'))
        self.write('in/tank.yaml', tables)
        self.write('in/heights.csv', 'x (m),height (m)\n-0.5,0.3\n0.5,0.5\n')
        self.write('flow.csv', 'x (m),vx (m/s)\n-0.5,0\n0.5,0\n')
        run = ('run', 'in/tank.yaml', '-o', 'a.h5part')
        for option in ('--json', '--forces', '--probes'):
            self.refused(*run, option, 'in/heights.csv',
                         reason='slosh run: ' + would(f'{option} in/heights.csv', "the scene's table in/heights.csv"))
        self.refused('play', 'in/tank.yaml', '--record', 'in//heights.csv', reason="the scene's table in/heights.csv")
        self.refused('bench', 'scene.yaml', 'in/tank.yaml', '--json', 'in/heights.csv', reason="the scene's table in/heights.csv")
        flow = self.path('flow.csv')
        self.refused('run', 'scene.yaml', '-o', 'a.h5part', '--set', f'fluids[0].velocity_table={flow}', '--json', 'flow.csv',
                     reason=would('--json flow.csv', f"the scene's table {flow}"))
        self.assertEqual(self.slosh(*run, '--time', '0', '--quiet', '--json', 'heights.csv')[0], 0)  # another one

    def test_volumes_that_a_view_names(self):
        os.mkdir(self.path('in'))
        self.write('in/v.yaml', 'file: v.raw\nsize: [2, 2, 2]\ntype: uint8\nspacing: [0.1, 0.1, 0.1]\n')
        self.write('in/v.raw', 'abcdefgh')
        layer = ('--set', 'view.pbsr.layers=[{file: in/v.yaml, level: 100}]')
        for name in ('in/v.yaml', 'in/v.raw'):
            self.refused('run', 'scene.yaml', '-o', 'a.h5part', *layer, '--json', name,
                         reason=f"slosh run: --json {name} would replace the scene's volume {name}")

    def test_scenes_that_are_read_unasked(self):
        os.mkdir(self.path('scenes'))
        self.refused('play', '--json', 'scenes/box_slosh.yaml',
                     reason='--json scenes/box_slosh.yaml would replace the folder of scenes scenes')

    def test_files_beside_are_no_clash(self):
        os.mkdir(self.path('frames'))
        code, said = self.slosh('render', 'scene.yaml', '-o', 'frames', '--json', 'frames/figures.json', '--frames', '1',
                                *SMALL)
        self.assertEqual(code, 0, said)
        self.assertEqual(sorted(os.listdir(self.path('frames'))), ['figures.json', 'frame_00000.png'])


class Links(CommandTest):
    """An output that is a link is written through: the link stays, and its target gets the content."""

    def test_write_through(self):
        os.mkdir(self.path('far'))
        for name in ('a.h5part', 'a.json', 'a.png', 'a.mp4'):
            os.symlink('far/' + name, self.path(name))
        self.write('far/a.png', 'old')
        commands = (('run', '-o', 'a.h5part', '--json', 'a.json', '--quiet'),
                    ('run', '-o', 'a.h5part', '--resume', '--quiet', '--time', '0.1'),
                    ('render', '-o', 'a.png', *SMALL), ('render', '-o', 'a.mp4', '--frames', '2', *SMALL))
        for name, *rest in commands:
            code, said = self.slosh(name, 'scene.yaml', '--time', '0', *rest)
            self.assertEqual(code, 0, said)
        self.assertEqual(sorted(os.listdir(self.path('far'))), ['a.h5part', 'a.json', 'a.mp4', 'a.png'])
        self.assertTrue(all(os.path.islink(self.path(name)) for name in self.entries() if name != 'far'))
        self.assertGreater(len(whole_steps(self.path('far/a.h5part'))), 1)
        self.assertIn(b'IEND', self.read('far/a.png')[-12:])

    def test_folder(self):
        self.assertEqual(self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', '0', '--quiet')[0], 0)
        os.mkdir(self.path('far'))
        os.symlink('far', self.path('out'))
        for _ in range(2):
            code, said = self.slosh('export', 'a.h5part', '-o', 'out.pvd', '--quiet')
            self.assertEqual(code, 0, said)
            self.assertTrue(os.path.islink(self.path('out')))
            self.assertEqual(os.listdir(self.path('far')), ['out-0000.vtp'])
        self.assertEqual(self.entries(), ['a.h5part', 'far', 'out', 'out.pvd'])

    def test_circle(self):
        os.symlink('b.json', self.path('a.json'))
        os.symlink('a.json', self.path('b.json'))
        code, said = self.slosh('run', 'scene.yaml', '-o', 'k.h5part', '--time', '0', '--json', 'a.json')
        self.assertEqual(code, 1, said)
        self.assertIn('a.json: is a link that leads nowhere: Too many levels of symbolic links; name a file', said)
        self.assertEqual(self.entries(), ['a.json', 'b.json'])


class Signals(CommandTest):
    LONG = ['--time', '30', '--size', '64x48']

    def under_way(self, process):
        """Until it has done a hundredth."""
        while ' %' not in process.stderr.readline():
            self.assertIsNone(process.poll(), 'the program ended too early')

    def stop(self, process, number):
        """As Ctrl-C in a terminal: to the whole process group."""
        os.killpg(process.pid, number)
        said = process.stderr.read()
        self.assertEqual(process.wait(timeout=command.PATIENCE), 130, said)
        return said

    def test_kill_during_run(self):
        """Other moments: tests/long/test_kills.py."""
        process = self.start('run', 'scene.yaml', '-o', 'a.h5part', '--time', '100000', '--every', '0.004', '--quiet')
        self.wait_for(self.has('a.h5part', 200000), process)
        process.kill()
        process.wait()
        self.assertGreater(len(whole_steps(self.path('a.h5part'))), 0)
        self.assertEqual(self.entries(), ['a.h5part'])

    def test_interrupt_run(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.start('run', 'scene.yaml', '-o', 'a.h5part', '--time', '100000')
            self.wait_for(self.has('a.h5part', 100000), process)
            said = self.stop(process, number)
            self.assertRegex(said, r'stopped at t = [0-9.]+ s; a\.h5part is whole')
            steps = whole_steps(self.path('a.h5part'))
            self.assertIn(f'a.h5part, {len(steps)} snapshots', said)
            self.assertEqual(self.entries(), ['a.h5part'])
            os.remove(self.path('a.h5part'))

    def test_interrupt_video(self):
        process = self.start('render', 'scene.yaml', '-o', 'a.mp4', *self.LONG)
        self.under_way(process)
        self.assertRegex(self.entries()[0], r'^a\.mp4\.\d+\.tmp$')
        said = self.stop(process, signal.SIGINT)
        self.assertRegex(said, r'stopped at t = [0-9.]+ s; a\.mp4 is whole')
        self.assertEqual(self.entries(), ['a.mp4'])
        self.assertIn(f'a.mp4, {video_frames(self.path("a.mp4"))} picture', said)

    def test_interrupt_folder(self):
        process = self.start('render', 'scene.yaml', '-o', 'frames', *self.LONG)
        self.wait_for(self.has('frames/frame_00003.png'), process)
        self.stop(process, signal.SIGINT)
        names = sorted(os.listdir(self.path('frames')))
        self.assertEqual(names, [f'frame_{k:05}.png' for k in range(len(names))])
        for name in names:
            self.assertIn(b'IEND', self.read(f'frames/{name}')[-12:])

    def test_interrupt_png(self):
        process = self.start('render', 'scene.yaml', '-o', 'a.png', *self.LONG)
        self.under_way(process)
        said = self.stop(process, signal.SIGINT)
        self.assertRegex(said, r'stopped at t = [0-9.]+ s; a\.png is whole')
        self.assertEqual(self.entries(), ['a.png'])
        self.assertIn(b'IEND', self.read('a.png')[-12:])

    def test_interrupt_mesh(self):
        """A solid of 80,000 long triangles that cut each other, while it is made: behind the process that read it."""
        number = random.Random(1)
        with open(self.path('needles.obj'), 'w', encoding='ascii') as file:
            for k in range(20000):
                tip, end = ([number.uniform(-1, 1) for _ in range(3)] for _ in range(2))
                for corner in (tip, end, [end[0] + 0.002, *end[1:]], [end[0], end[1] + 0.002, end[2]]):
                    file.write('v {} {} {}\n'.format(*corner))
                for face in ((1, 3, 2), (1, 4, 3), (1, 2, 4), (2, 3, 4)):
                    file.write('f {} {} {}\n'.format(*(4 * k + corner for corner in face)))
        before, read = self.entries(), []

        def is_read(process):
            children = pathlib.Path(f'/proc/{process.pid}/task/{process.pid}/children').read_text()
            read.append(bool(children))
            return not children and any(read)

        process = self.start('run', 'scene.yaml', '-o', 'a.h5part', '--set', 'solids=[{mesh: {file: needles.obj, centre: [0, 0.5, 0]}}]')
        self.wait_for(lambda: is_read(process), process)
        self.assertIn('needles.obj: stopped', self.stop(process, signal.SIGINT))
        self.assertEqual(self.entries(), before)


if __name__ == '__main__':
    command.main()
