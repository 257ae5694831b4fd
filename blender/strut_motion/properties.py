"""Properties of the panel and the file: settings of the scene, roles of an armature's bones, the state of the work."""

from pathlib import Path
from typing import Any

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import databases
from .roles import LABELS, PARTS
from .styling import Problem, sentence


def say(text: str, *, is_error: bool = False) -> None:
    """Shows a message in the panel."""
    state = bpy.context.window_manager.strut_motion
    state.message, state.is_error = text, is_error


def database_path(settings: Any) -> str:
    """Returns the selected path, absolute. Raises `Problem` if no file is selected."""
    if settings.source == "BUILT_IN":
        return databases.BUILT_IN
    if not settings.path:
        raise Problem("Choose a database, a .strutdb file.")
    return bpy.path.abspath(settings.path)


def load_styles(settings: Any) -> None:
    """Lists the styles of the selected database. Weights of remaining styles are kept. Raises `Problem`."""
    path = database_path(settings)
    try:
        database = databases.open_database(path)
    except Problem:
        raise
    except Exception as error:
        # A panel is narrow, so only the file's name is shown.
        raise Problem(sentence(error).replace(path or "\0", Path(path).name)) from error
    weights = {row.name: row.weight for row in settings.styles}
    settings.styles.clear()
    for style in database.styles:
        if style != database.neutral:
            row = settings.styles.add()
            row.name, row.weight = style, weights.get(style, 0.0)
    if not settings.parts:
        for part, label in PARTS.items():
            row = settings.parts.add()
            row.name, row.label = part, label
    for row in settings.parts:
        if row.style not in settings.styles:
            row.style = ""


def _database_changed(settings: Any, _context: Any) -> None:
    settings.styles.clear()
    if settings.source == "FILE" and not settings.path:
        return
    try:
        load_styles(settings)
        say("")
    except Problem as problem:
        say(str(problem), is_error=True)


class StyleWeight(bpy.types.PropertyGroup):
    """A style and its weight; the name of the item is the style's."""

    weight: FloatProperty(
        name="Weight",
        description="Weight of this style. If the sum of all weights is below 1, the rest is neutral; above 1 exaggerates",
        min=-1,
        max=2,
        soft_min=0,
        soft_max=1,
        step=5,
    )


class PartStyle(bpy.types.PropertyGroup):
    """A style for a part of the body; the name of the item is the part's."""

    label: StringProperty()
    style: StringProperty(name="Style", description="Style of this part. Empty: the style of the whole body")
    weight: FloatProperty(name="Weight", default=1, min=-1, max=2, soft_min=0, soft_max=1, step=5)


class RoleBone(bpy.types.PropertyGroup):
    """The bone of a role; the name of the item is the role's."""

    label: StringProperty()
    bone: StringProperty(name="Bone", description="The bone of this body joint. Empty: no bone")


class Settings(bpy.types.PropertyGroup):
    """Settings of the styling."""

    source: EnumProperty(
        name="Database",
        items=[
            ("BUILT_IN", "Built-in", "The styles that the extension includes"),
            ("FILE", "File", "Styles of a database that 'strut build-db' or the web page made"),
        ],
        update=_database_changed,
    )
    path: StringProperty(
        name="File", description="A .strutdb file", subtype="FILE_PATH", update=_database_changed
    )
    styles: CollectionProperty(type=StyleWeight)
    parts: CollectionProperty(type=PartStyle)
    timing: BoolProperty(
        name="Timing", description="Let the style change the timing, and so the length", default=True
    )
    footplant: BoolProperty(name="Plant Feet", description="Hold feet in place while they touch the ground", default=True)
    output: EnumProperty(
        name="Output",
        items=[
            ("ACTION", "Action", "A new action, which the armature plays; the source action is kept"),
            ("STRIP", "NLA Strip", "A strip in the Nonlinear Animation editor, in a track above the source action"),
        ],
    )


class State(bpy.types.PropertyGroup):
    """State of the extension's work, and its last message. It is neither saved nor part of undo."""

    is_running: BoolProperty()
    share: FloatProperty()
    message: StringProperty()
    is_error: BoolProperty()


CLASSES = (StyleWeight, PartStyle, RoleBone, Settings, State)


def list_roles(armature: Any, bones: dict[str, str]) -> None:
    """Fills the armature's list of roles."""
    rows = armature.strut_motion_roles
    rows.clear()
    for role, label in LABELS.items():
        row = rows.add()
        row.name, row.label, row.bone = role, label, bones.get(role, "")


def _user_folder() -> Path | None:
    """Returns the folder in which an installed extension may write; None for modules that are imported otherwise."""
    try:
        return Path(bpy.utils.extension_path_user(__package__, create=True))
    except ValueError:
        return None


def register() -> None:
    """Registers the properties."""
    databases.kept_in = _user_folder()
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.strut_motion = PointerProperty(type=Settings)
    bpy.types.Object.strut_motion_roles = CollectionProperty(type=RoleBone)
    bpy.types.Object.strut_motion_role = IntProperty()
    bpy.types.WindowManager.strut_motion = PointerProperty(type=State, options={"SKIP_SAVE"})


def unregister() -> None:
    """Unregisters the properties."""
    del bpy.types.WindowManager.strut_motion
    del bpy.types.Object.strut_motion_role
    del bpy.types.Object.strut_motion_roles
    del bpy.types.Scene.strut_motion
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
