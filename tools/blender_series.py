"""Imports what slosh export wrote into Blender (3.3 or later): a .obj or .ply, or all files of a .obj.series or .ply.series.

    blender -P tools/blender_series.py -- oils.obj.series                      opens the window with all files
    blender -b -P tools/blender_series.py -- oils.obj.series -o oils.blend     saves a file of Blender
    blender -b -P tools/blender_series.py -- oils.obj.series -o oils.png --time 0.4 --size 640x360

Each file is shown from its time to that of the next one, at --fps frames a second. Meshes have the colours of the file;
points of a .ply become spheres of the radius --radius (m). A .png is drawn by Cycles, with a camera and a lamp added.
"""
import argparse
import json
import math
import os
import sys

import bpy
import numpy
from mathutils import Vector


def arguments():
    parser = argparse.ArgumentParser(prog='blender -P blender_series.py --', description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('input', help='.obj, .ply, .obj.series or .ply.series')
    parser.add_argument('-o', '--output', help='.blend or .png')
    parser.add_argument('--fps', type=float, default=25)
    parser.add_argument('--time', type=float, help='of the picture, s; without it the last file')
    parser.add_argument('--size', default='640x360')
    parser.add_argument('--radius', type=float, default=0.005)
    parser.add_argument('--samples', type=int, default=32)
    return parser.parse_args(sys.argv[sys.argv.index('--') + 1:] if '--' in sys.argv else [])


def files_of(path):
    """(file, time) of each snapshot."""
    if not path.endswith('.series'):
        return [(path, 0.0)]
    with open(path, encoding='utf-8') as file:
        return [(os.path.join(os.path.dirname(path), entry['name']), entry['time']) for entry in json.load(file)['files']]


def color_points(path, mesh):
    """Colours of points as in the file, which Blender's importer leaves out."""
    with open(path, 'rb') as file:
        head, rows = file.read().split(b'end_header\n', 1)
    kinds = {'float': 'f4', 'int': 'i4', 'uint': 'u4', 'uchar': 'u1'}
    properties = [line.split() for line in head.decode().splitlines() if line.startswith('property ')]
    if b'binary_little_endian' not in head or not any(name == 'red' for _, _, name in properties):
        return
    table = numpy.frombuffer(rows, [(name, '<' + kinds[kind]) for _, kind, name in properties], len(mesh.vertices))
    colors = numpy.stack([table[name] for name in ('red', 'green', 'blue')], 1) / 255
    linear = numpy.where(colors < 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)  # IEC 61966-2-1
    linear = numpy.column_stack([linear, numpy.ones(len(linear))]).astype('f4')
    mesh.attributes.new('Color', 'FLOAT_COLOR', 'POINT').data.foreach_set('color', linear.ravel())


def load(path):
    """The objects of a file; y is up in the file, z in Blender."""
    bpy.ops.object.select_all(action='DESELECT')
    if path.endswith('.obj'):
        bpy.ops.wm.obj_import(filepath=path, forward_axis='NEGATIVE_Z', up_axis='Y')
    else:
        bpy.ops.import_mesh.ply(filepath=path)
        for thing in bpy.context.selected_objects:
            thing.rotation_euler[0] = math.pi / 2
            if not thing.data.polygons:
                color_points(path, thing.data)
    return list(bpy.context.selected_objects)


def material_of(mesh):
    """Glossy, in the colours of the file."""
    name = mesh.color_attributes[0].name if mesh.color_attributes else ''
    material = bpy.data.materials.get('slosh ' + name)
    if not material:
        material = bpy.data.materials.new('slosh ' + name)
        material.use_nodes = True
        shader = material.node_tree.nodes['Principled BSDF']
        shader.inputs['Roughness'].default_value = 0.25
        color = material.node_tree.nodes.new('ShaderNodeAttribute')
        color.attribute_name = name
        material.node_tree.links.new(color.outputs['Color'], shader.inputs['Base Color'])
    return material


def show_as_points(thing, radius, material):
    """Spheres at the vertices: Geometry Nodes."""
    modifier = thing.modifiers.new('points', 'NODES')
    if not modifier.node_group:
        modifier.node_group = bpy.data.node_groups.new('points', 'GeometryNodeTree')
        modifier.node_group.inputs.new('NodeSocketGeometry', 'Geometry')
        modifier.node_group.outputs.new('NodeSocketGeometry', 'Geometry')
    nodes, links = modifier.node_group.nodes, modifier.node_group.links
    nodes.clear()
    chain = [nodes.new(kind) for kind in ('NodeGroupInput', 'GeometryNodeMeshToPoints', 'GeometryNodeSetMaterial', 'NodeGroupOutput')]
    chain[1].inputs['Radius'].default_value = radius
    chain[2].inputs['Material'].default_value = material
    for before, after in zip(chain, chain[1:]):
        links.new(before.outputs[0], after.inputs[0])


def show_at(thing, begin, end):
    """Only from one frame to before another."""
    for at, hidden in ((begin - 1, True), (begin, False), (end, True)):
        if at is not None:
            thing.hide_render = thing.hide_viewport = hidden
            thing.keyframe_insert('hide_render', frame=at)
            thing.keyframe_insert('hide_viewport', frame=at)


def add_camera(things):
    bpy.context.view_layer.update()
    places = [vertex.co for thing in things for vertex in thing.data.vertices]
    turned = things[0].matrix_world
    low, high = (Vector([pick(place[k] for place in places) for k in range(3)]) for pick in (min, max))
    low, high = turned @ low, turned @ high
    low, high = (Vector([pick(low[k], high[k]) for k in range(3)]) for pick in (min, max))
    size, middle = (high - low).length, (low + high) / 2
    for name, data, place in (('camera', bpy.data.cameras.new('camera'), (0.5, -1.6, 0.7)), ('lamp', bpy.data.lights.new('lamp', 'SUN'), (0.6, -0.5, 2))):
        thing = bpy.data.objects.new(name, data)
        bpy.context.scene.collection.objects.link(thing)
        thing.location = middle + size * Vector(place)
        thing.rotation_euler = (middle - thing.location).to_track_quat('-Z', 'Y').to_euler()
    bpy.context.scene.camera = bpy.data.objects['camera']
    bpy.data.objects['camera'].data.clip_start = 0.001 * size
    bpy.data.lights['lamp'].energy, bpy.data.lights['lamp'].angle = 1.6, 0.1
    bpy.ops.mesh.primitive_plane_add(size=20 * size, location=(middle[0], middle[1], low[2] - 0.002 * size))
    world = bpy.context.scene.world or bpy.data.worlds.new('world')
    world.use_nodes = True
    world.node_tree.nodes['Background'].inputs[0].default_value = (0.3, 0.36, 0.45, 1)
    bpy.context.scene.world = world


def draw(output, size, samples):
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples, scene.cycles.device = 'CYCLES', samples, 'CPU'
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = (int(part) for part in size.split('x'))
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = 'Standard'
    scene.render.filepath = os.path.abspath(output)
    bpy.ops.render.render(write_still=True)


def main():
    args = arguments()
    bpy.ops.wm.read_homefile(use_empty=True)
    scene, files, things = bpy.context.scene, files_of(args.input), []
    scene.render.fps, scene.render.fps_base = math.ceil(args.fps), math.ceil(args.fps) / args.fps
    if args.output and args.output.endswith('.png'):  # the one file that is drawn
        files = [file for file in files if args.time is None or file[1] <= args.time + 1e-9][-1:] or files[:1]
    begins = [round(time * args.fps) for _, time in files] + [None]
    for (path, _), begin, end in zip(files, begins, begins[1:]):
        for thing in (own := load(path)):
            thing.data.materials.clear()
            thing.data.materials.append(material_of(thing.data))
            if path.endswith('.ply') and not thing.data.polygons:
                show_as_points(thing, args.radius, thing.data.materials[0])
            if len(files) > 1:
                show_at(thing, begin, end)
        things.append(own)
    scene.frame_start, scene.frame_end = begins[0], begins[-2]
    scene.frame_set(begins[0])
    print(f'{args.input}: {len(files)} files, {sum(map(len, things))} objects, frames {scene.frame_start} to {scene.frame_end}')
    if args.output and args.output.endswith('.png'):
        add_camera(things[0])
        draw(args.output, args.size, args.samples)
    elif args.output:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(args.output))


try:
    main()
except Exception as error:  # Blender ends with 0 after an exception
    print(f'blender_series.py: {error}', file=sys.stderr)
    if bpy.app.background:
        sys.exit(1)
    raise
