"""Run inside Blender: opens an animated GLB and compares its vertices at some frames with OBJ files of those frames."""
import os
import sys

import bpy
import numpy
from mathutils import Vector, kdtree

numpy.bool = bool  # Debian 12's Blender 3.4 asks its newer numpy for a name that is gone

file, folder, *frames = sys.argv[sys.argv.index("--") + 1:]
LARGEST = 1e-4  # [m]

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = 30
bpy.ops.import_scene.gltf(filepath=file)
objects = [o for o in bpy.context.scene.objects if o.type == "MESH"]
print("objects", [o.name for o in objects], "materials", [m.name for m in bpy.data.materials])


def ours(frame):
    with open(os.path.join(folder, frame + ".obj")) as lines:
        return [Vector(map(float, l.split()[1:4])) for l in lines if l.startswith("v ")]


# Blender keeps vertices by primitive, so each is paired with ours at the first frame and must be that one at all.
pairs = None
for frame in frames:
    bpy.context.scene.frame_set(int(frame))
    graph = bpy.context.evaluated_depsgraph_get()
    places = []
    for o in objects:
        evaluated = o.evaluated_get(graph)
        mesh = evaluated.to_mesh()
        for vertex in mesh.vertices:
            p = evaluated.matrix_world @ vertex.co
            places.append(Vector((p.x, p.z, -p.y)))  # back to +Y up
        evaluated.to_mesh_clear()
    wanted = ours(frame)
    tree = kdtree.KDTree(len(wanted))
    for i, p in enumerate(wanted):
        tree.insert(p, i)
    tree.balance()
    worst = max(tree.find(p)[2] for p in places)
    if pairs is None:
        pairs = [tree.find_n(p, 4) for p in places]
        pairs = [[index for _, index, distance in near if distance < LARGEST] for near in pairs]
    paired = max(min((wanted[i] - p).length for i in near) for p, near in zip(places, pairs) if near)
    print(f"frame {frame}: {len(places)} of {len(wanted)} vertices, farthest {worst:.2e} m from any, {paired:.2e} m from its own")
    if not (worst < LARGEST and paired < LARGEST):
        print("error: vertices differ")
        sys.exit(1)
