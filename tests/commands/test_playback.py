"""`slosh render FILE.h5part`: the pictures of the run that wrote it, and what is no such file."""
import json
import os
import unittest

import h5py
import numpy

import command
from command import CommandTest, video_frames, without_text

SIZE = ['--size', '96x72']
QUIET = [*SIZE, '--quiet']


class PlaybackTest(CommandTest):
    def run_(self, *more, scene='scene.yaml', name='a.h5part'):
        self.once(name, 'run', scene, '-o', name, '--quiet', *more)

    def render(self, source, output, *more, code=0):
        done, said = self.slosh('render', source, '-o', output, *QUIET, *more)
        self.assertEqual(done, code, said)
        return said

    def assert_same_picture(self, of_file, of_scene):
        self.assertEqual(without_text(self.read(of_file)), without_text(self.read(of_scene)))


class Pictures(PlaybackTest):
    def compare(self, scene, at, *views):
        """In panels of one picture, each of the size of others here."""
        self.run_('--time', at, '--every', at, scene=scene)
        panels = ['--set', f'views=[{", ".join("{kind: %s}" % view for view in views)}]', '--set', 'view.volume.cells=24',
                  '--size', '192x144']
        self.render('a.h5part', 'file.png', *panels)
        self.render(scene, 'scene.png', '--time', at, *panels)
        self.assert_same_picture('file.png', 'scene.png')

    def test_every_view(self):
        self.compare('scene.yaml', '0.2', 'spheres', 'splat', 'volume', 'slice')
        self.compare('scene.yaml', '0.2', 'none')

    def test_two_dimensions(self):
        """Volumes of particles are areas there."""
        self.write('flat.yaml', 'box: {size: [1, 0.6]}\nparticles: {spacing: 0.02}\nsolver: {method: wcsph}\n'
                                'fluids: [{fill: [{block: {min: [-0.5, 0], max: [0, 0.4]}}]}]\n')
        self.compare('flat.yaml', '0.1', 'spheres', 'volume', 'slice')

    def test_areas_at_rest(self):
        """Without densities a particle of two dimensions has the area of fluid at rest."""
        self.write('flat.yaml', 'box: {size: [1, 0.6]}\nparticles: {spacing: 0.02}\nsolver: {method: wcsph}\n'
                                'fluids: [{fill: [{block: {min: [-0.5, 0], max: [0, 0.4]}}]}]\n')
        self.run_('--time', '0', scene='flat.yaml')
        more = ['--view', 'slice', '--set', 'view.color_by=speed']
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            file['Step#0/density'][:] = file.attrs['fluid_densities'][0]
        self.render('a.h5part', 'rest.png', *more)
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file['Step#0/density']
        self.render('a.h5part', 'none.png', *more)
        self.assert_same_picture('none.png', 'rest.png')

    def test_solids_that_move(self):
        self.write('paddle.yaml', command.SCENE.replace('solver:\n', 'solids:\n  - box: {centre: [0.1, 0.7, 0], size: '
                   '[0.1, 0.3, 0.2]}\n    color: [0.1, 0.6, 0.3]\n    motion: [{rock: {axis: [0, 0, 1], angle: 30, '
                   'frequency: 2}}]\nsolver:\n') + 'view: {range: [0, 0.7], camera: {from: [2, 2, 1], to: [0, 0.3, 0]}}\n')
        self.compare('paddle.yaml', '0.12', 'spheres', 'splat')

    def test_a_mesh_of_another_folder(self):
        """Found beside the snapshots, else where the scene was; without it the fluid is shown, and one line says why."""
        os.makedirs(self.path('there/models'))
        block = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
        sides = ['1 2 4 3', '5 7 8 6', '1 5 6 2', '3 4 8 7', '1 3 7 5', '2 6 8 4']  # counter-clockwise from outside
        self.write('there/models/a.obj', ''.join('v {} {} {}\n'.format(*v) for v in block) + ''.join(f'f {s}\n' for s in sides))
        self.write('there/s.yaml', self.read('scene.yaml').decode() +
                   'solids: [{mesh: {file: models/a.obj, centre: [0, 0.75, 0], scale: 0.2}}]\n')
        self.run_('--time', '0', scene='there/s.yaml')
        self.render('there/s.yaml', 'scene.png', '--time', '0')
        self.assertNotIn('neither', self.render('a.h5part', 'file.png'))
        self.assert_same_picture('file.png', 'scene.png')
        os.rename(self.path('there'), self.path('gone'))
        said = self.render('a.h5part', 'none.png')
        self.assertRegex(said, r'\Amodels/a.obj: neither at models/a.obj, beside the snapshots, nor in /.*/there, where the scene '
                               r'was, nor where scenes are looked for; put it there; it is not drawn\n')
        self.assertTrue(without_text(self.read('none.png')) != without_text(self.read('file.png')))
        os.rename(self.path('gone/models'), self.path('models'))
        self.render('a.h5part', 'beside.png')
        self.assert_same_picture('beside.png', 'scene.png')

    def test_emitters(self):
        jet = '    emit: [{disk: {centre: [0, 0.9, 0], direction: [0, -1, 0], radius: 0.2}, speed: 2}]\n'
        self.write('jet.yaml', command.SCENE.replace('    fill:', jet + '    fill:', 1))
        self.compare('jet.yaml', '0.2', 'spheres')

    def test_trails(self):
        """Of a single picture too: all steps before it are seen, at least as far apart as the view says."""
        self.run_('--time', '0.24', '--every', '0.004')
        self.render('a.h5part', 'bare.png', '--view', 'none', '--time', '0.2')
        for every, output in (('0', 'a.png'), ('0.02', 'frames'), ('0.02', 'b.png')):
            more = ['--view', 'none', '--set', 'view.trails.show=true', '--set', 'view.trails.length=0.1', '--set', 'view.trails.stride=3',
                    '--set', f'view.trails.every={every}', '--set', 'view.range=[0, 1]', '--time', '0.2', '--fps', '25']
            os.mkdir(self.path(f'scene-{output}'))
            self.render('scene.yaml', f'scene-{output}/{output}', *more)
            self.render('a.h5part', output, *more)
            names = [output] if output.endswith('png') else [f'{output}/{name}' for name in sorted(os.listdir(self.path(output)))]
            self.assertEqual(len(names), 5 if output == 'frames' else 1)
            for name in names:
                self.assert_same_picture(name, f'scene-{output}/{name}')
        self.assertNotEqual(self.read('a.png'), self.read('bare.png'))
        self.assertNotEqual(self.read('b.png'), self.read('bare.png'))
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file['Step#40']['x']
        said = self.render('a.h5part', 'without.png', *more)
        self.assertRegex(said, r"a\.h5part: Step#40.*; overlays do without it\n$")
        self.assertNotEqual(self.read('without.png'), self.read('b.png'))

    def test_settings_of_the_view(self):
        more = ['--set', 'view.color_by=density', '--set', 'view.range=[990, 1010]', '--set', 'view.legend=false']
        self.run_('--time', '0.1', '--every', '0.1')
        self.render('a.h5part', 'file.png', *more)
        self.render('scene.yaml', 'scene.png', '--time', '0.1', *more)
        self.assert_same_picture('file.png', 'scene.png')


