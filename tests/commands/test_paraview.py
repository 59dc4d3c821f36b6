"""ParaView finds every number in what slosh exports: particles, surfaces, solids, trails, slices."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest

import h5py
import numpy

import command
from test_export import ExportTest, enclosed, in_box, in_world, read_ply
from test_meshes import NAMES, SOLIDS, VOLUMES, block_at, in_frame, read_obj, welded

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
        if data.IsA('vtkImageData'):
            arrays = data.GetPointData()
            yield {'points': [data.GetPoint(k) for k in range(data.GetNumberOfPoints())],
                   'own_time': data.GetFieldData().GetArray('TimeValue').GetValue(0),
                   'arrays': {arrays.GetArrayName(k): vtk_to_numpy(arrays.GetArray(k)).tolist() for k in range(arrays.GetNumberOfArrays())}}
        elif data.IsA('vtkMultiBlockDataSet'):
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


class Reader:
    """ParaView's Python, one for all tests."""

    def __init__(self, folder):
        with open(f'{folder}/read.py', 'w') as script:
            script.write(READ)
        self.complaints = unittest.enterModuleContext(tempfile.TemporaryFile('w+'))
        self.process = subprocess.Popen(['pvpython', '--no-mpi', script.name], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=self.complaints, text=True)
        unittest.addModuleCleanup(self.process.communicate)


def setUpModule():
    global reader
    if not shutil.which('pvpython'):
        raise unittest.SkipTest('pvpython is not there: install python3-paraview')
    reader = Reader(unittest.enterModuleContext(tempfile.TemporaryDirectory(prefix='slosh-test-')))


class ParaViewTest(ExportTest):
    def read_with_paraview(self, name):
        reader.process.stdin.write(json.dumps([self.path(name), self.path('read.json')]) + '\n')
        reader.process.stdin.flush()
        answer = reader.process.stdout.readline()
        reader.complaints.seek(0)
        self.assertEqual((answer, reader.complaints.read()), ('read\n', ''))
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


