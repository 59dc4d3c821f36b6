"""slosh export: a plain reader finds every number, and files are whole or not there."""
import json
import os
import re
import shutil
import signal

import h5py
import numpy

import command
from command import CommandTest, TinyDiskTest, limit_files

PLY_TYPES = {'float': '<f4', 'int': '<i4', 'uint': '<u4', 'uchar': 'u1'}


def read_ply(content):
    """By what its header says: {property: values} of the vertices; of a mesh, and the vertices of its triangles."""
    head, rows = content.split(b'end_header\n', 1)
    lines = head.decode().split('\n')
    assert lines[:2] == ['ply', 'format binary_little_endian 1.0'], lines
    counts = [int(count) for count in re.findall(r'^element (?:vertex|face) (\d+)$', head.decode(), re.M)]
    kind = numpy.dtype([(name, PLY_TYPES[type_]) for _, type_, name in
                        (line.split() for line in lines if re.match(r'property (?!list)', line))])
    vertices = numpy.frombuffer(rows[:counts[0] * kind.itemsize], kind)
    if len(counts) == 1:
        assert len(rows) == counts[0] * kind.itemsize
        return vertices
    assert lines[-2] == 'property list uchar int vertex_indices', lines
    faces = numpy.frombuffer(rows[counts[0] * kind.itemsize:], numpy.dtype([('count', 'u1'), ('vertex', '<i4', 3)]))
    assert len(faces) == counts[1] and (faces['count'] == 3).all()
    return vertices, faces['vertex']


def enclosed(points, triangles):
    """The volume in a mesh, which must be closed: each side is there once, and once the other way round."""
    triangles = numpy.array(triangles)
    sides = numpy.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    keys = sides[:, 0] * len(points) + sides[:, 1]
    assert len(numpy.unique(keys)) == len(keys)
    numpy.testing.assert_array_equal(numpy.sort(keys), numpy.sort(sides[:, 1] * len(points) + sides[:, 0]))
    assert len(numpy.unique(numpy.float32(points), axis=0)) == len(points)  # no two vertices in one place
    corner = numpy.float64(points)[triangles]
    return numpy.einsum('ij,ij->', corner[:, 0], numpy.cross(corner[:, 1], corner[:, 2])) / 6


