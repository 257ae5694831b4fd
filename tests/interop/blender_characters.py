"""Opens characters with a motion in Blender's own importer: blender --background --python blender_characters.py -- JOB…

A JOB is a JSON file {"file": GLB, "times": [seconds]}. Prints one JSON line per job with the position of each bone's head at
these times, and its rotation since the first of them: {"name": [[x, y, z], [w, x, y, z]], …} each, metres, +Y up as in glTF.
"""

import importlib.util
import json
import sys

import bpy
from mathutils import Matrix

# From Blender's +Z up to +Y up.
UP = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))

# Debian's Blender only recommends a package that its glTF importer requires.
if importlib.util.find_spec("numpy") is None:
    print("numpy is missing")
    sys.exit(0)

import numpy  # noqa: E402

# Blender 3.4 uses `np.bool`, which Debian's numpy no longer has, so that no glTF file opens.
numpy.bool = bool

for path in sys.argv[sys.argv.index("--") + 1 :]:
    with open(path, encoding="utf-8") as stream:
        job = json.load(stream)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=job["file"])
    scene = bpy.context.scene
    armature = next(o for o in scene.objects if o.type == "ARMATURE")
    rate = scene.render.fps / scene.render.fps_base
    first = {}
    places = []
    for secs in job["times"]:
        frame = secs * rate
        scene.frame_set(int(frame), subframe=frame - int(frame))
        place = {}
        for bone in armature.pose.bones:
            matrix = UP @ armature.matrix_world @ bone.matrix
            turn = matrix.to_quaternion()
            first.setdefault(bone.name, turn.inverted())
            place[bone.name] = [list(matrix.to_translation()), list(turn @ first[bone.name])]
        places.append(place)
    print(json.dumps({"file": job["file"], "places": places}))
