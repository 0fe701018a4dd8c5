# SPDX-License-Identifier: BSD-3-Clause
"""Tests the plugin in ParaView: images to features, maps and surface, Phi in ParaView's own filters, a picture.

    pvpython test_plugin.py Freespace.so PICTURE.png
"""
import math
import os
import re
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

from paraview import servermanager
import paraview.simple as pv
from paraview.modules.vtkRemotingClientServerStream import vtkClientServerInterpreterInitializer
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkMassProperties

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, '..', 'Examples', 'Data', 'blocks', 'scene.json')
GROUPS = ('sources', 'filters', 'implicit_functions')


def expect(is_so, what):
    print(('ok: ' if is_so else 'WRONG: ') + what, flush=True)
    if not is_so:
        sys.exit(1)


def proxies_of_xml():
    """(group, element) of each proxy that the plugin adds."""
    for name in ('Readers.xml', 'Filters.xml', 'Phi.xml'):
        for group in ElementTree.parse(os.path.join(HERE, 'Plugin', name)).getroot():
            for proxy in group:
                yield group.get('name'), proxy


def new_object(name):
    """An object that no proxy has set. ParaView wraps a plugin's classes in its own language only, which can print."""
    return vtkClientServerInterpreterInitializer.GetGlobalInterpreter().NewInstance(name)


def settings_of(text):
    """What PrintSelf tells, name to number."""
    return {name: float(value) for name, value in re.findall(r'^\s*(\w+): ([-+.\de]+)$', text, re.M)}


def check_defaults():
    """The defaults of the settings are those of the classes, which a new object prints."""
    count = 0
    for group, proxy in proxies_of_xml():
        plain = new_object(proxy.get('class'))
        told = settings_of(str(plain))
        for setting in proxy:
            if setting.tag in ('IntVectorProperty', 'DoubleVectorProperty') and setting.get('number_of_elements') == '1':
                name, default = setting.get('name'), float(setting.get('default_values'))
                expect(told.get(name) == default, f'{proxy.get("name")}.{name} is {default:g} by default')
                count += 1
    expect(count > 40, f'{count} defaults')


def edges_of(surface, boundary, non_manifold):
    edges = vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.SetBoundaryEdges(boundary)
    edges.SetNonManifoldEdges(non_manifold)
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


def bounds_of(source):
    return source.GetDataInformation().GetBounds()


def is_within(inner, outer, margin):
    return all(outer[i] - margin <= inner[i] and inner[i + 1] <= outer[i + 1] + margin for i in (0, 2, 4))


def make_maps():
    """Images to features to disparity maps, coarsely."""
    stereo = pv.OpenDataFile(SCENE)
    expect(stereo.GetXMLName() == 'FreespaceEdgeStereo', 'ParaView opens a scene.json with the reader of the plugin')
    stereo.EveryImage = 'Never'
    stereo.Patches = 0
    stereo.UpdatePipeline()
    views = servermanager.Fetch(stereo)
    count = sum(views.GetBlock(i).GetNumberOfPoints() for i in range(views.GetNumberOfBlocks()))
    expect(views.GetNumberOfBlocks() == 6 and count > 50000, f'{views.GetNumberOfBlocks()} views, {count} features')
    maps = pv.FreespaceDisparityMaps(Input=stereo)
    maps.FeatureSpacing = 6
    maps.UpdatePipeline()
    blocks = servermanager.Fetch(maps)
    count = sum(blocks.GetBlock(i).GetNumberOfPolys() for i in range(blocks.GetNumberOfBlocks()))
    expect(blocks.GetNumberOfBlocks() == 6 and count > 10000, f'{count} triangles of {blocks.GetNumberOfBlocks()} maps')
    return maps


