"""Whatever functions are given, they answer, or raise StrutError, TypeError or OSError."""

import contextlib

import hypothesis.extra.numpy as npst
import numpy as np
import strut
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

ANY = st.one_of(st.none(), st.booleans(), st.integers(-(10**20), 10**20), st.floats(), st.text(max_size=8), st.binary(max_size=8))
STYLES = st.one_of(ANY, st.dictionaries(st.one_of(st.sampled_from(["old", "proud", "neutral"]), st.text(max_size=4)), ANY, max_size=3))
NAMES = ["action", "input_style", "k", "lambda_", "rho", "tempo", "kappa", "delta", "coherence", "timing", "footplant", "method", "search", "q"]
OPTIONS = st.dictionaries(st.sampled_from(NAMES), ANY, max_size=3)
PARTS = st.one_of(st.none(), st.dictionaries(st.sampled_from(["legs", "left_arm", "wing"]), STYLES, max_size=2))
NUMBERS = st.sampled_from([0.0, 1.0, -1.0, 1e-30, 1e30, np.inf, -np.inf, np.nan, 0.5])
POSES = npst.arrays(np.float32, st.tuples(st.integers(0, 4), st.sampled_from([87, 87, 87, 3])), elements=NUMBERS)
cases = settings(max_examples=200, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
allowed = contextlib.suppress(strut.StrutError, TypeError)


@cases
@given(source=st.binary(max_size=200))
def test_files(source: bytes) -> None:
    with allowed:
        strut.Motion.open(source)
    with allowed:
        strut.Database.open(source)


@cases
@given(styles=STYLES, parts=PARTS, options=OPTIONS, poses=POSES)
def test_stylizers(db: strut.Database, styles, parts, options, poses) -> None:
    with allowed:
        strut.Stylizer(db, styles, parts=parts, **options)
    stylizer = strut.Stylizer(db, "old")
    with allowed:
        stylizer.set_styles(styles, parts)
    with allowed:
        stylizer.configure(**options)
    with allowed:
        assert len(stylizer.push(poses).poses) == len(poses)


@cases
@given(first=POSES, second=POSES, planted=npst.arrays(np.uint8, (4, 2)))
def test_metrics(db: strut.Database, first, second, planted) -> None:
    for measure in (strut.metrics.mean_acceleration, strut.metrics.mean_jerk, strut.positions):
        with allowed:
            measure(db, first)
    with allowed:
        strut.metrics.pose_error(db, first, second)
    with allowed:
        strut.metrics.foot_skate(db, first, planted)
