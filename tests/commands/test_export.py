"""slosh export: ParaView and a plain reader find every number, and files are whole or not there."""
import json
import os
import random
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import h5py
import numpy

import command
from command import CommandTest, TinyDiskTest, limit_files

# Runs in ParaView's Python, apart from h5py: each brings an HDF5 of its own. For all tests one, whose start takes longer than
# what it reads: a line of input names a file and what to write.
READ = """
import json, os
from paraview.simple import OpenDataFile
from paraview import servermanager
from vtk.util.numpy_support import vtk_to_numpy
def seen_of(data, time):
    arrays = data.GetPointData()
    names = [arrays.GetArrayName(k) for k in range(arrays.GetNumberOfArrays())]
    own = data.GetFieldData().GetArray('TimeValue')
    of_cells = data.GetCellData()
    lines, order = [], data.GetLines().GetData()
    order = vtk_to_numpy(order).tolist() if data.GetNumberOfLines() else []
    while order:
        lines.append(order[1:1 + order[0]])
        order = order[1 + order[0]:]
    cells = vtk_to_numpy(data.GetPolys().GetData()).tolist() if data.GetNumberOfPolys() else []
    return {'time': time, 'own_time': own and own.GetValue(0), 'vertices': data.GetNumberOfVerts(),
           'lines': lines, 'cells': {of_cells.GetArrayName(k): vtk_to_numpy(of_cells.GetArray(k)).tolist()
                                     for k in range(of_cells.GetNumberOfArrays())},
           'triangles': [cells[k + 1:k + 4] for k in range(0, len(cells), 4)],
           'points': vtk_to_numpy(data.GetPoints().GetData()).tolist() if data.GetNumberOfPoints() else [],
           'units': {name: arrays.GetArray(name).GetInformation().Get(data.GetPoints().GetData().UNITS_LABEL())
                     for name in names if data.GetPoints()},
           'types': {name: arrays.GetArray(name).GetDataTypeAsString() for name in names},
           'arrays': {name: vtk_to_numpy(arrays.GetArray(name)).tolist() for name in names}}
def steps_of(path):
    reader = OpenDataFile(path)
    reader.UpdatePipelineInformation()
    for time in list(reader.TimestepValues) or [None]:
        reader.UpdatePipeline() if time is None else reader.UpdatePipeline(time)
        data = servermanager.Fetch(reader)
        if data.IsA('vtkMultiBlockDataSet'):
            names = [data.GetMetaData(k).Get(data.NAME()) for k in range(data.GetNumberOfBlocks())]
            yield {'time': time, 'blocks': names, 'parts': [seen_of(data.GetBlock(k).GetBlock(0), time) for k in range(len(names))]}
        else:
            yield seen_of(data, time)
for line in open(0):
    path, out = json.loads(line)
    with open(out, 'w') as file:
        json.dump(list(steps_of(path)), file)
    os.write(1, b'read\\n')
"""

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
        code, said = self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', '0.4', '--every', '0.05', '--quiet',
                                *more)
        self.assertEqual(code, 0, said)

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
            self.assertTrue(self.read(file).endswith(b'</AppendedData>\n</VTKFile>\n'))


class ParaViewTest(ExportTest):
    @classmethod
    def setUpClass(cls):
        if not shutil.which('pvpython'):
            raise unittest.SkipTest('pvpython is not there: install python3-paraview')
        with tempfile.NamedTemporaryFile('w', suffix='.py', delete=False) as script:
            script.write(READ)
        cls.addClassCleanup(os.remove, script.name)
        cls.complaints = cls.enterClassContext(tempfile.TemporaryFile('w+'))
        cls.reader = subprocess.Popen(['pvpython', '--no-mpi', script.name], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                      stderr=cls.complaints, text=True)
        cls.addClassCleanup(cls.reader.communicate)

    def read_with_paraview(self, name):
        self.reader.stdin.write(json.dumps([self.path(name), self.path('read.json')]) + '\n')
        self.reader.stdin.flush()
        answer = self.reader.stdout.readline()
        self.complaints.seek(0)
        self.assertEqual((answer, self.complaints.read()), ('read\n', ''))
        return json.loads(self.read('read.json'))