def make_surface(maps):
    surface = pv.FreespaceSurface(Input=maps)
    surface.Cells = 96
    surface.UpdatePipeline()
    mesh = servermanager.Fetch(surface)
    expect(mesh.GetNumberOfPolys() > 20000, f'{mesh.GetNumberOfPolys()} triangles of the surface')
    expect(edges_of(mesh, True, False) == 0, 'it has no open edge')
    expect(edges_of(mesh, False, True) == 0, 'it has no edge of more than two triangles')
    bounds = mesh.GetBounds()
    expect(is_within(bounds, bounds_of(maps), 0.02), 'its bounds are %.3f %.3f %.3f %.3f %.3f %.3f, those of the features' % bounds)
    expect(min(bounds[1] - bounds[0], bounds[3] - bounds[2]) > 0.4, 'it reaches over the board of the scene')
    volume = vtkMassProperties()
    volume.SetInputData(mesh)
    volume.Update()
    expect(0.002 < volume.GetVolume() < 0.01, f'its volume is {volume.GetVolume():.5f}')
    return surface


def grid_about(surface):
    """A grid of points over the bounds of a surface."""
    bounds = bounds_of(surface)
    grid = pv.Transform(Input=pv.Wavelet(WholeExtent=[-25, 25, -25, 25, -25, 25]))
    grid.Transform.Scale = [(bounds[i + 1] - bounds[i]) / 48 for i in (0, 2, 4)]
    grid.Transform.Translate = [(bounds[i] + bounds[i + 1]) / 2 for i in (0, 2, 4)]
    return grid


def values_of(source, name='Phi'):
    array = servermanager.Fetch(source).GetPointData().GetArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfTuples())]


def check_phi(maps, surface):
    """Phi as an array, and as the function of Clip and Slice, which agree."""
    sample = pv.FreespaceSample(Input=grid_about(surface), Maps=maps)
    values = values_of(sample)
    matter = sum(value <= 0 for value in values) / len(values)
    expect(0.02 < matter < 0.5, f'{100 * matter:.1f} % of {len(values)} points are matter')
    phi = servermanager.implicit_functions.FreespaceUnion()
    phi.Maps = maps
    clip = pv.Clip(Input=sample)
    clip.ClipType = phi
    clip.Invert = 1
    clip.UpdatePipeline()
    by_scalar = pv.Clip(Input=sample, ClipType='Scalar', Scalars=['POINTS', 'Phi'], Invert=1)
    by_scalar.UpdatePipeline()
    by_scalar.Value = 0 # now: ParaView takes a value of the array's range at first
    by_scalar.UpdatePipeline()
    cells = [source.GetDataInformation().GetNumberOfCells() for source in (clip, by_scalar)]
    expect(cells[0] > 1000 and cells[0] == cells[1],
        f'Clip by Phi has {cells[0]} cells, and {cells[1]} by the array')
    expect(max(values_of(clip)) < 1e-9, 'there is no free space in them')
    cut = pv.Slice(Input=sample)
    cut.SliceType = phi
    cut.UpdatePipeline()
    values = values_of(cut)
    expect(len(values) > 1000 and max(map(abs, values)) < 1e-3, f'Slice by Phi has {len(values)} points on the boundary')
    return clip


def check_change(maps, clip):
    """A setting upstream reaches the function, too."""
    before = clip.GetDataInformation().GetNumberOfCells()
    maps.FeatureSpacing = 12
    clip.UpdatePipeline()
    after = clip.GetDataInformation().GetNumberOfCells()
    expect(after != before, f'Clip by Phi of other maps has {after} cells')


