"""Meshes of slosh export for Blender and Houdini: surfaces, fluids and solids, read by a parser of its own."""
import json
import os
import re

import h5py
import numpy

import command
from test_export import ExportTest, enclosed, in_world, read_ply, rotated

# One of each kind around the fluid; the block turns about y, and the box of it all rocks.
SOLIDS = '''solids=[{bowl: {centre: [0, 0.8, -0.3], radius: 0.1, thickness: 0.1}},
{box: {centre: [0.3, 0.7, 0.3], size: [0.2, 0.1, 0.3], axis: [0, 0, 1], angle: 30}, motion: [{spin: {axis: [0, 1, 0], rate: 4}}]},
{sphere: {centre: [-0.3, 0.8, 0.3], radius: 0.12}, color: [1, 0, 0.2], motion: [{shake: {axis: [0, 1, 0], amplitude: 0.1, frequency: 2}}]},
{cylinder: {centre: [-0.35, 0.8, -0.3], radius: 0.08, height: 0.2, axis: [1, 1, 0]}}]'''
NAMES = ['solid0_bowl', 'solid1_box', 'solid2_sphere', 'solid3_cylinder']
VOLUMES = [2 / 3 * numpy.pi * (0.2 ** 3 - 0.1 ** 3), 0.006, 4 / 3 * numpy.pi * 0.12 ** 3, numpy.pi * 0.08 ** 2 * 0.2]


def welded(points, triangles):
    """The same with one vertex in each place; triangles that have lost a side are gone."""
    places, number = numpy.unique(numpy.round(points, 6), axis=0, return_inverse=True)  # ends of a seam differ by rounding
    triangles = number.reshape(-1)[numpy.array(triangles)]
    return places, triangles[(triangles != numpy.roll(triangles, 1, 1)).all(1)]


def block_at(time):
    """Corners of the block of SOLIDS in the box's frame and their velocities, and the sphere's centre."""
    corner = numpy.array([[x, y, z] for x in (-0.1, 0.1) for y in (-0.05, 0.05) for z in (-0.15, 0.15)])
    corner = rotated([0, 0, numpy.sin(numpy.pi / 12), numpy.cos(numpy.pi / 12)], corner)
    arm = rotated([0, numpy.sin(2 * time), 0, numpy.cos(2 * time)], corner)
    return arm + [0.3, 0.7, 0.3], numpy.cross([0, 4, 0], arm), numpy.array([-0.3, 0.8 + 0.1 * numpy.sin(4 * numpy.pi * time), 0.3])


def in_frame(group, position, velocity, frame):
    """From the box's frame, by the pose of the step."""
    return in_world({**dict(zip('xyz', position.T)), **{f'velocity_{k}': velocity[:, k] for k in range(3)}}, group.attrs) \
        if frame == 'world' else (position, velocity)


def read_obj(text):
    """{name: (points, normals, triangles, colours)} of what is between `o` and `o`; triangles count from the mesh's first."""
    meshes, before = {}, 0
    for name, part in zip(re.findall(r'^o (\S+)$', text, re.M), re.split(r'^o .*\n', text, flags=re.M)[1:]):
        group, part = part.split('\n', 1)
        assert group == f'g {name}'
        rows = {key: [line.split()[1:] for line in part.splitlines() if line.startswith(f'{key} ')] for key in ('v', 'vn', 'f')}
        assert sum(map(len, rows.values())) == len(part.splitlines()), part
        corners = [[corner.split('//') for corner in face] for face in rows['f']]
        assert all(place == normal for face in corners for place, normal in face)
        points = numpy.array(rows['v'], float).reshape(-1, len(rows['v'][0]) if rows['v'] else 6)
        triangles = numpy.array([[int(place) for place, _ in face] for face in corners]).reshape(-1, 3) - 1 - before
        assert name not in meshes and (triangles >= 0).all() and (triangles < len(points)).all()
        meshes[name] = points[:, :3], numpy.array(rows['vn'], float).reshape(-1, 3), triangles, points[:, 3:]
        before += len(points)
    return meshes