class ParaView(ParaViewTest):
    def same_fields(self, seen, group):
        for name in ('density', 'pressure', 'fluid', 'id'):
            numpy.testing.assert_array_equal(seen['arrays'][name], group[name])
        self.assertEqual(seen['types'], {'velocity': 'float', 'density': 'float', 'pressure': 'float', 'fluid': 'int',
                                         'id': seen['types']['id']})
        self.assertIn(seen['types']['id'], ('long long', 'vtkIdType', 'long'))
        self.assertEqual(seen['vertices'], len(group['id']))

    def test_the_snapshots_themselves(self):
        self.make()
        seen = self.read_with_paraview('a.h5part')
        with h5py.File(self.path('a.h5part'), 'r') as file:
            self.assertEqual((len(seen), len(file)), (9, 9))
            for k, step in enumerate(seen):
                group = file[f'Step#{k}']
                self.assertEqual((step['time'], len(step['points'])), (group.attrs['TimeValue'], 500))
                position, velocity = in_box(group)
                numpy.testing.assert_array_equal(numpy.float32(step['points']), position)
                numpy.testing.assert_array_equal(numpy.float32(step['arrays']['velocity']), velocity)
                for name in ('density', 'pressure', 'fluid', 'id'):
                    numpy.testing.assert_array_equal(step['arrays'][name], group[name])
        self.assertNotEqual(seen[0]['points'], seen[8]['points'])  # not the same frame nine times, and not zeros
        self.assertEqual(sorted(seen[8]['arrays']['id']), list(range(500)))
        self.assertEqual(set(seen[8]['arrays']['fluid']), {0, 1})
        with h5py.File(self.path('a.h5part'), 'r') as file:
            units = dict(line.split(' = ') for line in file.attrs['units'].decode().split('\n') if line)
        self.assertEqual({name: units[name] for name in ('TimeValue', 'z', 'velocity_1', 'density', 'pressure')},
                         {'TimeValue': 's', 'z': 'm', 'velocity_1': 'm/s', 'density': 'kg/m3', 'pressure': 'Pa'})
        self.assertGreater(max(seen[8]['arrays']['density']), 900)

    def test_series(self):
        self.make()
        os.mkdir(self.path('in & out'))  # moved as a whole, the index finds its files
        self.export('in & out/a <b>.pvd', '--quiet')
        os.rename(self.path('in & out'), self.path('moved'))
        seen = self.read_with_paraview('moved/a <b>.pvd')
        with h5py.File(self.path('a.h5part'), 'r') as file:
            self.assertEqual(len(seen), 9)
            self.assertEqual(len(seen), len(file))
            for k, step in enumerate(seen):
                group = file[f'Step#{k}']
                self.assertEqual(step['time'], group.attrs['TimeValue'])
                self.assertEqual(step['own_time'], step['time'])
                position, velocity = in_box(group)
                numpy.testing.assert_array_equal(numpy.float32(step['points']), position)
                numpy.testing.assert_array_equal(numpy.float32(step['arrays']['velocity']), velocity)
                self.same_fields(step, group)
                self.assertEqual(step['units'], {'velocity': 'm/s', 'density': 'kg/m3', 'pressure': 'Pa', 'fluid': None, 'id': None})
        self.assertNotEqual(seen[0]['points'], seen[8]['points'])

    def test_series_in_the_world(self):
        self.make('--set', 'motion=[{spin: {axis: [1, 2, 3], rate: 3}}, {shake: {axis: [1, 0, 0], amplitude: 0.2, '
                           'frequency: 2}}]', '--time', '0.2')
        self.export('a.pvd', '--frame', 'world')
        seen = self.read_with_paraview('a.pvd')
        with h5py.File(self.path('a.h5part'), 'r') as file:
            self.assertEqual(len(seen), 5)
            for k, step in enumerate(seen):
                group = file[f'Step#{k}']
                position, velocity = in_world(group)
                numpy.testing.assert_allclose(step['points'], position, rtol=0, atol=3e-7)
                numpy.testing.assert_allclose(step['arrays']['velocity'], velocity, rtol=0, atol=3e-6)
                self.same_fields(step, group)
            self.assertGreater(numpy.abs(in_world(file['Step#4'])[1] - in_box(file['Step#4'])[1]).max(), 1)

    def test_one_and_none(self):
        self.make('--time', '0.1')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            file.move('Step#1', 'kept')
            group = file.create_group('Step#1')  # of no particles
            for name, value in file['kept'].attrs.items():
                group.attrs[name] = value
            for name, values in file['kept'].items():
                group.create_dataset(name, data=values[:0])
            file.move('kept', 'Step#3')  # and one more behind Step#2
        for name, index, more in (('a.vtp', 3, []), ('b.vtp', 1, ['--time', '0.04']), ('c.vtp', 0, ['--time', '0'])):
            self.export(name, *more)
            seen, = self.read_with_paraview(name)
            with h5py.File(self.path('a.h5part'), 'r') as file:
                group = file[f'Step#{index}']
                self.assertEqual((seen['time'], seen['own_time']), (group.attrs['TimeValue'],) * 2)
                self.assertEqual(len(seen['points']), len(group['x']))
                if index != 1:
                    numpy.testing.assert_array_equal(numpy.float32(seen['points']), in_box(group)[0])
                    self.same_fields(seen, group)

    def test_points_and_colours(self):
        self.make('--set', 'fluids[0].color=[1, 0.5, 0]', '--time', '0')
        self.export('a.ply')
        seen, = self.read_with_paraview('a.ply')
        with h5py.File(self.path('a.h5part'), 'r') as file:
            numpy.testing.assert_array_equal(numpy.float32(seen['points']), in_box(file['Step#0'])[0])
            first = file['Step#0']['fluid'][:] == 0
        colors = numpy.array(seen['arrays']['RGB'])
        self.assertTrue((colors[first] == (255, 128, 0)).all())
        self.assertEqual(len(numpy.unique(colors[~first], axis=0)), 1)


    def test_surfaces(self):
        """A .vtp of each snapshot, closed, with normals and fields; the last one has no fluid."""
        self.make('--time', '0.2', '--set', 'motion=[{spin: {axis: [1, 2, 3], rate: 3}}]')
        self.empty_the_last()
        self.assertRegex(self.export('a.pvd', '--surface', '--frame', 'world'),
                         'a.pvd: warning: 1 of 5 snapshots has no fluid at that level, and no surface')
        seen = self.read_with_paraview('a.pvd')
        self.assertEqual([len(step['triangles']) > 500 for step in seen], [True] * 4 + [False])
        self.assertEqual(seen[4]['points'], [])
        with h5py.File(self.path('a.h5part'), 'r') as file:
            for k, step in enumerate(seen[:4]):
                self.assertEqual(step['time'], file[f'Step#{k}'].attrs['TimeValue'])
                self.assertEqual(step['own_time'], step['time'])
                self.assertEqual(step['vertices'], 0)
                self.assertLess(abs(enclosed(step['points'], step['triangles']) / 0.5 - 1), 0.004)
                self.assertEqual(step['types'], {'velocity': 'float', 'density': 'float', 'pressure': 'float',
                                                 'fluid': 'int', 'Normals': 'float'})
                normals = numpy.array(step['arrays']['Normals'])
                numpy.testing.assert_allclose((normals ** 2).sum(1), 1, atol=1e-5)
                position = in_world(file[f'Step#{k}'])[0]  # vertices are about half a spacing around the particles
                points = numpy.array(step['points'])
                for side in (numpy.min, numpy.max):
                    numpy.testing.assert_allclose(side(points, 0), side(position, 0), atol=0.08)
                self.assertEqual(set(step['arrays']['fluid']), {0, 1})

    def test_surfaces_as_ply(self):
        self.make('--time', '0.1')
        self.export('a.ply.series', '--surface', '--cell', '1')
        self.assertEqual(sorted(os.listdir(self.path('a'))), [f'a-{k:04}.ply' for k in range(3)])
        seen = self.read_with_paraview('a.ply.series')
        self.assertEqual(len(seen), 3)
        for k, step in enumerate(seen):
            vertices, triangles = read_ply(self.read(f'a/a-{k:04}.ply'))
            numpy.testing.assert_array_equal(numpy.float32(step['points']),
                                             numpy.stack([vertices[axis] for axis in 'xyz'], 1))
            numpy.testing.assert_array_equal(step['triangles'], triangles)
            numpy.testing.assert_array_equal(numpy.float32(step['arrays']['Normals']),
                                             numpy.stack([vertices[axis] for axis in ('nx', 'ny', 'nz')], 1))
            with h5py.File(self.path('a.h5part'), 'r') as file:
                self.assertEqual(step['time'], file[f'Step#{k}'].attrs['TimeValue'])


    def test_trails(self):
        """Each point of each line, in the world's frame; a particle that is away for a step has two lines, and so has one that
        goes through a periodic side."""
        self.make('--time', '0.3', '--set', 'motion=[{spin: {axis: [1, 2, 3], rate: 3}}]')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            keep = file['Step#4']['id'][:] != 40
            for name, values in list(file['Step#4'].items()):
                rest = values[:][keep]
                del file['Step#4'][name]
                file['Step#4'].create_dataset(name, data=rest)
            for k in range(7):
                file[f'Step#{k}']['x'][numpy.flatnonzero(file[f'Step#{k}']['id'][:] == 60)[0]] = 0.45 if k < 3 else -0.45
            file.attrs['settings'] = numpy.bytes_(file.attrs['settings'].replace(b'\nbox.periodic = []', b'\nbox.periodic = [x]'))
        self.export('a.vtp', '--trails', '{length: 0.25}', '--frame', 'world')
        seen, = self.read_with_paraview('a.vtp')
        ways = traced(self.path('a.h5part'), lambda id, at: id % 20 == 0, range(1, 7), frame=in_world)
        (whole,) = ways[60]
        ways[60] = [whole[:2], whole[2:]]
        self.assert_trails(seen, ways, 'speed', 3e-7)
        self.assertEqual(len(seen['lines']), 27)
        self.assertEqual(seen['own_time'], max(seen['arrays']['time']))
        with h5py.File(self.path('a.h5part'), 'r') as file:
            self.assertEqual(seen['time'], file['Step#6'].attrs['TimeValue'])

    def test_chosen_trails(self):
        self.make('--time', '0.4')
        corner, other = numpy.array([-0.2, 0.1, -1]), numpy.array([0.2, 0.4, 1])
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            for k in range(9):
                file[f'Step#{k}']['born'] = (1e-3 * file[f'Step#{k}']['id'][:]).astype(numpy.float32)
            plane = float(numpy.median(file['Step#5']['x']))
            times = [file[f'Step#{k}'].attrs['TimeValue'] for k in range(9)]
        for text, chosen, steps, scalar in (
                ('{stride: 7, region_min: [-0.2, 0.1, -1], region_max: [0.2, 0.4, 1]}',
                 lambda id, at: id % 7 == 0 and ((corner <= at[0]) & (at[0] <= other)).all(), range(9), 'pressure'),
                ('{ids: [3, 17, 250], every: 0.09}', lambda id, at: id in (3, 17, 250), (0, 2, 4, 6, 8), 'velocity_y'),
                ('{ids: "3 17 250", every: 0.09}', lambda id, at: id in (3, 17, 250), (0, 2, 4, 6, 8), 'age'),
                (f'{{stride: 1, plane_point: [{plane}, 0, 0], plane_normal: [2, 0, 0]}}', None, range(9), 'density')):
            self.export('a.vtp', '--trails', text, '--scalar', scalar)
            seen, = self.read_with_paraview('a.vtp')
            ways = traced(self.path('a.h5part'), chosen or (lambda id, at: True), steps)
            if not chosen:  # from the last point before it
                side = {id: [numpy.float64(at[0]) < plane for _, at, _ in way] for id, (way,) in ways.items()}
                first = {id: next((k for k in range(1, 9) if on[k] != on[k - 1]), None) for id, on in side.items()}
                ways = {id: [way[first[id] - 1:]] for id, (way,) in ways.items() if first[id]}
                self.assertGreater(len(ways), 10)
            self.assert_trails(seen, ways, scalar, 0)
            self.assertLessEqual(set(seen['arrays']['time']), {times[k] for k in steps})

    def assert_trails(self, seen, ways, scalar, tolerance):
        fields = {'pressure': 'pressure', 'density': 'density', 'velocity_y': 'velocity_1'}
        self.assertEqual(sorted(seen['cells']['id']), sorted(id for id, lines in ways.items() for _ in lines))
        self.assertEqual(sorted(sum(seen['lines'], [])), list(range(len(seen['points']))))  # each point once
        places, times, values = (numpy.array(seen['points']), seen['arrays']['time'], seen['arrays'][scalar])
        left = {id: list(lines) for id, lines in ways.items()}
        for id, line in zip(seen['cells']['id'], seen['lines']):
            way = left[id].pop(0)
            self.assertEqual([times[k] for k in line], [time for time, _, _ in way])
            numpy.testing.assert_allclose(places[line], [at for _, at, _ in way], rtol=0, atol=tolerance)
            if scalar == 'speed':
                expected = [numpy.linalg.norm([row[f'velocity_{k}'] for k in range(3)]) for _, _, row in way]
                numpy.testing.assert_allclose([values[k] for k in line], expected, rtol=3e-7)
            elif scalar == 'age':
                expected = [max(float(time) - float(row['born']), 0) for time, _, row in way]
                numpy.testing.assert_allclose([values[k] for k in line], expected, rtol=0, atol=3e-8)
            else:
                self.assertEqual([numpy.float32(values[k]) for k in line], [row[fields[scalar]] for _, _, row in way])


