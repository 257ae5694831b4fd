"""The joints of the engine's humanoid, and the bones with these roles."""

from collections.abc import Iterable, Mapping

LABELS = {
    "hips": "Hips",
    "spine": "Spine",
    "chest": "Chest",
    "neck": "Neck",
    "head": "Head",
    "left_shoulder": "Left Collarbone",
    "left_upper_arm": "Left Upper Arm",
    "left_lower_arm": "Left Forearm",
    "left_hand": "Left Hand",
    "right_shoulder": "Right Collarbone",
    "right_upper_arm": "Right Upper Arm",
    "right_lower_arm": "Right Forearm",
    "right_hand": "Right Hand",
    "left_upper_leg": "Left Thigh",
    "left_lower_leg": "Left Shin",
    "left_foot": "Left Foot",
    "left_toes": "Left Toes",
    "right_upper_leg": "Right Thigh",
    "right_lower_leg": "Right Shin",
    "right_foot": "Right Foot",
    "right_toes": "Right Toes",
}
"""Names of the roles in the panel."""

PARTS = {
    "head": "Head",
    "torso": "Torso",
    "left_arm": "Left Arm",
    "right_arm": "Right Arm",
    "legs": "Legs",
}
"""Parts of the body with optional separate styles."""


def given_roles(rows: Iterable[tuple[str, str]]) -> dict[str, str | None] | None:
    """
    Returns the roles for `strut.Motion.from_arrays`, from the rows of the list: role and name of the bone, empty for none. None
    for an empty list: all roles are then detected.
    """
    return {role: bone or None for role, bone in rows} or None


def bones_on_the_way(roles: Mapping[str, str], parents: Mapping[str, str | None]) -> set[str]:
    """Returns the bones with a role and their ancestors up to the hips, which a styled motion moves."""
    hips = roles.get("hips")
    moved: set[str] = set()
    for bone in roles.values():
        above: str | None = bone
        while above is not None and above not in moved:
            moved.add(above)
            above = None if above == hips else parents[above]
    return moved


def style_weights(rows: Iterable[tuple[str, float]]) -> dict[str, float]:
    """Returns the styles with a weight other than 0."""
    return {style: weight for style, weight in rows if weight != 0}


def part_styles(rows: Iterable[tuple[str, str, float]]) -> dict[str, dict[str, float]] | None:
    """
    Returns the parts for `strut.stylize`, from rows of part, style and weight; a part without a style follows the whole body.
    """
    return {part: {style: weight} for part, style, weight in rows if style} or None
