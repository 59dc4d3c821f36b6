"""Draws a scalar of a two-dimensional snapshot as a Delaunay triangulation of its particles, linear in each triangle:
pvpython tools/triangulation.py IN.vtp OUT.png SCALAR LOW HIGH WIDTHxHEIGHT LEFT,RIGHT,BOTTOM,TOP (m, in the box's frame).
What no triangle covers is transparent. Colours are viridis, as slosh has them by default."""
import sys

import numpy
import vtk
from paraview import servermanager
from paraview.simple import GetColorTransferFunction, OpenDataFile
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy


def triangulated(path):
    reader = OpenDataFile(path)
    reader.UpdatePipeline()
    mesh = vtk.vtkDelaunay2D()
    mesh.SetInputData(servermanager.Fetch(reader))
    mesh.Update()
    return mesh.GetOutput()


def raster(mesh, pixels, corners):
    """Values at the centres of pixels."""
    left, right, bottom, top = corners
    step = ((right - left) / pixels[0], (top - bottom) / pixels[1])
    image = vtk.vtkImageData()
    image.SetDimensions(*pixels, 1)
    image.SetSpacing(*step, 1)
    image.SetOrigin(left + step[0] / 2, bottom + step[1] / 2, mesh.GetBounds()[4])
    probe = vtk.vtkProbeFilter()
    probe.SetInputData(image)
    probe.SetSourceData(mesh)
    probe.Update()
    return probe.GetOutput()


def write(image, scalar, ends, path):
    lut = GetColorTransferFunction(scalar)
    lut.ApplyPreset('Viridis (matplotlib)', True)
    lut.RescaleTransferFunction(*ends)
    colors = vtk_to_numpy(lut.GetClientSideObject().MapScalars(image.GetPointData().GetArray(scalar), 1, -1))
    there = vtk_to_numpy(image.GetPointData().GetArray('vtkValidPointMask'))
    rgba = numpy_to_vtk(numpy.column_stack((colors[:, :3], 255 * there)).astype(numpy.uint8), deep=True)
    picture = vtk.vtkImageData()
    picture.SetDimensions(image.GetDimensions())
    picture.GetPointData().SetScalars(rgba)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputData(picture)
    writer.Write()


def main():
    source, out, scalar, low, high, size, corners = sys.argv[1:]
    pixels = [int(n) for n in size.split('x')]
    image = raster(triangulated(source), pixels, [float(n) for n in corners.split(',')])
    write(image, scalar, (float(low), float(high)), out)


if __name__ == '__main__':
    main()