def traced(path, chosen, steps, frame=in_box):
    """By id the lines, each a list of time, place and all numbers, of the ids that `chosen` takes by their places. A line ends
    where a step does not have the particle; lines of one point are none."""
    ways = {}
    with h5py.File(path, 'r') as file:
        for count, k in enumerate(steps):
            group = file[f'Step#{k}']
            columns = {name: values[:] for name, values in group.items()}
            for i, id in enumerate(columns['id'].tolist()):
                row = {name: values[i] for name, values in columns.items()}
                ways.setdefault(id, []).append((count, group.attrs['TimeValue'], i, row, k))
        places = {k: frame(file[f'Step#{k}'])[0] for k in steps}
        inside = {k: in_box(file[f'Step#{k}'])[0] for k in steps}
    found = {}
    for id, way in ways.items():
        if not chosen(id, [inside[k][i] for _, _, i, _, k in way]):
            continue
        lines = []
        for n, (count, time, i, row, k) in enumerate(way):
            if n == 0 or way[n - 1][0] + 1 != count:
                lines.append([])
            lines[-1].append((time, places[k][i], row))
        found[id] = [line for line in lines if len(line) > 1]
    return found


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
            for time in ('0', '0.4', '0.8'):
                for cell in ('0.4', '1'):
                    points, triangles, figures = self.mesh('--time', time, '--cell', cell)
                    self.assertLess(abs(enclosed(points, triangles) / volume - 1), 0.005)
                    self.assertLess(abs(figures['volume'] / volume - 1), 0.005)
                    self.assertTrue(0.4 < figures['level'] < 0.62, figures)
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


