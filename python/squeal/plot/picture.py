# SPDX-License-Identifier: BSD-2-Clause
"""Renders a mode by VTK, which needs a screen, such as that of xvfb, for its window."""
import matplotlib
import numpy as np
import vtkmodules.vtkInteractionStyle  # noqa: F401
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkFiltersGeneral import vtkWarpVector
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

SIZE = 1200, 800  # pixels
LARGEST = 0.05  # drawn displacement, in parts of the largest extent of the mesh


def write_picture(grid, title, path):
    """Writes a PNG of a grid with the arrays `displacement`, of largest amplitude 1, and
    `amplitude`, as made by Mode.grid()."""
    low, high = np.reshape(grid.GetBounds(), (3, 2)).T
    grid.GetPointData().SetActiveVectors("displacement")
    grid.GetPointData().SetActiveScalars("amplitude")
    warped = vtkWarpVector()
    warped.SetInputData(grid)
    warped.SetScaleFactor(LARGEST * (high - low).max())
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputConnection(warped.GetOutputPort())
    colours = _colours()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.SetLookupTable(colours)
    mapper.UseLookupTableScalarRangeOn()
    body = vtkActor()
    body.SetMapper(mapper)
    body.GetProperty().SetAmbient(0.3)
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(body)
    renderer.AddActor(_edges(grid))
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetTitle("amplitude")
    bar.SetMaximumNumberOfColors(256)
    bar.SetNumberOfLabels(3)
    bar.SetLabelFormat("%.1f")
    bar.SetPosition(0.88, 0.2)
    bar.SetWidth(0.09)
    bar.SetHeight(0.55)
    bar.UnconstrainedFontSizeOn()
    words = vtkTextActor()
    words.SetInput(title)
    words.SetPosition(24, SIZE[1] - 48)
    for style, size in (
        (words.GetTextProperty(), 26),
        (bar.GetTitleTextProperty(), 18),
        (bar.GetLabelTextProperty(), 18),
    ):
        style.SetColor(0.1, 0.1, 0.1)
        style.SetFontSize(size)
        style.ItalicOff()
        style.BoldOff()
        style.ShadowOff()
    renderer.AddActor2D(bar)
    renderer.AddActor2D(words)
    camera = renderer.GetActiveCamera()
    camera.SetViewUp(0, 0, 1)
    camera.SetPosition(*((low + high) / 2 + (high - low).max() * np.array([1.1, -1.35, 1.05])))
    camera.SetFocalPoint(*((low + high) / 2))
    if high[2] == low[2]:  # a plane mesh, seen from above
        camera.SetViewUp(0, 1, 0)
        camera.SetPosition(*((low + high) / 2 + np.array([0, 0, (high - low).max()])))
    renderer.ResetCamera()
    camera.Zoom(1.25)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


def _colours():
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    table.SetRange(0, 1)
    for index, colour in enumerate(matplotlib.colormaps["viridis"](np.linspace(0, 1, 256))):
        table.SetTableValue(index, *colour)
    table.Build()
    return table


def _edges(grid):
    """The edges of the mesh at rest."""
    outside = vtkDataSetSurfaceFilter()
    outside.SetInputData(grid)
    edges = vtkFeatureEdges()
    edges.SetInputConnection(outside.GetOutputPort())
    edges.SetFeatureAngle(30)
    edges.ColoringOff()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(edges.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.35, 0.38, 0.42)
    actor.GetProperty().SetLineWidth(1)
    return actor
