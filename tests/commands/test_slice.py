"""slosh export --slice: the numbers are those of sums over all particles in double precision."""
import csv
import json
import os

import h5py
import numpy

import command
from command import CommandTest, limit_files

TILTED = '{point: [0, 0.3, 0.05], normal: [0.2, -0.1, 1]}'
WILD = ('--set', 'solver.method=wcsph', '--time', '0.3')

def cubic(q):
    return 8 / numpy.pi * numpy.where(q < 0.5, 1 - 6 * q * q * (1 - q), numpy.where(q < 1, 2 * (1 - q) ** 3, 0))


def cusp(q):
    return 15 / (2 * numpy.pi) * numpy.where(q < 1, (1 - q) ** 2, 0)


class Slice(CommandTest):
    def run_scene(self, *options):
        self.once('a.h5part', 'run', 'scene.yaml', '-o', 'a.h5part', '--every', '0.1', '--quiet', *options)

    def export(self, out, plane, *options):
        code, said = self.slosh('export', 'a.h5part', '-o', out, '--slice', plane, *options)
        self.assertEqual(code, 0, said)
        return said

    def rows(self, name):
        """(places, values) with NaN where nothing is."""
        with open(self.path(name), encoding='utf-8') as file:
            head, *rows = csv.reader(file)
        self.assertEqual(head, ['x', 'y', 'z', 'value'])
        return (numpy.array([row[:3] for row in rows], float),
                numpy.array([float(row[3]) if row[3] else numpy.nan for row in rows]))

    @staticmethod
    def volumes(file, group):
        """With a density of 0 and less a particle weighs nothing."""
        mass = numpy.asarray(file.attrs['fluid_densities'])[group['fluid'][:]] * file.attrs['spacing'] ** 3
        density = group['density'][:].astype(float)
        return numpy.where(density > 0, mass / numpy.where(density > 0, density, 1), 0)

    def spoil(self, every):
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            density = file['Step#3/density'][:]
            density[::every], density[1::every] = 0, -1000
            file['Step#3/density'][:] = density
            return (density <= 0).sum()

    def sums(self, places, shape, scalar, step='Step#3'):
        """Sums of V W s and of V W by all particles at each place."""
        with h5py.File(self.path('a.h5part')) as file:
            group, h = file[step], file.attrs['support_radius']
            at = numpy.stack([group[axis][:] for axis in 'xyz'], 1).astype(float)
            volume, value = self.volumes(file, group), scalar(group)
        weights = [volume * shape(numpy.linalg.norm(at - place, axis=1) / h) / h ** 3 for place in places]
        return numpy.array([[(w * value).sum(), w.sum()] for w in weights])

    def compare(self, name, shape, scalar, raw, step='Step#3'):
        places, values = self.rows(name)
        some = slice(None, None, 7)
        sums = self.sums(places[some], shape, scalar, step)
        there = sums[:, 1] > 0
        numpy.testing.assert_array_equal(there, ~numpy.isnan(values[some]))
        self.assertGreater(there.sum(), 50)
        self.assertGreater((~there).sum(), 50)
        wanted = sums[there, 0] if raw else sums[there, 0] / sums[there, 1]
        off = numpy.abs(values[some][there] - wanted).max() / numpy.abs(wanted).max()
        self.assertLess(off, 3e-6)  # measured: 3e-7; the bar is 1e-4

    def test_each_value_is_the_sum_over_all_particles(self):
        self.run_scene(*WILD)
        self.export('a.csv', TILTED, '--size', '61x47', '--kernel', 'cubic')
        self.compare('a.csv', cubic, lambda group: group['pressure'][:].astype(float), False)
        self.export('b.csv', '{point: [0.1, 0.5, 0], normal: [0.4, 1, 0]}', '--size', '40x40', '--kernel', 'cusp', '--raw',
                    '--scalar', 'velocity_y')
        self.compare('b.csv', cusp, lambda group: group['velocity_1'][:].astype(float), True)

    def test_densities_of_each_method_and_none(self):
        """V = mass / density, also where density is not in proportion to the number of particles (mueller); with a density
        of 0 and less a particle weighs nothing."""
        for method in ('mueller', 'wcsph'):
            self.run_scene('--set', f'solver.method={method}', '--time', '0.3')
            for spoilt in (False, True):
                if spoilt:
                    self.spoil(5)
                self.export('a.csv', TILTED, '--size', '61x47', '--kernel', 'cubic', '--raw', '--scalar', 'speed')
                self.compare('a.csv', cubic, lambda group: numpy.sqrt(sum(group[f'velocity_{k}'][:].astype(float) ** 2
                                                                          for k in range(3))), True)

    def test_fields_that_a_file_lacks(self):
        self.run_scene('--time', '0.1')
        with h5py.File(self.path('a.h5part'), 'r+') as file:
            for step in ('Step#0', 'Step#1'):
                for name in ('velocity_1', 'pressure', 'id'):
                    del file[step][name]
        self.export('a.csv', '{}', '--size', '24x16', '--scalar', 'density')
        for name in ('a.csv', 'a.pvd'):
            code, said = self.slosh('export', 'a.h5part', '-o', f'no-{name}', '--slice', '{}')
            self.assertEqual((code, 'has no pressure; take --scalar density, compression, fluid, boundary_mean, born, neighbours, age' in said),
                             (2, True), said)
        self.assertFalse([name for name in os.listdir(self.folder) if name.startswith('no-')])

    def derived(self, name, periodic=()):
        """A derived scalar of each particle by its definition: render/particles/particles.h. The box is 1 m wide."""
        def value(group):
            at, v = (numpy.stack([group[name][:] for name in names], 1).astype(float)
                     for names in ('xyz', ('velocity_0', 'velocity_1', 'velocity_2')))
            if name == 'kinetic_energy':
                return group['density'][:] * (v ** 2).sum(1) / 2
            with h5py.File(self.path('a.h5part')) as file:
                h, volume = file.attrs['support_radius'], self.volumes(file, group)
            d = at[None] - at[:, None]
            for axis in periodic:
                d[:, :, axis] -= numpy.round(d[:, :, axis])
            q = numpy.linalg.norm(d, axis=2) / h
            numpy.fill_diagonal(q, 1)
            if name == 'neighbours':
                return (q < 1).sum(1)
            w = 210 / numpy.pi / h ** 5 * volume * numpy.maximum(1 - q, 0) ** 3
            moment = numpy.einsum('ij,ija,ijb->iab', w, d, d)
            span = 1 / numpy.linalg.norm(numpy.linalg.inv(moment), axis=(1, 2))
            moment += 0.1 * numpy.clip(1 - span / 0.07, 0, 1)[:, None, None] * numpy.eye(3)
            rate = numpy.einsum('ij,ija,ijb->iab', w, v[None] - v[:, None], d) @ numpy.linalg.inv(moment)
            if name == 'divergence':
                return numpy.trace(rate, axis1=1, axis2=2)
            return numpy.linalg.norm([rate[:, (k + 2) % 3, (k + 1) % 3] - rate[:, (k + 1) % 3, (k + 2) % 3]
                                      for k in range(3)], axis=0)
        return value

    def test_derived_scalars_are_in_files_too(self):
        self.run_scene(*WILD)
        for name in ('vorticity', 'divergence', 'neighbours', 'kinetic_energy'):
            self.export('a.csv', TILTED, '--size', '61x47', '--kernel', 'cubic', '--scalar', name)
            self.compare('a.csv', cubic, self.derived(name), False)
        spoilt = self.spoil(40)
        said = self.export('a.csv', TILTED, '--size', '61x47', '--kernel', 'cubic', '--scalar', 'divergence')
        self.compare('a.csv', cubic, self.derived('divergence'), False)
        self.assertIn(f'{spoilt} particles of Step#3 have a density that is not more than 0; they weigh nothing in the slice',
                      said)
        self.assertNotIn('in the file', said)

    def test_neighbours_across_periodic_sides_count(self):
        self.run_scene('--time', '0.1', '--set', 'motion=[]', '--set', 'box.periodic=[x, z]')
        self.export('a.csv', TILTED, '--size', '61x47', '--kernel', 'cubic', '--scalar', 'neighbours')
        self.compare('a.csv', cubic, self.derived('neighbours', (0, 2)), False, 'Step#1')

    def test_the_plane_is_where_it_was_asked_for(self):
        self.run_scene(*WILD)
        self.export('a.csv', TILTED, '--size', '20x10')
        places, _ = self.rows('a.csv')
        off = (places - [0, 0.3, 0.05]) @ numpy.array([0.2, -0.1, 1])
        self.assertLess(numpy.abs(off).max(), 1e-8)
        self.assertEqual(len(places), 200)

    def test_a_series_has_each_snapshot_as_it_is_alone(self):
        self.run_scene('--time', '0.3')
        said = self.export('a.pvd', '{}', '--size', '24x16', '--json', 'a.json')
        self.assertIn('4 slices of 24 x 16 samples', said)
        self.assertEqual(sorted(os.listdir(self.path('a'))), [f'a-{k:04d}.vti' for k in range(4)])
        self.assertEqual(json.loads(self.read('a.json'))['snapshots'], 4)
        for k, time in ((0, '0'), (2, '0.2'), (3, '0.3')):
            self.export('one.vti', '{}', '--size', '24x16', '--time', time)
            self.assertEqual(self.read('one.vti'), self.read(f'a/a-{k:04d}.vti'))
        index = self.read('a.pvd').decode()
        self.assertEqual(index.count('file="a/a-000'), 4)
        code, said = self.slosh('export', 'a.h5part', '-o', 'a.pvd', '--slice', '{}', '--time', '0.1')
        self.assertEqual(code, 2)
        self.assertIn('--time makes no sense for all snapshots', said)

    def test_json_says_what_was_done(self):
        self.run_scene('--time', '0.1')
        self.export('a.vti', '{}', '--json', 'a.json', '--size', '16x8')
        said = json.loads(self.read('a.json'))['slice']
        self.assertEqual((said['samples'], said['scalar'], said['raw']), ([16, 8], 'pressure', False))
        self.assertIn(said['kernel'], ('spiky', 'poly6', 'cubic'))  # the method's own

    def test_a_plane_above_the_fluid_is_empty(self):
        self.run_scene('--time', '0.1')
        said = self.export('a.csv', '{point: [0, 0.97, 0], normal: [0, 1, 0]}', '--size', '8x8')
        self.assertIn('no particle is within a support radius of the plane', said)
        self.assertTrue(numpy.isnan(self.rows('a.csv')[1]).all())

    def test_what_is_wrong_is_said_and_nothing_is_left(self):
        self.run_scene('--time', '0.1')
        plane = ('--slice', '{}')
        for code, words, options in (
                (2, 'unknown key "pont"; point and normal are known', ('a.csv', '--slice', '{pont: [0, 0, 0]}')),
                (2, 'point must be', ('a.csv', '--slice', '{point: [0, 0]}')),
                (2, 'must be {point:', ('a.csv', '--slice', '[1]')),
                (2, 'a normal of length 0', ('a.csv', '--slice', '{normal: [0, 0, 0]}')),
                (2, 'did you mean pressure', ('a.csv', *plane, '--scalar', 'presure')),
                (2, 'did you mean cubic; take cubic, wendland_c2, quintic, poly6, spiky or cusp', ('a.csv', *plane, '--kernel', 'cubical')),
                (2, 'use .vti, .csv or .pvd', ('a.ply', *plane)),
                (2, 'makes no sense with --slice', ('a.csv', *plane, '--surface')),
                (2, 'add --slice', ('a.csv',)),
                (2, 'add --slice', ('a.ply', '--raw')),
                (1, 'the plane misses the box', ('a.csv', '--slice', '{point: [0, 1.5, 0], normal: [0, 1, 0]}'))):
            done, said = self.slosh('export', 'a.h5part', '-o', *options)
            self.assertEqual((done, words in said), (code, True), said)
        self.assertEqual(self.entries(), ['a.h5part'])

    def test_a_full_disk(self):
        self.run_scene('--time', '0.1')
        self.write('a.csv', 'older')
        code, said = self.slosh('export', 'a.h5part', '-o', 'a.csv', '--slice', '{}', before=limit_files(20000))
        self.assertEqual(code, 1)
        self.assertIn('a.csv: cannot be written', said)
        self.assertEqual(self.read('a.csv'), b'older')
        self.assertEqual(self.entries(), ['a.csv', 'a.h5part'])


if __name__ == '__main__':
    command.main()
