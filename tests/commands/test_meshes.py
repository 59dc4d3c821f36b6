"""Meshes of slosh export for Blender, Houdini and ParaView: surfaces, fluids and solids, read by a parser of its own."""
import json
import os
import re

import h5py
import numpy

import command
from test_export import ExportTest, enclosed, read_ply


def read_obj(text):
    """{name: (points, normals, triangles, colours)} of what is between `o` and `o`; triangles count from the mesh's first."""
    meshes, before = {}, 0
    for name, part in zip(re.findall(r'^o (\S+)$', text, re.M), re.split(r'^o .*\n', text, flags=re.M)[1:]):
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
        self.assertRegex(text, r'\A# slosh, time 0\.1\d* s, frame of the world; places in m, y up\no fluid\nv ')
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
            self.assertIn('\n# colours: viridis, speed from 0 to ', text)
            (points, _, triangles, _), = read_obj(text).values()
            if k < 2:
                self.assertLess(abs(enclosed(numpy.float32(points), triangles) / 0.5 - 1), 0.01)
        self.assertEqual(len(points), 0)


if __name__ == '__main__':
    command.main()
