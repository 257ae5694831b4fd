"""Tensors of a file in the safetensors format."""

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._errors import StrutError

_TYPES = {"U8": "<u1", "I8": "<i1", "U16": "<u2", "I16": "<i2", "U32": "<u4", "I32": "<i4", "F32": "<f4", "U64": "<u8", "I64": "<i8", "F64": "<f8"}


def tensor(file: bytes, name: str) -> NDArray[Any]:
    """Returns the tensor with this name."""
    begin = 8 + int.from_bytes(file[:8], "little")
    entries = json.loads(file[8:begin])
    entries.pop("__metadata__", None)
    if name not in entries:
        raise StrutError(f"there is no tensor '{name}'; one of {', '.join(sorted(entries))} was expected", "bad-input")
    entry = entries[name]
    first, last = entry["data_offsets"]
    return np.frombuffer(file[begin + first : begin + last], _TYPES[entry["dtype"]]).reshape(entry["shape"]).copy()
