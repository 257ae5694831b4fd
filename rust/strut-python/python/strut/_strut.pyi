from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, Literal, Unpack, final

import numpy as np
from numpy.typing import NDArray

from ._arrays import Arrays, Styled
from ._errors import StrutError
from ._types import EvaluateOptions, Note, Options, PathLike, Progress, Styles, Track, TraceLine
from .batch import Job, Record

_UpAxis = Literal["x", "-x", "y", "-y", "z", "-z"]

__all__ = [
    "Database",
    "StyledMotions",
    "foot_skate",
    "mean_acceleration",
    "mean_jerk",
    "pose_error",
    "positions",
    "Motion",
    "StyledMotion",
    "stylize",
    "Plan",
    "Stylizer",
    "WalkModel",
    "Walker",
    "KeyStyleModel",
    "evaluate",
]

@final
class Database:
    @staticmethod
    def open(source: PathLike | bytes, *, sha256: str | None = None) -> Database: ...
    @staticmethod
    def demo() -> Database: ...
    @staticmethod
    def build(
        clips: PathLike | Sequence[PathLike],
        *,
        pattern: str | None = None,
        labels: PathLike | None = None,
        neutral: str | None = None,
        rate_hz: float = 60.0,
        roles: Mapping[str, str | None] | None = None,
        up: _UpAxis | None = None,
        floor: float | None = None,
        swap_sides: bool = False,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> Database: ...
    def add_style(self, motion: Motion, name: str, *, action: str | None = None, threads: int = 0) -> Database: ...
    def tensor(self, name: str) -> NDArray[Any]: ...
    def save(self, path: PathLike) -> None: ...
    def to_bytes(self) -> bytes: ...
    @property
    def proportions(self) -> NDArray[np.float32]: ...
    @property
    def name(self) -> str: ...
    @property
    def frames(self) -> int: ...
    @property
    def rate_hz(self) -> float: ...
    @property
    def actions(self) -> list[str]: ...
    @property
    def styles(self) -> list[str]: ...
    @property
    def neutral(self) -> str: ...
    @property
    def clips(self) -> list[str]: ...
    @property
    def classes(self) -> list[str]: ...
    @property
    def refused(self) -> dict[str, str]: ...
    @property
    def sha256(self) -> str: ...
    def __reduce__(self) -> tuple[Callable[..., Database], tuple[PathLike | bytes, str]]: ...

@final
class Motion:
    @staticmethod
    def open(
        source: PathLike | bytes,
        *,
        roles: Mapping[str, str | None] | None = None,
        up: _UpAxis | None = None,
        floor: float | None = None,
        swap_sides: bool = False,
    ) -> Motion: ...
    @staticmethod
    def from_arrays(
        names: Sequence[str],
        parents: Sequence[int],
        offsets: NDArray[np.float32],
        translations: NDArray[np.float32],
        rotations_xyzw: NDArray[np.float32],
        rate_hz: float,
        *,
        up: Literal["y", "z"] = "y",
        metres_per_unit: float | None = None,
        roles: Mapping[str, str | None] | None = None,
    ) -> Motion: ...
    @staticmethod
    def _reopen(
        bytes: bytes,
        name: str,
        roles: Mapping[str, str | None] | None,
        up: _UpAxis | None,
        floor: float | None,
        swap_sides: bool,
        metres_per_unit: float | None,
    ) -> Motion: ...
    def poses(self, db: Database) -> NDArray[np.float32]: ...
    def contacts(self, db: Database) -> NDArray[np.uint8]: ...
    @property
    def name(self) -> str: ...
    @property
    def frames(self) -> int: ...
    @property
    def rate_hz(self) -> float: ...
    @property
    def duration_secs(self) -> float: ...
    @property
    def roles(self) -> dict[str, str]: ...
    @property
    def note(self) -> str: ...
    @property
    def notes(self) -> list[Note]: ...
    def __reduce__(
        self,
    ) -> tuple[
        Callable[..., Motion],
        tuple[bytes, str, dict[str, str | None] | None, _UpAxis | None, float | None, bool, float | None],
    ]: ...

@final
class StyledMotion:
    @property
    def poses(self) -> NDArray[np.float32]: ...
    @property
    def time_out(self) -> NDArray[np.float64]: ...
    @property
    def planted(self) -> NDArray[np.uint8]: ...
    @property
    def class_weights(self) -> dict[str, float]: ...
    @property
    def notes(self) -> list[Note]: ...
    @property
    def duration_secs(self) -> float: ...
    @property
    def repaired(self) -> int: ...
    @property
    def trace(self) -> list[TraceLine] | None: ...
    def to_bvh(self) -> str: ...
    def save(self, path: PathLike) -> None: ...
    def to_arrays(self, rate_hz: float | None = None) -> Arrays: ...

@final
class StyledMotions(Iterator[StyledMotion | StrutError]):
    def __new__(
        cls,
        motions: Iterable[Motion],
        db: Database,
        styles: Styles,
        *,
        parts: Mapping[str, Styles] | None = None,
        threads: int = 0,
        **options: Unpack[Options],
    ) -> StyledMotions: ...
    def __iter__(self) -> StyledMotions: ...
    def __next__(self) -> StyledMotion | StrutError: ...

@final
class Plan:
    def __new__(
        cls,
        inputs: PathLike | Sequence[PathLike],
        out: PathLike,
        db: Database | PathLike,
        variants: str | Mapping[str, Styles] | PathLike,
        *,
        parts: Mapping[str, Styles] | None = None,
        retry: Literal["failed", "skipped", "all"] | None = None,
        verify: bool = False,
        roles: Mapping[str, str | None] | None = None,
        up: _UpAxis | None = None,
        floor: float | None = None,
        swap_sides: bool = False,
        **options: Unpack[Options],
    ) -> Plan: ...
    def pending(self, *, progress: Progress | None = None) -> list[Job]: ...
    def perform(self, job: Job) -> Record: ...
    def record(self, rows: Iterable[Record]) -> None: ...
    @property
    def sha256(self) -> str: ...
    def __reduce__(self) -> tuple[Callable[..., Plan], tuple[tuple[object, ...], dict[str, object], str]]: ...

@final
class Stylizer:
    def __new__(
        cls,
        db: Database,
        styles: Styles,
        *,
        parts: Mapping[str, Styles] | None = None,
        **options: Unpack[Options],
    ) -> Stylizer: ...
    def set_styles(self, styles: Styles, parts: Mapping[str, Styles] | None = None) -> None: ...
    def configure(self, **options: Unpack[Options]) -> None: ...
    def push(self, poses: NDArray[np.float32]) -> Styled: ...
    def reset(self) -> None: ...

@final
class WalkModel:
    @staticmethod
    def open(source: PathLike | bytes) -> WalkModel: ...
    @staticmethod
    def train(
        clips: PathLike | Sequence[PathLike],
        *,
        pattern: str | None = None,
        labels: PathLike | None = None,
        threads: int = 0,
        progress: Progress | None = None,
    ) -> WalkModel: ...
    def save(self, path: PathLike) -> None: ...
    def to_bytes(self) -> bytes: ...
    @property
    def styles(self) -> list[str]: ...
    @property
    def refused(self) -> dict[str, str]: ...
    def walk(
        self,
        styles: Styles,
        *,
        steps: int = 12,
        transitions: Iterable[tuple[Styles, int, int]] | None = None,
        cadence: float | None = None,
        stride: float = 1.0,
        stop: bool = False,
        turn: float = 0.0,
        limits: bool = True,
        progress: Progress | None = None,
    ) -> StyledMotion: ...
    def walker(self) -> Walker: ...
    def __reduce__(self) -> tuple[Callable[..., WalkModel], tuple[bytes]]: ...

@final
class Walker:
    def set_styles(self, styles: Styles) -> None: ...
    def configure(
        self,
        *,
        cadence: float | None = None,
        stride: float = 1.0,
        turn: float = 0.0,
        limits: bool = True,
        walking: bool = True,
    ) -> None: ...
    def advance(self, frames: int = 1) -> Styled: ...
    @property
    def step(self) -> int: ...
    def reset(self) -> None: ...

@final
class KeyStyleModel:
    @staticmethod
    def open(source: PathLike | bytes) -> KeyStyleModel: ...
    @staticmethod
    def train(
        source: PathLike | Sequence[PathLike],
        axes: str | Sequence[str],
        *,
        seed: int = 0,
        components: int | None = None,
        method: Literal["som", "em"] = "som",
        threads: int = 0,
        progress: Progress | None = None,
    ) -> KeyStyleModel: ...
    def save(self, path: PathLike) -> None: ...
    def to_bytes(self) -> bytes: ...
    @property
    def axes(self) -> list[str]: ...
    @property
    def refused(self) -> dict[str, str]: ...
    def pose(self, style: Sequence[float]) -> NDArray[np.float32]: ...
    def motion(
        self,
        keys: Iterable[tuple[float, Sequence[float]]],
        *,
        interpolation: Literal["catmull-rom", "monotone"] = "catmull-rom",
        mode: Literal["smooth", "hard"] = "smooth",
    ) -> StyledMotion: ...
    def __reduce__(self) -> tuple[Callable[..., KeyStyleModel], tuple[bytes]]: ...

def stylize(
    motion: Motion,
    db: Database,
    styles: Styles,
    *,
    parts: Mapping[str, Styles] | None = None,
    track: Track | None = None,
    trace: bool = False,
    threads: int = 0,
    progress: Progress | None = None,
    **options: Unpack[Options],
) -> StyledMotion: ...
def evaluate(
    data: PathLike,
    source: str,
    *,
    threads: int = 0,
    progress: Progress | None = None,
    **options: Unpack[EvaluateOptions],
) -> list[dict[str, Any]]: ...
def positions(db: Database, poses: NDArray[np.float32]) -> NDArray[np.float32]: ...
def pose_error(db: Database, first: NDArray[np.float32], second: NDArray[np.float32]) -> float: ...
def foot_skate(db: Database, poses: NDArray[np.float32], planted: NDArray[np.uint8] | None = None) -> float: ...
def mean_acceleration(db: Database, poses: NDArray[np.float32]) -> float: ...
def mean_jerk(db: Database, poses: NDArray[np.float32]) -> float: ...
