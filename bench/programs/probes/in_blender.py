"""What Blender holds of a file."""
import json
import sys

import bpy
import numpy

numpy.bool = bool  # the importer of glTF in Debian 12 is older than its numpy

path = sys.argv[sys.argv.index("--") + 1]
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
for material in list(bpy.data.materials):
    bpy.data.materials.remove(material)
kind = path.rsplit(".", 1)[1]
if kind == "ply":
    bpy.ops.import_mesh.ply(filepath=path)
elif kind == "stl":
    bpy.ops.import_mesh.stl(filepath=path)
elif kind == "obj":
    bpy.ops.wm.obj_import(filepath=path)
else:
    bpy.ops.import_scene.gltf(filepath=path)
meshes = [thing for thing in bpy.data.objects if thing.type == "MESH"]
places = [thing.matrix_world @ vertex.co for thing in meshes for vertex in thing.data.vertices]
extent = [max(place[n] for place in places) - min(place[n] for place in places) for n in range(3)]
colours = {tuple(round(c, 3) for c in (material.node_tree.nodes["Principled BSDF"].inputs[0].default_value if material.use_nodes
           else material.diffuse_color)) for material in bpy.data.materials if not material.use_nodes or "Principled BSDF" in material.node_tree.nodes}
colours |= {("attribute", thing.name, n) for thing in meshes for n in range(2 * len(thing.data.color_attributes))}
names = [thing.name for thing in bpy.data.objects] + [material.name for material in bpy.data.materials] + [
    group.name for thing in meshes for group in thing.vertex_groups]
print("FOUND " + json.dumps({"extent": extent, "faces": sum(len(thing.data.polygons) for thing in meshes),
                             "regions": max(len(meshes), len(bpy.data.materials)), "names": names, "colours": len(colours)}), flush=True)
