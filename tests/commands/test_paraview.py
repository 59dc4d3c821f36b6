"""ParaView's reader finds in a snapshot file what is in it."""
import json
import shutil
import subprocess

import command
from command import CommandTest

# Runs in ParaView's Python, apart from h5py: each brings an HDF5 of its own.
READ = """
import json, sys
from paraview.simple import OpenDataFile
from paraview import servermanager
from vtk.util.numpy_support import vtk_to_numpy
reader = OpenDataFile(sys.argv[1])
steps = []
for time in reader.TimestepValues:
    reader.UpdatePipeline(time)
    data = servermanager.Fetch(reader)
    arrays = data.GetPointData()
    names = [arrays.GetArrayName(k) for k in range(arrays.GetNumberOfArrays())]
    steps.append({'time': time, 'points': vtk_to_numpy(data.GetPoints().GetData()).tolist(),
                  'arrays': {name: vtk_to_numpy(arrays.GetArray(name)).tolist() for name in names}})
with open(sys.argv[2], 'w') as file:
    json.dump(steps, file)
"""


class ParaView(CommandTest):
    def read_with_paraview(self, name):
        if not shutil.which('pvpython'):
            self.skipTest('pvpython is not there: install python3-paraview')
        self.write('read.py', READ)
        done = subprocess.run(['pvpython', '--no-mpi', 'read.py', name, 'read.json'], cwd=self.folder,
                              capture_output=True, text=True, check=False, timeout=200)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(self.read('read.json'))

    def test_same_numbers(self):
        import h5py
        import numpy
        code, said = self.slosh('run', 'scene.yaml', '-o', 'a.h5part', '--time', '0.4', '--every', '0.05',
                                '--quiet')
        self.assertEqual(code, 0, said)
        seen = self.read_with_paraview('a.h5part')
        with h5py.File(self.path('a.h5part'), 'r') as file:
            self.assertEqual(len(seen), 9)
            self.assertEqual(len(seen), len(file))
            for k, step in enumerate(seen):
                group = file[f'Step#{k}']
                self.assertEqual(step['time'], group.attrs['TimeValue'])
                self.assertEqual(len(step['points']), 500)
                numpy.testing.assert_array_equal(numpy.float32(step['points']),
                                                 numpy.stack([group[axis] for axis in 'xyz'], 1))
                numpy.testing.assert_array_equal(numpy.float32(step['arrays']['velocity']),
                                                 numpy.stack([group[f'velocity_{i}'] for i in range(3)], 1))
                for name in ('density', 'pressure', 'fluid', 'id'):
                    numpy.testing.assert_array_equal(step['arrays'][name], group[name])
        # Not the same frame nine times, and not zeros.
        self.assertNotEqual(seen[0]['points'], seen[8]['points'])
        self.assertEqual(sorted(seen[8]['arrays']['id']), list(range(500)))
        self.assertEqual(set(seen[8]['arrays']['fluid']), {0, 1})
        self.assertGreater(max(seen[8]['arrays']['density']), 900)


if __name__ == '__main__':
    command.main()