def reads_so_far():
    """Of this process and of the children that it has waited for."""
    with open('/proc/self/io') as file:
        return int(dict(line.split(': ') for line in file.read().splitlines())['syscr'])


class Times(PlaybackTest):
    def test_a_picture(self):
        """The last step, or the newest at or before --time."""
        self.run_('--time', '0.1', '--every', '0.02')
        self.render('a.h5part', 'last.png')
        for at, shown in (('0.04', 0.04), ('0.0399', 0.02), ('0', 0), ('0.1', 0.1)):
            found = json.loads(self.slosh('render', 'a.h5part', '-o', 'a.png', *QUIET, '--time', at,
                                          '--json', 'a.json') and self.read('a.json'))
            self.assertAlmostEqual(found['simulated_seconds'], shown)
        self.assertEqual(self.read('a.png'), self.read('last.png'))
        self.assertEqual(self.render('a.h5part', 'b.png', '--time', '0.2', code=2),
                         'a.h5part: ends at 0.1 s, before --time 0.2\n')
        self.assertNotIn('b.png', self.entries())

    def test_a_video(self):
        """As long as the file; each picture of the newest step."""
        self.run_('--time', '0.4', '--every', '0.1')
        code, said = self.slosh('render', 'a.h5part', '-o', 'a.mp4', *SIZE, '--fps', '20')
        self.assertEqual(code, 0, said)
        self.assertEqual(video_frames(self.path('a.mp4')), 8)
        self.assertRegex(said, r'^renderer: \S')
        self.assertIn('render: 100 %', said)
        self.assertIn('a.mp4: 8 pictures up to t = 0.3 s, 500 particles, from a.h5part\n', said)
        self.render('a.h5part', 'frames', '--fps', '20', '--json', 'a.json')
        files = [self.read(f'frames/{name}') for name in sorted(os.listdir(self.path('frames')))]
        self.assertEqual(len(files), 8)
        for k in range(0, 8, 2):
            self.assertEqual(files[k], files[k + 1])
            self.assertNotIn(files[k], files[k + 2:])
        found = json.loads(self.read('a.json'))
        for key in ('wall_seconds', 'first_picture_seconds', 'renderer'):
            del found[key]
        self.assertAlmostEqual(found.pop('simulated_seconds'), 0.3)
        self.assertEqual(found, {'command': 'render', 'input': 'a.h5part', 'output': 'frames', 'pictures': 8,
                                 'particles': 500, 'snapshots': 5, 'stopped': False})
        self.render('a.h5part', 'few', '--fps', '20', '--time', '0.2')
        self.assertEqual(len(os.listdir(self.path('few'))), 4)
        self.render('a.h5part', 'three', '--frames', '3')
        self.assertEqual(len(os.listdir(self.path('three'))), 3)
        self.assertIn('--time 0.3 has no effect: --frames says how long it lasts\n',
                      self.render('a.h5part', 'three', '--frames', '3', '--time', '0.3'))
        self.assertEqual(self.render('a.h5part', 'nine', '--frames', '9', '--fps', '10', code=2),
                         'a.h5part: ends at 0.4 s; the last of --frames 9 would be at 0.8 s\n')

    def reads(self, count):
        """How often the program reads from files for a picture of the middle of so many steps."""
        self.run_('--time', '0')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            for k in range(1, count):
                file.copy(file['Step#0'], file, f'Step#{k}')
                file[f'Step#{k}'].attrs['TimeValue'] = 0.01 * k
        begun = reads_so_far()
        self.assertEqual(self.slosh('render', 'a.h5part', '-o', 'a.png', *QUIET, '--time', str(0.01 * (count // 2)), '--json',
                                    'a.json')[0], 0)
        reads = reads_so_far() - begun
        self.assertEqual(json.loads(self.read('a.json'))['snapshots'], count)
        self.assertAlmostEqual(json.loads(self.read('a.json'))['simulated_seconds'], 0.01 * (count // 2))
        return reads

    @unittest.skipUnless(os.path.exists('/proc/self/io'), 'the kernel counts no reads')
    def test_many_steps(self):
        """The first picture of a file comes as soon as that of a short one: what is not shown is not read."""
        self.assertLess(self.reads(600) - self.reads(10), 150)


class Refused(PlaybackTest):
    def refused(self, words, *more, source='a.h5part'):
        before = self.entries()
        said = self.render(source, 'a.png', *more, code=2)
        self.assertIn(words, said)
        self.assertEqual(self.entries(), before)

    def test_options(self):
        self.run_('--time', '0')
        for option in (['--backend', 'cpu'], ['--method', 'pbf'], ['--threads', '1'], ['--set', 'solver.step.dt=0.1'],
                       ['--particles', '100'], ['--interpolate'], ['--device', 'file:a'], ['--set', 'fluids[0].density=2']):
            self.refused(f"{' '.join(option[:2])} makes no sense for a.h5part: ".replace(' file:a', ''), *option)
        self.refused('--frames makes no sense for one picture, a.png', '--frames', '3')
        self.refused('--set view.radius=-1: ', '--set', 'view.radius=-1')
        self.refused('-o a.h5part would replace the scene a.h5part', '-o', 'a.h5part')

    def test_files(self):
        self.write('text.h5part', 'no snapshots')
        self.write('empty.h5part', '')
        os.mkdir(self.path('folder.h5part'))
        with h5py.File(self.path('other.h5part'), 'w') as file:
            file['image'] = numpy.zeros(4)
        self.refused('missing.h5part: cannot be read: No such file', source='missing.h5part')
        for name in ('text', 'empty', 'folder'):
            self.refused(f'{name}.h5part: is no file of snapshots', source=f'{name}.h5part')
        self.refused('other.h5part: has no particles that slosh finds; they must be in groups Step#0, Step#1, ... (H5Part)',
                     source='other.h5part')
        self.run_('--time', '0.1')
        content = self.read('a.h5part')
        self.write('half.h5part', content[:len(content) // 2])
        self.refused('half.h5part: is no file of snapshots', source='half.h5part')

    def test_a_scalar_that_the_file_lacks(self):
        self.run_('--time', '0')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file['Step#0']['pressure']
        self.assertIn('a.h5part: has no pressure; what follows from that cannot be shown\n',
                      self.render('a.h5part', 'a.png'))
        self.refused('a.h5part: has no pressure to colour by; view.color_by may be speed, density, compression',
                     '--set', 'view.color_by=pressure')
        self.refused('a.h5part: view.size.by needs pressure, which the file has not',
                     '--set', 'view.size.by=pressure')

    def test_overlays_that_the_file_lacks(self):
        """Apart from what colours, and also with colours of the fluids."""
        self.run_('--time', '0')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            for k in range(3):
                del file['Step#0'][f'velocity_{k}']
        glyphs = '--set', 'view.color_by=fluid', '--set', 'view.glyphs.show=true'
        self.refused('a.h5part: view.glyphs.show needs velocities, which the file has not', *glyphs)
        self.refused('a.h5part: has no speed to colour by; view.color_by may be density, pressure, compression, fluid',
                     '--set', 'view.color_by=speed', '--set', 'view.glyphs.show=true')
        self.refused('a.h5part: view.opacity.by needs velocities, which the file has not', '--set', 'view.color_by=density',
                     '--set', 'view.opacity.by=vorticity')

    def test_a_step_that_cannot_be_read(self):
        self.run_('--time', '0.1', '--every', '0.02')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file['Step#3']['y']
        said = self.render('a.h5part', 'a.mp4', '--json', 'a.json', code=1)
        self.assertIn("a.h5part: Step#3: 'y' is missing or of another length\n", said)
        self.assertEqual(json.loads(self.read('a.json'))['input'], 'a.h5part')
        self.assertEqual(self.entries(), ['a.h5part', 'a.json'])


class Odd(PlaybackTest):
    def test_no_particles(self):
        self.run_('--time', '0')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            step = file['Step#0']
            for name in list(step):
                kind = step[name].dtype
                del step[name]
                step.create_dataset(name, (0,), dtype=kind)
        self.render('a.h5part', 'a.png', '--set', 'views=[{kind: spheres}, {kind: splat}, {kind: volume}, {kind: slice}]', '--set', 'view.volume.cells=24')

    def test_spoilt_particles(self):
        self.run_('--time', '0')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            file['Step#0']['x'][:3] = numpy.nan
            file['Step#0']['fluid'][5] = 99
        said = self.render('a.h5part', 'a.png')
        self.assertIn('a.h5part: warning: 3 particles of Step#0 have a position that is not finite', said)
        self.assertIn('a.h5part: warning: 1 particle of Step#0 has a fluid that the file does not know; left out', said)

    def test_while_it_is_being_written(self):
        process = self.start('run', 'scene.yaml', '-o', 'a.h5part', '--time', '100000', '--every', '0.02', '--quiet')
        self.wait_for(lambda: os.path.exists(self.path('a.h5part')), process)
        for _ in range(3):
            code, said = self.slosh('render', 'a.h5part', '-o', 'a.png', *QUIET)
            if code != 0:  # a moment between two writes: said, and nothing done
                self.assertIn(code, (1, 2))
                self.assertIn('a.h5part', said)


if __name__ == '__main__':
    command.main()
