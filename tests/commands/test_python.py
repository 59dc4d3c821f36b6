"""`import slosh` in a built tree: the same bits as the program, views of columns, changes, files, errors; and the examples."""
import gc
import os
import re
import subprocess
import sys
import threading
import unittest

import command
from command import CommandTest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.path.dirname(os.path.abspath(sys.argv[1]))
sys.path.insert(0, f'{BUILD}/python')
os.environ.setdefault('OMP_WAIT_POLICY', 'passive')

try:
    import numpy
    import slosh
except OSError as why:  # under a sanitizer its library must come first
    if 'san' not in str(why):
        raise
    slosh = None

FEW = {'particles': 600}


def world_of(scene='dam_break', **settings):
    return slosh.World(scene, {**FEW, **settings}, tell=str)


@unittest.skipIf(slosh is None, 'the library has a sanitizer in it, and Python has none')
class Module(CommandTest):
    def test_the_same_bits_as_the_program(self):
        """A file of `slosh run` has the positions of a world in Python, and each goes on where the other ended."""
        world = world_of()
        world.run(0.1)
        done = subprocess.run([command.PROGRAM, 'run', 'dam_break', '-o', self.path('a.h5part'), '--particles', '600', '--time', '0.1',
                               '--every', '0.1', '--quiet'], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        last = slosh.open(self.path('a.h5part'))[-1]
        self.assertAlmostEqual(last.time, world.time, 12)
        mine, theirs = numpy.argsort(world['id']), numpy.argsort(last['id'])
        numpy.testing.assert_array_equal(world.position[mine], last.position[theirs])
        numpy.testing.assert_array_equal(world.velocity[mine], last.velocity[theirs])
        other = world_of()
        other.load(self.path('a.h5part'))
        self.assertEqual(other.hash, world.hash)

    def test_columns(self):
        world = world_of()
        x = world.position
        self.assertEqual((x.shape, x.dtype), ((world.count, 3), numpy.float32))
        self.assertLessEqual({'position', 'velocity', 'density', 'pressure', 'id'}, set(world.fields))
        self.assertTrue(numpy.shares_memory(x, world.position))
        with self.assertRaises(ValueError):
            x[0] = 0
        before = x.copy()
        world.step()
        self.assertFalse((world.position == before).all())
        self.assertEqual(sorted(world['id']), list(range(world.count)))
        self.assertEqual(world.unit('density'), 'kg/m3')
        speed = numpy.linalg.norm(world.velocity, axis=1)
        numpy.testing.assert_allclose(speed, world['speed'], rtol=1e-5, atol=1e-6)

    def test_a_view_keeps_its_world(self):
        x = world_of().position
        gc.collect()
        self.assertTrue(numpy.isfinite(x).all())

    def test_what_is_written(self):
        world = world_of()
        world.run(0.05)
        hash_before = world.hash
        world.write(world.position, world.velocity)
        self.assertEqual(world.hash, hash_before)
        velocity = numpy.zeros((world.count, 3))
        velocity[:, 0] = 0.25
        world.write(velocity=velocity)
        numpy.testing.assert_array_equal(world.velocity, velocity)

    def test_changes(self):
        world = world_of()
        world.set('gravity', [0, -3, 0])
        world.step()
        numpy.testing.assert_allclose(world.gravity, [0, -3, 0])
        self.assertEqual(world.settings['gravity'], [0, -3, 0])
        world.carry_box((0.2, 0, 0))
        world.step()
        numpy.testing.assert_allclose(world.box_position, [0.2, 0, 0], atol=1e-9)
        world.move_box((0, 0, 0), (0, 0, 0, 1))
        world.run(world.time + 0.2)
        self.assertLess(world.box_position[0], 0.15)

    def test_forces_and_probes(self):
        world = world_of('impact')
        self.assertEqual(world.force()[2], 0)
        world.step()
        forces = world.forces
        self.assertLess(forces['box'][1], 0)
        self.assertEqual(set(forces), {'box', *(f'solid_{k}' for k in range(len(forces) - 1))})
        self.assertTrue(world.probes)

    def test_files_and_surface(self):
        world = world_of()
        with world.record(self.path('run.h5part')) as file:
            for _ in range(3):
                file.add()
                world.step()
        run = slosh.open(self.path('run.h5part'))
        self.assertEqual(len(run), 3)
        numpy.testing.assert_allclose(numpy.diff(run.times), world.time / 3)
        self.assertEqual(run[-1].position.shape, (world.count, 3))
        self.assertIn('density', run.fields)
        vertices, triangles = world.surface()
        self.assertEqual(len(triangles), 2 * (len(vertices) - 2))  # Euler: closed
        self.assertLess(triangles.max(), len(vertices))

    def test_pictures(self):
        world = world_of()
        try:
            image = slosh.render(world, 'spheres', (96, 64))
        except slosh.Error as why:
            self.skipTest(str(why))
        self.assertEqual((image.shape, image.dtype), ((64, 96, 3), numpy.uint8))
        self.assertGreater(image.std(), 10)
        numpy.testing.assert_array_equal(image, slosh.Picture(world, 'spheres', (96, 64)).draw())

    def test_threads(self):
        hashes = {}

        def run(name, scene):
            world = world_of(scene)
            for _ in range(5):
                world.step()
            hashes[name] = world.hash

        run('alone', 'dam_break')
        threads = [threading.Thread(target=run, args=pair) for pair in [('a', 'dam_break'), ('b', 'dam_break_2d'), ('c', 'dam_break')]]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(hashes['a'], hashes['alone'])
        self.assertEqual(hashes['c'], hashes['alone'])
        self.assertNotEqual(hashes['b'], hashes['alone'])

    def test_errors(self):
        world = world_of()
        for wrong, words in [(lambda: slosh.World('dam_braek'), "did you mean 'dam_break'"),
                             (lambda: slosh.World('dam_break', {'fluids[0].viscosty': 1}), "did you mean 'viscosity'"),
                             (lambda: slosh.World('a.yaml', text='box: 3'), 'a.yaml:1'),
                             (lambda: world['colour'], 'no such column'), (lambda: world.set('box.size', [1, 1, 1]), 'box.size'),
                             (lambda: world.write(velocity=numpy.zeros((3, 3))), 'shape (3, 3)'),
                             (lambda: world.write(velocity=numpy.full((world.count, 3), numpy.nan)), 'finite'),
                             (lambda: world.save('a.txt'), '.h5part'), (lambda: slosh.open(self.path('no.h5part')), 'No such file'),
                             (lambda: world.move_box((1, 2)), '3 numbers'), (lambda: world.force(9), 'there is no solid 9'),
                             (lambda: world.run(float('nan')), 'finite')]:
            with self.assertRaises(slosh.Error) as raised:
                wrong()
            self.assertIn(words, str(raised.exception))
        with self.assertRaises(IndexError):
            with world.record(self.path('b.h5part')) as file:
                file.add()
            slosh.open(self.path('b.h5part'))[1]  # pylint: disable=expression-not-assigned

    def test_messages(self):
        with self.assertWarnsRegex(UserWarning, '--particles 600'):
            slosh.World('dam_break', FEW)
        told = []
        slosh.World('dam_break', FEW, tell=told.append)
        self.assertEqual(len(told), 1)


@unittest.skipIf(slosh is None, 'the library has a sanitizer in it, and Python has none')
class Examples(CommandTest):
    def run_example(self, name, *arguments):
        done = subprocess.run(['/usr/bin/python3', '-B', f'{ROOT}/library/examples/{name}', *arguments], cwd=self.folder, capture_output=True,
                              text=True, check=False, timeout=command.PATIENCE, env={**os.environ, 'PYTHONPATH': f'{BUILD}/python'})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_controller(self):
        free, damped = map(float, re.findall(r'(\S+) mm', self.run_example('controller.py', '300')))
        self.assertLess(damped, 0.6 * free)

    def test_study(self):
        fronts = [float(text) for text in re.findall(r': (\S+) m after', self.run_example('study.py', 'out.png', '300'))]
        self.assertEqual(len(fronts), 5)
        self.assertLess(fronts[-1], 0.8 * fronts[0])
        self.assertGreater(os.path.getsize(self.path('out.png')), 5000)

    def test_theory(self):
        off = [float(text) for text in re.findall(r'difference (\S+) %', self.run_example('theory.py', '16'))]
        self.assertEqual(len(off), 3)
        self.assertLess(max(off), 8)

    def test_film(self):
        try:
            slosh.render(world_of(), 'splat', (32, 32))
        except slosh.Error as why:
            self.skipTest(str(why))
        self.run_example('film.py', 'out.mp4', '0.1', '64', '36')
        self.assertGreater(os.path.getsize(self.path('out.mp4')), 500)


if __name__ == '__main__':
    command.main()
