"""What a scene gets that names nothing of its solver, beside theory."""
import math

import h5py
import numpy

import command
from command import CommandTest

WIDTH, DEPTH, AMPLITUDE, GRAVITY = 1.0, 0.5, 0.04, 9.81
FREQUENCY = 0.5923  # Hz: 0.7 of the tank's first resonance

TANK = f"""\
box: {{size: [{WIDTH}, 1, 0.25]}}
particles: {{spacing: 0.0625}}
fluids:
  - fill:
      - block: {{min: [-0.5, 0, -0.125], max: [0.5, {DEPTH}, 0.125]}}
motion:
  - shake: {{axis: [1, 0, 0], amplitude: {AMPLITUDE}, frequency: {FREQUENCY}}}
"""


def centre_by_potential_flow(times):
    """Centre of mass along x in a tank that starts to shake: linear waves, mode by mode (Faltinsen and Timokha, "Sloshing", 2009)."""
    step, omega = 1e-3, 2 * math.pi * FREQUENCY
    grid = numpy.arange(0, times[-1] + step, step)
    centre = numpy.zeros_like(grid)
    for n in range(1, 12, 2):
        k = n * math.pi / WIDTH
        stiffness, share = GRAVITY * k * math.tanh(k * DEPTH), 4 * WIDTH / (n * math.pi) ** 2
        height = speed = 0.0
        for i, time in enumerate(grid):
            centre[i] -= 2 * height / (k * k * DEPTH * WIDTH)
            tilt = AMPLITUDE * omega**2 * math.sin(omega * time) / GRAVITY
            speed += step * stiffness * (-tilt * share - height)
            height += step * speed
    return numpy.interp(times, grid, centre)


class Sloshing(CommandTest):
    def part_of_motion(self, scene, *more):
        """rms way of the centre of mass over that of potential flow."""
        self.write('tank.yaml', scene)
        code, said = self.slosh('run', 'tank.yaml', '-o', 'a.h5part', '--time', '3', '--every', '0.05', '--threads', '1', *more)
        self.assertEqual(code, 0, said)
        with h5py.File(self.path('a.h5part')) as file:
            steps = [file[f'Step#{k}'] for k in range(len(file))]
            times = numpy.array([float(step.attrs['TimeValue']) for step in steps])
            found = numpy.array([numpy.mean(step['x'][:].astype(float)) for step in steps])
        return numpy.std(found) / numpy.std(centre_by_potential_flow(times))

    def test_a_tank_off_its_resonance_in_space(self):
        """A lattice of dfsph resists shear at a support of 2.1, and hardly at the default of 2.22."""
        self.assertGreater(self.part_of_motion(TANK, '--method', 'dfsph'), 0.93)
        self.assertLess(self.part_of_motion(TANK, '--method', 'dfsph', '--set', 'particles.support=2.1'), 0.85)

    def test_a_tank_off_its_resonance_in_the_plane(self):
        flat = TANK.replace(', 1, 0.25]', ', 1]').replace('-0.5, 0, -0.125', '-0.5, 0').replace(f'0.5, {DEPTH}, 0.125', f'0.5, {DEPTH}')
        for method in ('wcsph', 'dfsph'):
            with self.subTest(method):
                self.assertGreater(self.part_of_motion(flat, '--method', method), 0.9)


command.main()
