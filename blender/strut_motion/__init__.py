# SPDX-License-Identifier: GPL-3.0-or-later
"""Strut in Blender: gives the motion of an armature another style."""


def register() -> None:
    """Adds properties, operators and the panel. Blender is imported here, so that the other modules can be tested without it."""
    from . import operators, panel, properties

    for module in (properties, operators, panel):
        module.register()


def unregister() -> None:
    """Takes them away."""
    from . import operators, panel, properties

    for module in (panel, operators, properties):
        module.unregister()