def rotated(q, v):
    """Vectors v turned by the unit quaternion q = x y z w, by its matrix."""
    x, y, z, w = q
    matrix = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                          [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                          [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    return v @ matrix.T


def in_box(group):
    """Positions and velocities as the file has them."""
    return (numpy.stack([group[axis] for axis in 'xyz'], 1),
            numpy.stack([group[f'velocity_{k}'] for k in range(3)], 1))


def in_world(group, pose=None):
    """By the attributes of the group, or by those of another."""
    pose = group.attrs if pose is None else pose
    position, velocity = (numpy.float64(values) for values in in_box(group))
    arm = rotated(pose['box_orientation'], position)
    return (pose['box_position'] + arm, pose['box_velocity'] + numpy.cross(pose['box_angular_velocity'], arm)
            + rotated(pose['box_orientation'], velocity))


class ExportTest(CommandTest):
    def make(self, *more):
        self.once('a.h5part', 'run', 'scene.yaml', '-o', 'a.h5part', '--time', '0.4', '--every', '0.05', '--quiet', *more)

    def export(self, output, *more, code=0, source='a.h5part'):
        done, said = self.slosh('export', source, '-o', output, *more)
        self.assertEqual(done, code, said)
        return said

    def stretch(self, count):
        """The file as if it had so many steps: the same ones again and again."""
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            has = len(file)
            for k in range(has, count):
                file[f'Step#{k}'] = file[f'Step#{k % has}']

    def empty_the_last(self):
        """The last step of the file then has no particles."""
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            group = file[f'Step#{len(file) - 1}']
            for name, values in group.items():
                kind = values.dtype
                del group[name]
                group.create_dataset(name, data=numpy.empty(0, kind))

    def assert_whole_series(self, name, count):
        """The index and its folder, to the last byte of each file."""
        index = self.read(f'{name}.pvd').decode()
        files = re.findall(r'file="([^"]*)"', index)
        self.assertTrue(index.endswith('</VTKFile>\n'))
        self.assertEqual(files, [f'{name}/{name}-{k:04}.vtp' for k in range(count)])
        self.assertEqual(sorted(os.listdir(self.path(name))), [os.path.basename(file) for file in files])
        for file in files:
            self.assertTrue(self.read(file).endswith(b'</PolyData>\n</VTKFile>\n'))


class Surface(ExportTest):
    def mesh(self, *more):
        """Points, triangles and what the figures say."""
        self.export('a.ply', '--surface', '--json', 'a.json', '--quiet', *more)
        vertices, triangles = read_ply(self.read('a.ply'))
        figures = json.loads(self.read('a.json'))['surface']
        self.assertEqual((figures['vertices'], figures['triangles']), (len(vertices), len(triangles)))
        return numpy.stack([vertices[axis] for axis in 'xyz'], 1), triangles, figures

    def test_a_dam_break(self):
        """From the block to the splash at the other wall, with each method: the fluid's volume at any cell."""
        for method in ('mueller', 'wcsph'):
            code, said = self.slosh('run', 'dam_break', '-o', 'a.h5part', '--time', '0.8', '--every', '0.4', '--quiet',
                                    '--particles', '2000', '--method', method)
            self.assertEqual(code, 0, said)
            with h5py.File(self.path('a.h5part'), 'r') as file:
                volume = len(file['Step#0']['x']) * file.attrs['spacing'] ** 3
            for time, cell in (('0', '0.4'), ('0.4', '1'), ('0.8', '0.4'), ('0.8', '1')):
                points, triangles, figures = self.mesh('--time', time, '--cell', cell)
                self.assertLess(abs(enclosed(points, triangles) / volume - 1), 0.005)
                self.assertLess(abs(figures['volume'] / volume - 1), 0.005)
                self.assertTrue(0.4 < figures['level'] < 0.62, figures)
            for time in ('0', '0.8'):
                points, triangles, figures = self.mesh('--time', time, '--level', '0.5')
                self.assertEqual(figures['level'], 0.5)
                self.assertLess(abs(enclosed(points, triangles) / volume - 1), 0.045)  # a splash of `mueller`: 0.037

    def test_two_runs_give_the_same_bytes(self):
        self.make('--time', '0.1')
        self.export('a.vtp', '--surface')
        self.export('b.vtp', '--surface')
        self.assertEqual(self.read('a.vtp'), self.read('b.vtp'))

    def test_fluids_and_their_colours(self):
        self.make('--time', '0', '--set', 'fluids[0].color=[1, 0.5, 0]')
        self.export('a.ply', '--surface')
        vertices, _ = read_ply(self.read('a.ply'))
        for side, fluid, density in ((vertices['x'] < -0.15, 0, 1000), (vertices['x'] > 0.15, 1, 900)):
            self.assertTrue((vertices['fluid'][side] == fluid).all())
            self.assertLess(abs(numpy.median(vertices['density'][side]) / density - 1), 0.1)
        self.assertTrue((vertices['red'][vertices['fluid'] == 0] == 255).all())
        self.assertLess(vertices['red'][vertices['fluid'] == 1].max(), 255)

    def test_nothing_at_that_level(self):
        self.make('--time', '0')
        self.empty_the_last()
        said = self.export('a.ply', '--surface')
        self.assertIn('a.ply: warning: 1 of 1 snapshots has no fluid at that level, and no surface\n', said)
        vertices, triangles = read_ply(self.read('a.ply'))
        self.assertEqual((len(vertices), len(triangles)), (0, 0))


class Ply(ExportTest):
    def same(self, rows, group, frame):
        position, velocity = frame(group)
        for k in range(3):
            numpy.testing.assert_allclose(rows['xyz'[k]], position[:, k], rtol=0, atol=3e-7)
            numpy.testing.assert_allclose(rows[('vx', 'vy', 'vz')[k]], velocity[:, k], rtol=0, atol=3e-6)
        for name in ('density', 'pressure', 'fluid', 'id'):
            numpy.testing.assert_array_equal(rows[name], group[name])

    def test_every_number(self):
        self.make()
        self.export('last.ply')
        self.export('at.ply', '--time', '0.12', '--frame', 'world')
        self.export('exact.ply', '--time', '0.4')
        self.assertEqual(self.read('exact.ply'), self.read('last.ply'))
        with h5py.File(self.path('a.h5part'), 'r') as file:
            self.same(read_ply(self.read('last.ply')), file['Step#8'], in_box)
            self.same(read_ply(self.read('at.ply')), file['Step#3'], in_world)

    def test_a_file_that_knows_no_colours(self):
        self.make('--time', '0')
        self.export('new.ply')
        self.assertIn('red', read_ply(self.read('new.ply')).dtype.names)
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file.attrs['fluid_colors']
        self.export('old.ply')
        rows = read_ply(self.read('old.ply'))
        self.assertNotIn('red', rows.dtype.names)
        self.assertEqual(len(rows), 500)

    def test_colours_of_a_scalar(self):
        """In a series the least and the greatest of all snapshots have the colormap's ends."""
        self.make('--time', '0.2', '--set', 'motion=[{spin: {axis: [1, 2, 3], rate: 3}}]')
        for frame, velocity in (('box', in_box), ('world', in_world)):
            self.export('a.ply.series', '--color-by', 'speed', '--frame', frame)
            with h5py.File(self.path('a.h5part'), 'r') as file:
                speed = numpy.array([numpy.linalg.norm(velocity(file[f'Step#{k}'])[1], axis=1) for k in range(5)])
            found = [read_ply(self.read(f'a/a-{k:04}.ply')) for k in range(5)]
            green = numpy.array([rows['green'] for rows in found])  # rises all the way in mako
            low, high = (re.findall(rb'speed from (\S+) to (\S+) m/s', self.read(f'a/a-{k:04}.ply'))[0] for k in (0, 4))
            self.assertEqual(low, high)
            numpy.testing.assert_allclose([float(number) for number in low], [speed.min(), speed.max()], rtol=1e-5)
            self.assertEqual((green.min(), green.max()), (0x5d, 0xf5))
            order = numpy.argsort(speed, axis=None)
            self.assertGreaterEqual(numpy.diff(green.flatten()[order].astype(int)).min(), -1)
        self.export('a.ply', '--color-by', 'pressure', '--surface', '--time', '0.1')
        vertices, _ = read_ply(self.read('a.ply'))
        order = numpy.argsort(vertices['pressure'])
        self.assertGreaterEqual(numpy.diff(vertices['green'][order].astype(int)).min(), -1)
        self.assertGreater(len(numpy.unique(vertices['green'])), 20)

    def test_a_large_id(self):
        self.make('--time', '0')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            file['Step#0']['id'][7] = 1 << 32
        self.assertIn('write a .vtp', self.export('a.ply', code=1))
        self.export('a.vtp')
        self.assertEqual(self.entries(), ['a.h5part', 'a.vtp'])


class SeriesTest(ExportTest):
    def write_on(self, every, size=1):
        """A run that writes on and on, with that many bytes in its file, which it has begun: not what an earlier one left."""
        if os.path.exists(self.path('a.h5part')):
            os.remove(self.path('a.h5part'))
        process = self.start('run', 'scene.yaml', '-o', 'a.h5part', '--time', '100000', '--every', every, '--quiet')
        self.wait_for(lambda: os.path.exists(self.path('a.h5part')) and os.path.getsize(self.path('a.h5part')) >= size, process)
        return process

    def begin(self, count=1):
        """An export that has so many files."""
        process = self.start('export', 'a.h5part', '-o', 'b.pvd', '--quiet')
        self.wait_for(lambda: any(len(os.listdir(self.path(name))) >= count for name in self.entries()
                                  if re.fullmatch(rf'b\.{process.pid}\.tmp', name)), process)
        return process


class Whole(SeriesTest):
    def test_series(self):
        self.make()
        said = self.export('b.pvd', '--json', 'b.json')
        self.assertRegex(said, r'export: 100 % .*\nb\.pvd: 9 snapshots up to t = 0\.4 s, 500 particles, in the frame of '
                               r'the box\n')
        self.assert_whole_series('b', 9)
        out = json.loads(self.read('b.json'))
        wall = out.pop('wall_seconds')
        self.assertGreater(wall, 0)
        self.assertEqual(out, {'command': 'export', 'input': 'a.h5part', 'output': 'b.pvd', 'frame': 'box',
                               'snapshots': 9, 'particles': 500, 'left_out': 0, 'simulated_seconds': 0.4, 'stopped': False})
        self.make('--time', '0.1')
        self.assertEqual(self.export('b.pvd', '--quiet'), '')
        self.assert_whole_series('b', 3)  # none is left of the longer one
        self.assertEqual(self.entries(), ['a.h5part', 'b', 'b.json', 'b.pvd'])

    def test_an_incomplete_last_step_is_dropped(self):
        self.make()
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file['Step#8'].attrs['complete']
            del file['Step#8']['x']
        self.export('a.pvd')
        self.assert_whole_series('a', 8)
        with h5py.File(self.path('a.h5part'), 'r') as file:
            self.export('a.ply')
            numpy.testing.assert_array_equal(read_ply(self.read('a.ply'))['x'], file['Step#7']['x'])

    def test_a_run_that_was_killed(self):
        """Other moments: tests/long/test_kills.py."""
        process = self.write_on('0.004', 300000)
        process.kill()
        process.wait()
        self.export('a.pvd')
        self.assert_whole_series('a', len(command.whole_steps(self.path('a.h5part'))))

    def test_while_it_is_being_written(self):
        self.write_on('0.02')
        for _ in range(3):
            code, said = self.slosh('export', 'a.h5part', '-o', 'a.pvd', '--quiet')
            if code == 0:
                self.assert_whole_series('a', self.read('a.pvd').count(b'timestep'))
            else:  # a moment between two writes: said, and nothing done
                self.assertIn(code, (1, 2))
                self.assertIn('a.h5part', said)


class Bad(ExportTest):
    def refused(self, source, output, *more, words, code=2):
        before = self.entries()
        said = self.export(output, *more, source=source, code=code)
        self.assertRegex(said, words)
        self.assertEqual(self.entries(), before)

    def test_input(self):
        self.write('text.h5part', 'no snapshots')
        self.write('empty.h5part', '')
        os.mkdir(self.path('folder.h5part'))
        with h5py.File(self.path('none.h5part'), 'w') as file:
            file.attrs['title'] = 'nothing'
        for output in ('a.pvd', 'a.vtp', 'a.ply'):
            self.refused('missing.h5part', output, words='missing.h5part: cannot be read: No such file')
            for name in ('text', 'empty', 'folder'):
                self.refused(f'{name}.h5part', output, words=f'{name}.h5part: is no file of snapshots')
            self.refused('none.h5part', output, words='none.h5part: has no particles that slosh finds')

    def test_no_whole_step(self):
        self.make('--time', '0')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            file['Step#0'].attrs['complete'] = 0
        self.refused('a.h5part', 'a.pvd', words='has no whole snapshot')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            file.move('Step#0', 'Step#1')
        self.refused('a.h5part', 'a.pvd', words="a.h5part: Step#0 is missing or not whole, but there is 'Step#1'; give the "
                                                'steps names from Step#0 on')

    def test_damaged(self):
        self.make()
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file['Step#5']['pressure']
        self.refused('a.h5part', 'a.pvd', '--quiet', words=r"Step#5: 'pressure' is missing", code=1)
        self.refused('a.h5part', 'a.vtp', '--time', '0.25', words=r"Step#5: 'pressure' is missing", code=1)
        self.refused('a.h5part', 'a.ply.series', '--color-by', 'speed', words=r"Step#5: 'pressure' is missing", code=1)
        content = self.read('a.h5part')
        self.write('a.h5part', content[:len(content) // 2])
        self.refused('a.h5part', 'a.pvd', words='a.h5part: is no file of snapshots')

    def test_output(self):
        self.make('--time', '0')
        for name in ('b.h5part', 'a.abc', 'a', 'a.pvd/', '.ply', '.obj.series'):
            self.refused('a.h5part', name, words='use .pvd, .vtp, .ply, .ply.series, .obj or .obj.series')
        self.refused('a.h5part', 'no/a.vtp', words='No such file or directory; create it first', code=1)
        self.refused('a.h5part', 'no/a.pvd', words='No such file or directory; create it first', code=1)
        self.refused('a.h5part', 'a.vtp', '--json', 'no/a.json', words='no/a.json: cannot be written', code=1)
        self.refused('a.h5part', 'a.pvd', '--frame', 'moon', words='box|world')
        self.refused('a.h5part', 'a.pvd', '--time', '0', words='--time makes no sense for all snapshots, a.pvd')
        self.refused('a.h5part', 'a.vtp', '--time', '1', words='a.h5part: ends at 0 s, before --time 1')
        os.mkdir(self.path('b.vtp'))
        self.refused('a.h5part', 'b.vtp', words='is a folder; name a file', code=1)

    def test_surface(self):
        self.make('--time', '0')
        for name in ('--level', '--cell'):
            self.refused('a.h5part', 'a.ply', name, '0.5', words=f'{name} is of a surface; add --surface')
        for level in ('0', '-1', '1', 'nan', 'high'):
            self.refused('a.h5part', 'a.ply', '--surface', '--level', level, words='--level')
        for cell in ('0', '0.01', '5'):
            self.refused('a.h5part', 'a.ply', '--surface', '--cell', cell, words='--cell must be 0.05 to 4')
        self.refused('a.h5part', 'a.ply.series', '--surface', '--time', '0', words='--time makes no sense')
        self.refused('a.h5part', 'a.vtp', '--color-by', 'speed', words='--color-by is of a .ply or a .obj')
        self.refused('a.h5part', 'a.obj', words='a .obj holds meshes, no particles: add --surface')
        self.refused('a.h5part', 'a.obj.series', words='a .obj holds meshes, no particles: add --surface')
        self.refused('a.h5part', 'a.obj.series', '--surface', '--time', '0', words='--time makes no sense')
        self.refused('a.h5part', 'a.ply', '--color-by', 'mood', words='must be one of fluid|speed|density|pressure')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            file.attrs['box_size'] = [1000., 1000., 1000.]
        self.refused('a.h5part', 'a.ply', '--surface', words='more memory than this machine has .*; use a --cell of')
        self.export('b.ply')
        for name, value, words in (('box_size', [1., float('nan'), 1.], "'box_size' is nan along y"),
                                   ('spacing', 0., "'spacing' is 0"), ('spacing', float('nan'), "'spacing' is nan"),
                                   ('support_radius', 1e3, "'support_radius' is .* spacings"),
                                   ('fluid_densities', [0., 900.], "'fluid_densities' has 0")):
            with h5py.File(self.path('a.h5part'), 'r+') as file:
                usual = file.attrs[name]
                file.attrs[name] = value
            self.refused('a.h5part', 'a.ply', '--surface', words='a.h5part: ' + words)
            with h5py.File(self.path('a.h5part'), 'r+') as file:
                file.attrs[name] = usual
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file.attrs['spacing']
        self.refused('a.h5part', 'a.ply', '--surface', words="a.h5part: 'spacing' is missing")

    def test_surface_of_a_plane(self):
        code, said = self.slosh('run', 'drop_2d', '-o', 'a.h5part', '--time', '0', '--quiet')
        self.assertEqual(code, 0, said)
        self.refused('a.h5part', 'a.ply', '--surface', words='a scene of two dimensions has no surface')
        self.export('a.ply')

    def test_particles_too_far_apart_for_a_grid(self):
        self.make('--time', '0.1')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            for name in 'xyz':
                file['Step#1'][name][3] = 99
        self.refused('a.h5part', 'a.pvd', '--surface', '--cell', '0.2', '--quiet', words='particles are too far apart', code=1)

    def test_a_folder_of_others(self):
        self.make('--time', '0')
        os.mkdir(self.path('thesis'))
        self.write('thesis/chapter.tex', 'much work')
        self.refused('a.h5part', 'thesis.pvd', words="'chapter.tex' in it is no .vtp of an export", code=1)
        self.assertEqual(self.read('thesis/chapter.tex'), b'much work')
        self.export('thesis2.pvd', '--quiet')
        self.refused('a.h5part', 'thesis2.ply.series', words="'thesis2-0000.vtp' in it is no .ply of an export", code=1)
        self.write('file', '')
        self.refused('a.h5part', 'file.pvd', words='file: is to be a folder', code=1)


    def test_trails(self):
        self.make('--time', '0.1')
        vtp = ['a.h5part', 'a.vtp', '--trails']
        self.refused(*vtp, '[]', words='--trails must be {key: value, ...}')
        self.refused(*vtp, '{strid: 2}', words='unknown key "strid"; did you mean stride; known are stride, ids')
        self.refused(*vtp, '{stride: 0}', words='stride must be 1 to')
        self.refused(*vtp, '{ids: "3, -4"}', words='ids "3, -4" is no list')
        self.refused(*vtp, '{plane_point: [0, 1, 0]}', words='plane_point is of a plane; add plane_normal')
        self.refused(*vtp, '{region_min: [0, 2, 0], region_max: [1, 1, 1]}', words='nothing is between region_min 2 and .* along y')
        self.refused(*vtp, '{length: 0.01}', words='a line needs two steps, and there is one .*; take a larger length')
        self.refused(*vtp, '{}', '--time', '0', words='a line needs two steps, and there is one .*; take a later --time')
        self.refused(*vtp, '{}', '--scalar', 'mood', words='--scalar mood is not known')
        for option in (['--surface'], ['--raw'], ['--kernel', 'cubic'], ['--size', '9x9'], ['--color-by', 'speed']):
            self.refused(*vtp, '{}', *option, words=f'{option[0]} makes no sense with --trails')
        for name in ('a.pvd', 'a.ply', 'a.csv', 'vtp'):
            self.refused('a.h5part', name, '--trails', '{}', words="cannot tell the format of trails from '.*'; use .vtp")
        self.refused('a.h5part', 'a.vti', '--trails', '{}', '--slice', '{}', words='--trails makes no sense with --slice')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file['Step#1']['pressure']
        self.refused(*vtp, '{}', '--scalar', 'pressure', words='a.h5part: Step#1 has no pressure', code=1)
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file['Step#1']['id']
        self.refused(*vtp, '{}', words='a.h5part: Step#1 has no ids', code=1)
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file['Step#2']['id']
        self.refused(*vtp, '{}', words='Step#2 has no ids')

    def test_no_trails(self):
        self.make('--time', '0.1')
        for text, words in (('{ids: "900"}', 'no particle has such an id: there are no trails'),
                            ('{plane_point: [9, 0, 0], plane_normal: [1, 0, 0]}', 'none of 25 particles crosses that plane'),
                            ('{region_min: [9, 9, 9], region_max: [10, 10, 10]}', 'none of 25 particles is in that region')):
            self.assertIn(f'a.vtp: warning: {words}', self.export('a.vtp', '--trails', text, '--quiet'))
            self.assertIn(b'NumberOfLines="0"', self.read('a.vtp'))


class Flaws(ExportTest):
    """What no simulation writes is said, a line each; what has no place is left out."""

    def damage(self, step, **fields):
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            for name, values in fields.items():
                for i, value in values.items():
                    file[f'Step#{step}'][name][i] = value

    def setUp(self):
        super().setUp()
        self.make('--time', '0.1')

    def test_a_sound_file_has_none(self):
        self.assertEqual(self.export('a.pvd', '--quiet'), '')

    def test_each_is_said(self):
        nan = float('nan')
        with h5py.File(self.path('a.h5part')) as file:
            other = int(file['Step#2']['id'][20])
        self.damage(2, x={3: nan, 4: 1e30}, y={5: -101, 6: 99}, fluid={7: 77, 8: -1}, density={9: -5, 10: nan, 11: 0},
                    velocity_1={12: float('inf')}, pressure={13: nan}, id={21: other, 22: other})
        self.damage(1, z={3: nan}, fluid={7: 2})
        said = self.export('a.ply.series', '--quiet', '--json', 'a.json')
        expected = ('4 particles in 2 snapshots, the first of them Step#1, have a position that is not finite or more than '
                    '100 boxes away; left out',
                    '3 particles in 2 snapshots, the first of them Step#1, have a fluid that the file does not know; '
                    'exported as they are in the file',
                    '3 particles of Step#2 have a density that is not more than 0; exported as they are in the file',
                    '2 particles of Step#2 have a velocity or a pressure that is not finite; exported as they are in the '
                    'file',
                    '2 particles of Step#2 have the id of another one; exported as they are in the file')
        self.assertEqual(said, ''.join(f'a.h5part: warning: {line}\n' for line in expected))
        self.assertEqual(json.loads(self.read('a.json'))['left_out'], 4)
        written = read_ply(self.read('a/a-0002.ply'))
        self.assertEqual(len(written), 497)
        self.assertLessEqual(abs(written['y']).max(), 99)
        with h5py.File(self.path('a.h5part')) as file:  # the others, in their order
            keep = [i for i in range(500) if i not in (3, 4, 5)]
            numpy.testing.assert_array_equal(written['x'], file['Step#2']['x'][:][keep])
            numpy.testing.assert_array_equal(written['id'], file['Step#2']['id'][:][keep])
            numpy.testing.assert_array_equal(written['fluid'], file['Step#2']['fluid'][:][keep])
        said = self.export('b.vtp', '--quiet', '--time', '0.05')
        self.assertIn('a.h5part: warning: 1 particle of Step#1 has a position that is not finite', said)

    def test_a_surface_and_colours_are_of_the_sound_ones(self):
        """As without the particles that are damaged."""
        spoilt = {3: ('x', float('nan')), 4: ('y', 1e20), 5: ('fluid', 77), 6: ('density', -1e9), 7: ('pressure', float('inf'))}
        shutil.copy(self.path('a.h5part'), self.path('sound.h5part'))
        with h5py.File(self.path('sound.h5part'), 'r+') as file:
            for name, values in file['Step#2'].items():
                rest = numpy.delete(values[:], list(spoilt))
                del file['Step#2'][name]
                file['Step#2'].create_dataset(name, data=rest)
        for i, (name, value) in spoilt.items():
            self.damage(2, **{name: {i: value}})
        for output in ('a.ply', 'a.vtp'):
            said = self.export(output, '--surface', '--quiet')
            self.assertEqual(said.count('; left out\n'), 4, said)
            damaged = self.read(output)
            self.assertEqual(self.export(output, '--surface', '--quiet', source='sound.h5part'), '')
            self.assertEqual(self.read(output), damaged)
        self.damage(2, velocity_0={3: 1e9})
        self.export('c.ply', '--color-by', 'speed')
        self.assertNotIn(b'e+0', re.search(rb'comment colours: .*', self.read('c.ply')).group())


class FullDisk(ExportTest):
    def full(self, output, size, *more):
        code, said = self.slosh('export', 'a.h5part', '-o', output, '--quiet', *more, before=limit_files(size))
        self.assertEqual(code, 1, said)
        self.assertIn(f'{output}: cannot be written: File too large', said)

    def test_new(self):
        self.make('--time', '0.1')
        for output in ('b.pvd', 'b.vtp', 'b.ply'):
            for size in (100, 5000, 20000):
                self.full(output, size)
        for output in ('b.pvd', 'b.vtp', 'b.ply', 'b.ply.series', 'b.obj', 'b.obj.series'):
            for size in (2000, 50000):  # LLVM's OpenMP, in the sanitized build, makes a file of 1 kB
                self.full(output, size, '--surface')
        self.assertEqual(self.entries(), ['a.h5part'])

    def test_trails(self):
        """Files without a name hold them until all are there."""
        self.make('--time', '0.3')
        for size in (100, 60000, 70000):
            self.full('b.vtp', size, '--trails', '{stride: 1}')
        self.assertEqual(self.entries(), ['a.h5part'])

    def test_an_older_one_stays(self):
        self.make('--time', '0.1')
        self.export('b.pvd')
        self.make('--time', '0.4')
        before = self.read('b.pvd')
        self.full('b.pvd', 20000)
        self.assertEqual(self.read('b.pvd'), before)
        self.assert_whole_series('b', 3)
        self.assertEqual(self.entries(), ['a.h5part', 'b', 'b.pvd'])

    def test_no_room_for_the_index(self):
        """Few particles take less than the index of 200 snapshots does."""
        self.make('--time', '0.4', '--particles', '60')
        self.stretch(200)
        self.export('whole.pvd', '--quiet')
        self.assertLess(max(os.path.getsize(self.path(f'whole/{name}')) for name in os.listdir(self.path('whole'))), 9000)
        self.assertGreater(os.path.getsize(self.path('whole.pvd')), 9000)
        shutil.rmtree(self.path('whole'))
        os.remove(self.path('whole.pvd'))
        self.full('b.pvd', 9000)
        self.assertEqual(self.entries(), ['a.h5part'])


class TinyDisk(TinyDiskTest, ExportTest):
    def test_nothing_is_left(self):
        self.make('--time', '0.4')
        for size, output in (('60k', 'a.pvd'), ('16k', 'a.vtp'), ('16k', 'a.ply')):
            left = self.full(size, f'export a.h5part -o disk/{output}')
            self.assertEqual(left, ['a.h5part'])
        for size, output in (('60k', 'a.pvd'), ('60k', 'a.ply.series'), ('16k', 'a.vtp'), ('16k', 'a.ply'), ('16k', 'a.obj')):
            left = self.full(size, f'export a.h5part --surface -o disk/{output}')
            self.assertEqual(left, ['a.h5part'])


class Signals(SeriesTest):
    STEPS = 3000

    def setUp(self):
        super().setUp()
        self.make()
        self.stretch(self.STEPS)

    def test_kill(self):
        """At its first file, and amid the others."""
        for count in (1, self.STEPS // 4):
            process = self.begin(count)
            process.kill()
            self.assertEqual(process.wait(), -signal.SIGKILL)
            self.assertFalse({'b', 'b.pvd'} & set(self.entries()))
            self.assertTrue(all(name.endswith('.tmp') for name in self.entries() if name != 'a.h5part'))

    def test_interrupt(self):
        process = self.begin()
        os.killpg(process.pid, signal.SIGINT)
        said = process.stderr.read()
        self.assertEqual(process.wait(timeout=command.PATIENCE), 130, said)
        self.assertRegex(said, r'^stopped at t = [0-9.]+ s; b\.pvd is whole\n$')
        count = self.read('b.pvd').count(b'timestep')
        self.assertTrue(0 < count < self.STEPS)
        self.assert_whole_series('b', count)
        self.assertEqual(self.entries(), ['a.h5part', 'b', 'b.pvd'])


if __name__ == '__main__':
    command.main()
