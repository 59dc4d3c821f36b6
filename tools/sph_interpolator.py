"""Times ParaView's vtkSPHInterpolator on a plane across the middle of a snapshot's particles, with its cubic kernel:
pvpython --no-mpi tools/sph_interpolator.py IN.vtp SUPPORT WIDTHxHEIGHT (m; the support radius is twice its spatial step).
`slosh export --slice` is what it is held against in docs/labbook/views.md. Prints the filter's time alone."""
import sys
import time

from vtkmodules.vtkFiltersPoints import vtkSPHCubicKernel, vtkSPHInterpolator
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def plane(bounds, width, height):
    left, right, bottom, top, back, front = bounds
    middle = (back + front) / 2
    source = vtkPlaneSource()
    source.SetOrigin(left, bottom, middle)
    source.SetPoint1(right, bottom, middle)
    source.SetPoint2(left, top, middle)
    source.SetResolution(width - 1, height - 1)
    source.Update()
    return source.GetOutput()


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(sys.argv[1])
    reader.Update()
    particles = reader.GetOutput()
    kernel = vtkSPHCubicKernel()
    kernel.SetDimension(3)
    kernel.SetSpatialStep(float(sys.argv[2]) / 2)
    sums = vtkSPHInterpolator()
    sums.SetInputData(plane(particles.GetBounds(), *map(int, sys.argv[3].split('x'))))
    sums.SetSourceData(particles)
    sums.SetKernel(kernel)
    sums.SetDensityArrayName('density')
    start = time.perf_counter()
    sums.Update()
    print(f'{particles.GetNumberOfPoints()} particles, vtkSPHInterpolator: {time.perf_counter() - start:.2f} s')


main()