class Obj(ExportTest):
    def test_the_same_mesh_as_a_ply(self):
        """Each number to the bit, closed, with the fluid's volume, in its colours, and turned outwards."""
        self.make('--time', '0.1', '--set', 'fluids[0].color=[1, 0.5, 0]')
        self.export('a.obj', '--surface', '--frame', 'world')
        self.export('a.ply', '--surface', '--frame', 'world')
        text = self.read('a.obj').decode()
        self.assertRegex(text, r'\A# slosh, time 0\.1\d* s, frame of the world; places in m, y up\no fluid\ng fluid\nv ')
        (points, normals, triangles, colors), = read_obj(text).values()
        vertices, faces = read_ply(self.read('a.ply'))
        numpy.testing.assert_array_equal(numpy.float32(points), numpy.stack([vertices[axis] for axis in 'xyz'], 1))
        numpy.testing.assert_array_equal(triangles, faces)
        numpy.testing.assert_allclose(normals, numpy.stack([vertices[axis] for axis in ('nx', 'ny', 'nz')], 1), atol=1e-5)
        numpy.testing.assert_array_equal(numpy.rint(255 * colors), numpy.stack([vertices[c] for c in ('red', 'green', 'blue')], 1))
        self.assertLess(abs(enclosed(numpy.float32(points), triangles) / 0.5 - 1), 0.004)  # and more than 0: outwards

    def test_a_series(self):
        self.make('--time', '0.1', '--every', '0.05')
        self.empty_the_last()
        self.export('a.obj.series', '--surface', '--cell', '1', '--color-by', 'speed')
        index = json.loads(self.read('a.obj.series'))
        self.assertEqual([file['name'] for file in index['files']], [f'a/a-{k:04}.obj' for k in range(3)])
        self.assertEqual(sorted(os.listdir(self.path('a'))), [f'a-{k:04}.obj' for k in range(3)])
        with h5py.File(self.path('a.h5part'), 'r') as file:
            self.assertEqual([file['time'] for file in index['files']], [file[f'Step#{k}'].attrs['TimeValue'] for k in range(3)])
        for k in range(3):
            text = self.read(f'a/a-{k:04}.obj').decode()
            self.assertIn('\n# colours: mako, speed from 0 to ', text)
            (points, _, triangles, _), = read_obj(text).values()
            if k < 2:
                self.assertLess(abs(enclosed(numpy.float32(points), triangles) / 0.5 - 1), 0.01)
        self.assertEqual(len(points), 0)

    def test_solids(self):
        """Objects of one file beside the fluid, each with its volume, in its colour."""
        self.make('--time', '0.1', '--set', SOLIDS)
        self.export('a.obj', '--surface', '--solids')
        meshes = read_obj(self.read('a.obj').decode())
        self.assertEqual(list(meshes), ['fluid', *NAMES])
        for name, volume in zip(NAMES, VOLUMES):
            points, normals, triangles, colors = meshes[name]
            self.assertLess(abs(enclosed(*welded(points, triangles)) / volume - 1), 0.03, name)
            numpy.testing.assert_allclose((normals ** 2).sum(1), 1, atol=1e-4)
            self.assertEqual(len(numpy.unique(colors, axis=0)), 1)
        numpy.testing.assert_allclose(meshes['solid2_sphere'][3][0], [1, 0, 0.2], atol=0.003)
        self.export('a.obj', '--surface', '--solids', '--json', 'a.json')
        self.assertEqual(json.loads(self.read('a.json'))['solids'], 4)


class Bad(ExportTest):
    def refused(self, output, *more, words, code=2):
        before = self.entries()
        self.assertRegex(self.export(output, *more, code=code), words)
        self.assertEqual(self.entries(), before)

    def test_solids(self):
        self.make('--time', '0')
        self.refused('a.pvd', '--solids', words='a.h5part: has no solids; export it without --solids')
        for name in ('a.vtp', 'a.ply', 'a.ply.series'):
            self.refused(name, '--solids', words=f'{name} has room for one mesh; for --solids name a FILE.pvd')
        self.refused('a.obj', '--solids', words='add --surface')
        self.refused('a.pvd', '--fluids', words='--fluids is of a surface; add --surface')
        self.refused('a.ply', '--fluids', '--surface', words='a.ply has room for one mesh; for --fluids name a FILE.pvd')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            del file.attrs['settings']
        self.refused('a.pvd', '--solids', words='(?s)says nothing of its settings.*has no solids')

    def test_a_full_disk(self):
        self.make('--time', '0', '--set', SOLIDS)
        for size in (2000, 20000, 40000):  # libomp's own shared file has 1024
            for name in ('b.pvd', 'b.obj', 'b.obj.series'):
                code, said = self.slosh('export', 'a.h5part', '-o', name, '--surface', '--solids', '--quiet',
                                        before=command.limit_files(size))
                self.assertEqual(code, 1, said)
                self.assertIn(f'{name}: cannot be written: File too large', said)
        self.assertEqual(self.entries(), ['a.h5part'])


if __name__ == '__main__':
    command.main()