class Whole(ExportTest):
    def test_series(self):
        self.make()
        said = self.export('b.pvd', '--json', 'b.json')
        self.assertRegex(said, r'export: 100 % .*\nb\.pvd: 9 snapshots up to t = 0\.4 s, 500 particles, in the frame of '
                               r'the box\n')
        self.assert_whole_series('b', 9)
        out = json.loads(self.read('b.json'))
        wall = out.pop('wall_seconds')
        self.assertTrue(0 < wall < 10)
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
        for trial in range(3):
            process = self.start('run', 'scene.yaml', '-o', f'{trial}.h5part', '--time', '100000', '--every', '0.004',
                                 '--quiet')
            self.wait_for(lambda: os.path.exists(self.path(f'{trial}.h5part')), process)
            time.sleep(random.uniform(0, 0.3))
            process.kill()
            process.wait()
            self.export(f'{trial}.pvd', source=f'{trial}.h5part')
            self.assert_whole_series(str(trial), len(command.whole_steps(self.path(f'{trial}.h5part'))))

    def test_while_it_is_being_written(self):
        process = self.start('run', 'scene.yaml', '-o', 'a.h5part', '--time', '100000', '--every', '0.004', '--quiet')
        self.wait_for(lambda: os.path.exists(self.path('a.h5part')), process)
        for _ in range(5):
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
            self.refused('none.h5part', output, words='none.h5part: has no whole snapshot; make some with slosh run')

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
            self.refused('a.h5part', name, words='use .pvd, .vtp or .ply')
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
        self.refused('a.h5part', 'a.pvd', '--surface', '--cell', '0.05', '--quiet', words='particles are too far apart',
                     code=1)

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
            self.refused('a.h5part', name, '--trails', '{}', words="trails are one file, not '.*'; name an OUT.vtp")
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
            for size in (2000, 20000, 50000):  # LLVM's OpenMP, in the sanitized build, makes a file of 1 kB
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
        """500 particles take less than the index of 600 snapshots does."""
        self.make('--time', '0.4')
        self.stretch(600)
        self.full('b.pvd', 40000)
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


