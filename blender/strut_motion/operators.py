"""The operators: opening a database, detecting roles, styling."""

import time
from collections.abc import Generator
from functools import partial
from typing import Any

import bpy
import numpy as np

from . import armature as rig
from . import databases, stylization
from .properties import database_path, list_roles, load_styles, say
from .roles import given_roles, part_styles, style_weights
from .skeleton import likely_unit, motion_arrays
from .styling import Cancelled, Problem, Request, motion_of, sentence

TICK_SECS = 0.05
"""Longest time between two checks of the keyboard, seconds."""


def active_armature(context: Any) -> Any:
    """Returns the active armature, or the armature of the active mesh."""
    active = context.active_object
    return active and (active if active.type == "ARMATURE" else active.find_armature())


def order_of(settings: Any, armature: Any) -> stylization.Order:
    """Returns the settings of the panel. Raises `Problem`."""
    path = database_path(settings)
    if not settings.styles:
        load_styles(settings)
    styles = style_weights((row.name, row.weight) for row in settings.styles)
    parts = part_styles((row.name, row.style, row.weight) for row in settings.parts)
    if not styles and not parts:
        raise Problem("Give at least one style a weight above 0.")
    return stylization.Order(
        open_database=partial(databases.open_database, path),
        styles=styles,
        parts=parts,
        roles=given_roles((row.name, row.bone) for row in armature.strut_motion_roles),
        options={"timing": settings.timing, "footplant": settings.footplant},
        as_strip=settings.output == "STRIP",
    )


class STRUT_OT_open_database(bpy.types.Operator):
    """List the styles of the chosen database"""

    bl_idname = "strut_motion.open_database"
    bl_label = "Open Styles"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: Any) -> set[str]:
        try:
            load_styles(context.scene.strut_motion)
        except Problem as problem:
            return _refused(self, problem)
        say("")
        return {"FINISHED"}


class STRUT_OT_find_roles(bpy.types.Operator):
    """Find the bone of each body joint, by the names and positions of the bones. You can correct the result"""

    bl_idname = "strut_motion.find_roles"
    bl_label = "Find Roles"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Requires an armature."""
        return active_armature(context) is not None

    def execute(self, context: Any) -> set[str]:
        armature = active_armature(context)
        try:
            motion = _rest_motion(context.scene, armature)
        except Problem as problem:
            if not armature.strut_motion_roles:
                list_roles(armature, {})
            return _refused(self, problem)
        list_roles(armature, motion.roles)
        say(motion.note)
        return {"FINISHED"}


def _rest_motion(scene: Any, armature: Any) -> Any:
    """Returns one frame in the rest pose. Raises `Problem`."""
    tree = rig.tree(armature)
    rest = np.array(armature.matrix_world) @ tree.rest
    request = Request(
        names=tree.names,
        parents=tree.parents,
        arrays=motion_arrays(tree.parents, rest, rest[None]),
        rate_hz=rig.rate_of(scene),
        metres_per_unit=likely_unit(rest, scene.unit_settings.scale_length),
        roles=None,
        open_database=lambda: None,
        styles={},
        parts=None,
        options={},
    )
    try:
        return motion_of(request)
    except Problem:
        raise
    except Exception as error:
        raise Problem(sentence(error)) from error


class STRUT_OT_stylize(bpy.types.Operator):
    """Style the armature's motion, in a new action. Esc cancels"""

    bl_idname = "strut_motion.stylize"
    bl_label = "Stylize"
    bl_options = {"REGISTER", "UNDO"}

    _work: Generator[stylization.Step, None, stylization.Outcome]
    _timer: Any = None

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Requires an armature that is not in edit mode, and no other work in progress."""
        armature = active_armature(context)
        return armature is not None and armature.mode != "EDIT" and not context.window_manager.strut_motion.is_running

    def _begin(self, context: Any) -> None:
        armature = active_armature(context)
        self._work = stylization.stylize(context.scene, armature, order_of(context.scene.strut_motion, armature))

    def execute(self, context: Any) -> set[str]:
        """Does all steps at once, for scripts."""
        try:
            self._begin(context)
            while True:
                if next(self._work).waits:
                    time.sleep(0.005)
        except StopIteration as end:
            return self._done(end.value)
        except Problem as problem:
            return _refused(self, problem)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        """Starts to work in steps, so that Blender stays responsive."""
        try:
            self._begin(context)
        except Problem as problem:
            return _refused(self, problem)
        state = context.window_manager.strut_motion
        state.is_running, state.share = True, 0.0
        say("")
        self._timer = context.window_manager.event_timer_add(TICK_SECS, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: Any, event: Any) -> set[str]:
        """Continues the work for the duration of a tick."""
        if event.type == "ESC":
            self._end(context)
            say("Cancelled.")
            return {"CANCELLED"}
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        try:
            context.window_manager.strut_motion.share = advance(self._work, TICK_SECS)
        except StopIteration as end:
            self._end(context)
            return self._done(end.value)
        except Problem as problem:
            self._end(context)
            return _refused(self, problem)
        for area in context.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()
        return {"RUNNING_MODAL"}

    def cancel(self, context: Any) -> None:
        """Called when Blender stops the operator, for example when its window is closed."""
        self._end(context)

    def _end(self, context: Any) -> None:
        self._work.close()
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.strut_motion.is_running = False

    def _done(self, outcome: stylization.Outcome) -> set[str]:
        last = outcome.first_frame + outcome.frames - 1
        text = f"'{outcome.action.name}', frames {outcome.first_frame} to {last}. {outcome.note}"
        say(text)
        self.report({"INFO"}, text)
        return {"FINISHED"}


def advance(work: Generator[stylization.Step, None, stylization.Outcome], secs: float) -> float:
    """
    Continues the work until the time has elapsed or a thread must finish. Returns the progress.

    Raises `StopIteration` with the outcome at the end, and exceptions of the work.
    """
    deadline = time.monotonic() + secs
    while True:
        step = next(work)
        if step.waits or time.monotonic() >= deadline:
            return step.share


def _refused(operator: Any, problem: Problem) -> set[str]:
    say(str(problem), is_error=True)
    operator.report({"ERROR"}, str(problem))
    return {"CANCELLED"}


CLASSES = (STRUT_OT_open_database, STRUT_OT_find_roles, STRUT_OT_stylize)


def register() -> None:
    """Registers the operators."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """Unregisters the operators."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
    databases.forget()
