#!/usr/bin/env python3
"""A study of a parameter: how far a dam's front runs with five viscosities, with a plot.

study.py OUT.png [PARTICLES]
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

import slosh

out = sys.argv[1]
particles = int(sys.argv[2]) if len(sys.argv) > 2 else 2000

times = numpy.linspace(0, 0.4, 21)
for viscosity in (1, 10, 100, 300, 1000):  # Pa s
    world = slosh.World("dam_break", {"particles": particles, "fluids[0].viscosity": viscosity}, tell=str)
    fronts = []
    for time in times:
        world.run(until=time)
        fronts.append(world.position[:, 0].max() + world.box_size[0] / 2)
    plt.plot(times, fronts, label=f"{viscosity:g} Pa s")
    print(f"{viscosity:5g} Pa s: {fronts[-1]:.3f} m after {world.time:.2f} s")
plt.xlabel("time, s")
plt.ylabel("front, m")
plt.legend(title="viscosity")
plt.tight_layout()
plt.savefig(out)