class Signals(ExportTest):
    STEPS = 3000

    def begin(self):
        process = self.start('export', 'a.h5part', '-o', 'b.pvd', '--quiet')
        self.wait_for(lambda: any(os.listdir(self.path(name)) for name in self.entries()
                                  if re.fullmatch(r'b\.\d+\.tmp', name)), process)
        return process

    def setUp(self):
        super().setUp()
        self.make()
        self.stretch(self.STEPS)

    def test_kill(self):
        for _ in range(4):
            process = self.begin()
            time.sleep(random.uniform(0, 0.2))
            process.kill()
            self.assertEqual(process.wait(), -signal.SIGKILL)
            self.assertFalse({'b', 'b.pvd'} & set(self.entries()))
            self.assertTrue(all(name.endswith('.tmp') for name in self.entries() if name != 'a.h5part'))

    def test_interrupt(self):
        process = self.begin()
        os.killpg(process.pid, signal.SIGINT)
        said = process.stderr.read()
        self.assertEqual(process.wait(timeout=60), 130, said)
        self.assertRegex(said, r'^stopped at t = [0-9.]+ s; b\.pvd is whole\n$')
        count = self.read('b.pvd').count(b'timestep')
        self.assertTrue(0 < count < self.STEPS)
        self.assert_whole_series('b', count)
        self.assertEqual(self.entries(), ['a.h5part', 'b', 'b.pvd'])


if __name__ == '__main__':
    command.main()
