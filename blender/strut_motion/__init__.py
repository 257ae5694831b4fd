# SPDX-License-Identifier: GPL-3.0-or-later
"""Strut in Blender: changes the style of an armature's motion."""


def register() -> None:
    """Registers properties, operators and the panel. Imports Blender here, so that the other modules can be tested without it."""
    from . import operators, panel, properties

    for module in (properties, operators, panel):
        module.register()


def unregister() -> None:
    """Unregisters them."""
    from . import operators, panel, properties

    for module in (panel, operators, properties):
        module.unregister()
