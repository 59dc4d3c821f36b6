"""pvpython tools/paraview_picture.py IN.pvd OUT.png [TIME]: the blocks of an export as ParaView draws them: fluids coloured by
speed with a legend in its unit, solids grey. What it does step by step stands in docs/manual/paraview.md. Needs a display, as of
xvfb-run, where ParaView is built for X."""
import sys

from paraview import servermanager, simple

source, out = sys.argv[1:3]
reader = simple.OpenDataFile(source)
view = simple.GetActiveViewOrCreate('RenderView')
view.ViewSize = [640, 400]
view.OrientationAxesVisibility = 0
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.ViewTime = float(sys.argv[3]) if len(sys.argv) > 3 else reader.TimestepValues[-1]
reader.UpdatePipeline(view.ViewTime)
data = servermanager.Fetch(reader)
for k in range(data.GetNumberOfBlocks()):
    name = data.GetMetaData(k).Get(data.NAME())
    block = simple.ExtractBlock(Input=reader, Selectors=[f'/Root/{name}'])
    shown = simple.Show(block, view)
    shown.Representation = 'Surface'
    if name.startswith('solid'):
        shown.ColorArrayName = ['POINTS', '']
        shown.DiffuseColor = [0.7, 0.7, 0.7]
        shown.Opacity = 0.4
    else:
        simple.ColorBy(shown, ('POINTS', 'velocity', 'Magnitude'))
        colors = simple.GetColorTransferFunction('velocity')
        colors.ApplyPreset('Viridis (matplotlib)', True)
        legend = simple.GetScalarBar(colors, view)
        legend.Title, legend.ComponentTitle = 'speed (m/s)', ''
        legend.TitleColor = legend.LabelColor = [0, 0, 0]
        shown.SetScalarBarVisibility(view, True)
simple.Hide(reader, view)
camera = simple.GetActiveCamera()
camera.SetPosition(0.6, 1, 1.4)
camera.SetFocalPoint(0, 0.1, 0)
camera.SetViewUp(0, 1, 0)
simple.ResetCamera(view)
simple.Render(view)
simple.SaveScreenshot(out, view)
