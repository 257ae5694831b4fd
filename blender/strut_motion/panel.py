"""The panel in the sidebar of the 3D view."""

import textwrap
from typing import Any

import bpy

from .operators import active_armature

PIXELS_A_LETTER = 7
"""Average width in Blender's default font, without scaling."""


class STRUT_UL_roles(bpy.types.UIList):
    """The roles of an armature's bones."""

    def draw_item(
        self,
        _context: Any,
        layout: Any,
        data: Any,
        item: Any,
        _icon: int,
        _active_data: Any,
        _active_property: str,
        _index: int,
    ) -> None:
        row = layout.split(factor=0.45)
        row.label(text=item.label)
        row.prop_search(item, "bone", data.data, "bones", text="")


class STRUT_PT_panel(bpy.types.Panel):
    """Database, styles, and the button."""

    bl_idname = "STRUT_PT_panel"
    bl_label = "Motion Style"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Strut"

    def draw(self, context: Any) -> None:
        layout, settings, state = self.layout, context.scene.strut_motion, context.window_manager.strut_motion
        layout.prop(settings, "source", expand=True)
        if settings.source == "FILE":
            layout.prop(settings, "path", text="")
        if settings.styles:
            column = layout.column(align=True)
            for style in settings.styles:
                column.prop(style, "weight", text=style.name.replace("_", " ").title(), slider=True)
        else:
            layout.operator("strut_motion.open_database")
        layout.prop(settings, "output", expand=True)
        if state.is_running:
            layout.progress(factor=state.share, text="Styling. Esc cancels")
        else:
            layout.operator("strut_motion.stylize", icon="PLAY")
        if active_armature(context) is None:
            _sentence(layout, context, "Select an armature that has a motion.", "INFO")
        if state.message:
            _sentence(layout, context, state.message, "ERROR" if state.is_error else "INFO")


class _Part:
    bl_parent_id = "STRUT_PT_panel"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_options = {"DEFAULT_CLOSED"}


class STRUT_PT_parts(_Part, bpy.types.Panel):
    """Styles of parts of the body."""

    bl_idname = "STRUT_PT_parts"
    bl_label = "Parts"

    @classmethod
    def poll(cls, context: Any) -> bool:
        """Requires an open database."""
        return len(context.scene.strut_motion.parts) > 0

    def draw(self, context: Any) -> None:
        settings = context.scene.strut_motion
        for part in settings.parts:
            row = self.layout.row(align=True)
            row.prop_search(part, "style", settings, "styles", text=part.label)
            weight = row.row(align=True)
            weight.active = bool(part.style)
            weight.prop(part, "weight", text="", slider=True)


class STRUT_PT_roles(_Part, bpy.types.Panel):
    """Which bone is which joint."""

    bl_idname = "STRUT_PT_roles"
    bl_label = "Roles of Bones"

    def draw(self, context: Any) -> None:
        self.layout.operator("strut_motion.find_roles")
        armature = active_armature(context)
        if armature is not None and armature.strut_motion_roles:
            self.layout.template_list(
                "STRUT_UL_roles", "", armature, "strut_motion_roles", armature, "strut_motion_role", rows=8
            )


class STRUT_PT_options(_Part, bpy.types.Panel):
    """Options of the engine."""

    bl_idname = "STRUT_PT_options"
    bl_label = "Options"

    def draw(self, context: Any) -> None:
        self.layout.prop(context.scene.strut_motion, "timing")
        self.layout.prop(context.scene.strut_motion, "footplant")


def _sentence(layout: Any, context: Any, text: str, icon: str) -> None:
    """Draws a sentence on several lines, since labels do not wrap."""
    width = context.region.width if context.region else 300
    # Without a window there is no scale.
    scale = context.preferences.system.ui_scale or 1
    letters = max(20, int(width / (PIXELS_A_LETTER * scale)) - 4)
    column = layout.column(align=True)
    for number, line in enumerate(textwrap.wrap(text, letters)):
        column.label(text=line, icon=icon if number == 0 else "BLANK1")


CLASSES = (STRUT_UL_roles, STRUT_PT_panel, STRUT_PT_parts, STRUT_PT_roles, STRUT_PT_options)


def register() -> None:
    """Registers the panel."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister() -> None:
    """Unregisters the panel."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
