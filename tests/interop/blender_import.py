"""Opens BVH files in Blender's own importer: blender --background --python blender_import.py -- FILE…

Prints one JSON line per file: bones, frames, frame rate, and the distance that the first bone's head travels.
"""

import builtins
import json
import sys

import bpy
from mathutils import Vector

# Blender 3.4 opens BVH files with mode "rU", which Debian's Python 3.11 no longer has, so that no BVH file opens.
python_open = builtins.open
builtins.open = lambda file, mode="r", *args, **kwargs: python_open(file, mode.replace("U", ""), *args, **kwargs)

for path in sys.argv[sys.argv.index("--") + 1 :]:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_anim.bvh(filepath=path, update_scene_fps=True, update_scene_duration=True)
    armature = next(o for o in bpy.context.scene.objects if o.type == "ARMATURE")
    scene = bpy.context.scene
    tip = next(b for b in armature.pose.bones if not b.children)
    first_frame, last_frame = (round(frame) for frame in armature.animation_data.action.frame_range)
    first = None
    travel = 0.0
    for frame in (first_frame, last_frame):
        scene.frame_set(frame)
        position = armature.matrix_world @ Vector(tip.head)
        travel = 0.0 if first is None else (position - first).length
        first = first or position.copy()
    print(
        json.dumps(
            {
                "file": path,
                "bones": [b.name for b in armature.data.bones],
                "frames": last_frame - first_frame + 1,
                "fps": scene.render.fps / scene.render.fps_base,
                "travel": travel,
            }
        )
    )