def check_sparse_model(folder):
    """A model of three cameras in a row that see a wavy surface."""
    points = [((i % 10 - 4.5) / 5, (i // 10 - 4.5) / 5, 4 + 0.3 * math.sin(i)) for i in range(100)]
    lines = {'cameras': ['1 PINHOLE 640 480 500 500 320 240'], 'images': [], 'points3D': []}
    for image in range(3):
        centre = image - 1
        lines['images'].append(f'{image + 1} 1 0 0 0 {-centre} 0 0 1 {image + 1}.jpg')
        lines['images'].append(' '.join(f'{500 * (x - centre) / z + 320:.9f} {500 * y / z + 240:.9f} {i + 1}'
            for i, (x, y, z) in enumerate(points)))
    for i, (x, y, z) in enumerate(points):
        lines['points3D'].append(f'{i + 1} {x:.9f} {y:.9f} {z:.9f} 90 90 90 0 1 {i} 2 {i} 3 {i}')
    for name, text in lines.items():
        with open(os.path.join(folder, name + '.txt'), 'w', encoding='utf-8') as file:
            file.write('\n'.join(text) + '\n')
    model = pv.FreespaceSparseModel(FileName=os.path.join(folder, 'cameras.txt'))
    model.UpdatePipeline()
    views = servermanager.Fetch(model)
    counts = [views.GetBlock(i).GetNumberOfPoints() for i in range(views.GetNumberOfBlocks())]
    expect(counts == [100, 100, 100], f'the views of a sparse model have {counts} features')


def check_files(maps, folder):
    """What the plugin makes passes through ParaView's own files."""
    name = os.path.join(folder, 'maps.vtm')
    pv.SaveData(name, proxy=maps, DataMode='Binary') # libexpat's parser refuses appended bytes of this VTK
    again = pv.OpenDataFile(name)
    surface = pv.FreespaceSurface(Input=again)
    surface.Cells = 32
    surface.UpdatePipeline()
    expect(edges_of(servermanager.Fetch(surface), True, True) == 0, 'maps from a file give a closed surface, too')


def bake(surface):
    texture = pv.FreespaceTexture(Input=surface, Images=pv.FreespaceImages(FileName=SCENE))
    texture.TexelSize = 0.001
    texture.UpdatePipeline()
    extent = texture.SMProxy.GetDataInformation(1).GetExtent() # Fetch has the first output only
    width, height = extent[1] - extent[0] + 1, extent[3] - extent[2] + 1
    expect(width * height > 100000, f'the texture has {width} x {height} texels')
    colours = servermanager.Fetch(texture).GetPointData().GetArray('RGB')
    reds = colours.GetValueRange(0)
    expect(colours.GetNumberOfComponents() == 3 and reds[0] < 60 and reds[1] > 200, f'the red of the points is in {reds}')
    return texture


def take_picture(surface, texture, clip, name):
    """Side by side: the surface by its kinds of triangles, with the colours of the images, and as cells in matter."""
    view = pv.CreateView('RenderView')
    view.ViewSize = [1200, 480]
    view.OrientationAxesVisibility = 0
    shown = ((surface, ('CELLS', 'Kind'), -0.6), (texture, ('POINTS', 'RGB'), 0), (clip, ('POINTS', 'Phi'), 0.6))
    for source, array, place in shown:
        moved = pv.Transform(Input=source)
        moved.Transform.Translate = [place, 0, 0]
        display = pv.Show(moved, view)
        pv.ColorBy(display, array)
        if array[1] == 'RGB':
            display.MapScalars = 0
    pv.Render(view) # the first one chooses a camera of its own
    view.CameraPosition = [0, -2.3, 1.9]
    view.CameraFocalPoint = [0, 0, 0.03]
    view.CameraViewUp = [0, 0, 1]
    view.CameraViewAngle = 20
    pv.SaveScreenshot(name, view)
    expect(os.path.getsize(name) > 20000, f'the picture is {name}')


def main():
    plugin, picture = sys.argv[1:]
    pv.LoadPlugin(os.path.abspath(plugin), remote=False)
    for group, proxy in proxies_of_xml():
        known = servermanager.ProxyManager().NewProxy(group, proxy.get('name'))
        expect(known is not None, f'ParaView knows {proxy.get("name")} of the {group}')
    check_defaults()
    maps = make_maps()
    surface = make_surface(maps)
    clip = check_phi(maps, surface)
    with tempfile.TemporaryDirectory() as folder:
        check_sparse_model(folder)
        check_files(maps, folder)
    take_picture(surface, bake(surface), clip, picture)
    check_change(maps, clip)


main()