class Solids(ParaViewTest):
    def test_beside_particles(self):
        """Blocks with names; those that move are where their motion has them, in either frame."""
        self.make('--time', '0.2', '--every', '0.1', '--set', SOLIDS)
        for frame in ('box', 'world'):
            self.export('a.pvd', '--solids', '--frame', frame)
            seen = self.read_with_paraview('a.pvd')
            self.assertEqual(len(seen), 3)
            self.assertEqual(len(os.listdir(self.path('a'))), 3 * 5)
            with h5py.File(self.path('a.h5part'), 'r') as file:
                for k, step in enumerate(seen):
                    self.assert_step(step, file[f'Step#{k}'], frame)

    def assert_step(self, step, group, frame):
        time = group.attrs['TimeValue']
        self.assertEqual((step['time'], step['blocks']), (time, ['particles', *NAMES]))
        numpy.testing.assert_array_equal(step['parts'][0]['arrays']['id'], group['id'])
        for part, volume in zip(step['parts'][1:], VOLUMES):
            self.assertEqual((part['own_time'], part['vertices'], sorted(part['arrays'])), (time, 0, ['Normals', 'velocity']))
            self.assertLess(abs(enclosed(*welded(part['points'], part['triangles'])) / volume - 1), 0.03)
        corner, velocity, centre = block_at(time)
        places, velocities = in_frame(group, corner, velocity, frame)
        block, sphere = step['parts'][2], numpy.array(step['parts'][3]['points'])
        found = numpy.unique(numpy.round(numpy.hstack([block['points'], block['arrays']['velocity']]), 4), axis=0)
        wanted = numpy.hstack([places, velocities])
        self.assertEqual(len(found), 8)
        for row in wanted:
            self.assertLess(numpy.abs(found - row).max(1).min(), 2e-4)
        middle, _ = in_frame(group, centre[None], numpy.zeros((1, 3)), frame)
        numpy.testing.assert_allclose(numpy.linalg.norm(sphere - middle, axis=1), 0.12, rtol=1e-5)

    def test_beside_a_surface(self):
        self.make('--time', '0', '--set', SOLIDS)
        self.export('a.pvd', '--solids', '--surface')
        step, = self.read_with_paraview('a.pvd')
        self.assertEqual(step['blocks'], ['fluid', *NAMES])
        self.assertLess(abs(enclosed(step['parts'][0]['points'], step['parts'][0]['triangles']) / 0.5 - 1), 0.004)
        self.export('a.pvd')  # an older folder with parts is known to be ours
        self.assert_whole_series('a', 1)

    def test_fluids(self):
        """Each closed, all of the fluid, with fields of their own; the border is where both say, and no staircase."""
        self.make('--time', '0')
        self.export('a.pvd', '--surface', '--fluids', '--json', 'a.json')
        step, = self.read_with_paraview('a.pvd')
        self.assertEqual(step['blocks'], ['water', 'oil'])
        self.assertEqual(sorted(os.listdir(self.path('a'))), ['a-0000-fluid0.vtp', 'a-0000-fluid1.vtp'])
        said = json.loads(self.read('a.json'))['surface']['fluids']
        borders = []
        for k, part in enumerate(step['parts']):
            points = numpy.array(part['points'])
            volume = enclosed(points, part['triangles'])
            self.assertLess(abs(volume / 0.25 - 1), 0.01)
            self.assertEqual(said[k]['name'], step['blocks'][k])
            self.assertLess(abs(said[k]['volume'] / volume - 1), 1e-4)
            self.assertEqual(set(part['arrays']['fluid']), {k})
            self.assertLess(abs(numpy.median(part['arrays']['density']) / (1000, 900)[k] - 1), 0.1)
            inside = (numpy.abs(points[:, 0]) < 0.1) & (points[:, 1] > 0.1) & (points[:, 1] < 0.4) & (abs(points[:, 2]) < 0.4)
            borders.append(points[inside])
            self.assertGreater(inside.sum(), 50)
            self.assertLess(numpy.abs(points[inside, 0]).max(), 0.003)
            normals = numpy.array(part['arrays']['Normals'])[inside]
            self.assertGreater(normals[:, 0].min() if k == 0 else -normals[:, 0].max(), 0.99)
        self.assertEqual(len(borders[0]), len(borders[1]))
        self.export('a.obj', '--surface', '--fluids')
        meshes = read_obj(self.read('a.obj').decode())
        self.assertEqual(list(meshes), ['water', 'oil'])
        for part, (points, _, triangles, _) in zip(step['parts'], meshes.values()):
            numpy.testing.assert_array_equal(numpy.float32(points), numpy.float32(part['points']))
            numpy.testing.assert_array_equal(triangles, part['triangles'])

    def test_fluids_without_particles(self):
        self.make('--time', '0')
        self.empty_the_last()
        self.assertIn('has no fluid at that level', self.export('a.pvd', '--surface', '--fluids'))
        step, = self.read_with_paraview('a.pvd')
        self.assertEqual([part['points'] for part in step['parts']], [[], []])



class Slice(ParaViewTest):
    def test_the_numbers_of_a_table_are_there(self):
        self.make('--set', 'solver.method=wcsph', '--time', '0.3')
        for name in ('a.csv', 'a.vti'):
            self.export(name, '--slice', '{point: [0, 0.3, 0.05], normal: [0.2, -0.1, 1]}', '--size', '31x23', '--scalar', 'speed',
                        '--time', '0.2')
        seen, = self.read_with_paraview('a.vti')
        table = numpy.genfromtxt(self.path('a.csv'), delimiter=',', skip_header=1)
        self.assertEqual(table.shape, (31 * 23, 4))
        numpy.testing.assert_allclose(seen['points'], table[:, :3], atol=1e-8)
        numpy.testing.assert_array_equal(numpy.float32(seen['arrays']['speed']), numpy.float32(table[:, 3]))
        with h5py.File(self.path('a.h5part')) as file:
            self.assertEqual(seen['own_time'], file['Step#4'].attrs['TimeValue'])
        self.assertTrue(((numpy.array(seen['arrays']['field']) > 0) == ~numpy.isnan(table[:, 3])).all())


if __name__ == '__main__':
    command.main()
