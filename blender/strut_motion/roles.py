"""The joints of the engine's humanoid, and the bones that play them."""

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
"""What each role is called in the panel."""

PARTS = {
    "head": "Head",
    "torso": "Torso",
    "left_arm": "Left Arm",
    "right_arm": "Right Arm",
    "legs": "Legs",
}
"""Parts of the body that may have a style of their own."""


def given_roles(rows: Iterable[tuple[str, str]]) -> dict[str, str | None] | None:
    """
    What `strut.Motion.from_arrays` takes as roles, from the rows of the list: role and name of the bone, empty where there is none.
    None for an empty list: all roles are then detected.
    """
    return {role: bone or None for role, bone in rows} or None


def bones_on_the_way(roles: Mapping[str, str], parents: Mapping[str, str | None]) -> set[str]:
    """The bones with a role and all above them up to the hips, which a styled motion moves."""
    hips = roles.get("hips")
    moved: set[str] = set()
    for bone in roles.values():
        above: str | None = bone
        while above is not None and above not in moved:
            moved.add(above)
            above = None if above == hips else parents[above]
    return moved


def style_weights(rows: Iterable[tuple[str, float]]) -> dict[str, float]:
    """The styles that have a weight."""
    return {style: weight for style, weight in rows if weight != 0}


def part_styles(rows: Iterable[tuple[str, str, float]]) -> dict[str, dict[str, float]] | None:
    """What `strut.stylize` takes as parts, from rows of part, style and weight; a part without a style is as the whole body."""
    return {part: {style: weight} for part, style, weight in rows if style} or None
