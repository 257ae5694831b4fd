"""A walk in a notebook, restyled in the browser.

    from strut_widget import Walk
    walk = Walk(styles={"proud": 1})
    walk                       # shows it
    walk.styles = {"old": 0.5} # restyles it
    walk.save("old.bvh")

`npm install && npm run build` in this folder makes strut_widget.js; Python needs anywidget.
"""

from pathlib import Path

import anywidget
import traitlets


def _bytes(value, _widget):
    """What comes from the browser is a view of a message's buffer."""
    return bytes(value)


class Walk(anywidget.AnyWidget):
    """A walk. The engine is in the browser: nothing is sent anywhere but to this notebook's kernel."""

    _esm = Path(__file__).parent / "strut_widget.js"

    source = traitlets.Unicode("strut:neutral-walk").tag(sync=True)
    """The text of a BVH file, or the name of the built-in walk."""

    styles = traitlets.Dict(
        key_trait=traitlets.Unicode(), value_trait=traitlets.Float(), default_value={"proud": 1.0}
    ).tag(sync=True)
    """How much of each style: angry, childlike, depressed, neutral, old, proud, sexy, strutting. 1 is as recorded."""

    frame = traitlets.Int(0).tag(sync=True)
    """The frame that is shown, 60 a second."""

    bvh = traitlets.Bytes(b"").tag(sync=True, from_json=_bytes)
    """The styled motion as a BVH file, on the skeleton of the source. The browser fills it in."""

    def save(self, path):
        """Writes the styled motion to a file."""
        if not self.bvh:
            raise ValueError("The walk is not styled yet: show the widget first.")
        Path(path).write_bytes(self.bvh)
