# Run by blender_test.sh inside Blender: the .glb loads, and its first, middle and last frame are the library's.
#   blender -b --python blender_check.py -- M.glb FIRST.ply MIDDLE.ply LAST.ply    frames as automorph writes them
import sys

import bpy
import numpy as np

SECONDS = 2  # the default of --seconds
TOLERANCE = 1e-6  # of the diagonal


def read_ply(name):
    """Vertices (#V x 3, double) and triangles (#F x 3) of a PLY that automorph wrote."""
    data = open(name, 'rb').read()
    header, body = data.split(b'end_header\n', 1)
    counts = [int(line.split()[2]) for line in header.decode().splitlines() if line.startswith('element')]
    vertices = np.frombuffer(body, '<f8', counts[0] * 3).reshape(-1, 3)
    faces = np.frombuffer(body, np.dtype([('n', 'u1'), ('v', '<i4', 3)]), counts[1], counts[0] * 24)
    return vertices, faces['v']


def frame(shape, time):
    """Vertices of the shape in world coordinates, as Blender shows them at a time in seconds."""
    scene = bpy.context.scene
    number = time * scene.render.fps
    scene.frame_set(int(number), subframe=number - int(number))
    graph = bpy.context.evaluated_depsgraph_get()
    evaluated = shape.evaluated_get(graph)
    mesh = evaluated.to_mesh()
    vertices = np.empty(len(mesh.vertices) * 3, np.float32)
    mesh.vertices.foreach_get('co', vertices)
    world = np.array(evaluated.matrix_world, np.float64)
    evaluated.to_mesh_clear()
    return vertices.reshape(-1, 3).astype(np.float64) @ world[:3, :3].T + world[:3, 3]


if 'bool' not in dir(np):
    np.bool = bool  # the reader of Debian 12's Blender wants it, and Debian 12's numpy no longer has it

glb, *frames = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=glb)
shape, = [each for each in bpy.data.objects if each.type == 'MESH']
print('Blender', bpy.app.version_string, 'reads', len(shape.data.vertices), 'vertices,', len(shape.data.polygons),
      'triangles, targets', [key.name for key in shape.data.shape_keys.key_blocks])

failures = 0
for name, alpha in zip(frames, (0.0, 0.5, 1.0)):
    vertices, faces = read_ply(name)
    used = np.unique(faces)  # Blender leaves out what no triangle uses
    diagonal = np.linalg.norm(vertices[used].max(0) - vertices[used].min(0))
    shown = frame(shape, alpha * SECONDS)
    if len(shown) != len(used) or len(shape.data.polygons) != len(faces):
        sys.exit(f'{name}: {len(used)} vertices, {len(faces)} triangles expected')
    error = np.linalg.norm(shown - vertices[used], axis=1).max() / diagonal
    print(f'alpha {alpha}: farthest vertex {error:.2e} of the diagonal from the library\'s')
    failures += int(error > TOLERANCE)
sys.exit(1 if failures else 0)
