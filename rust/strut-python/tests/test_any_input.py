"""For any arguments, functions return, or raise StrutError, TypeError or OSError."""

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
@given(variants=st.one_of(ANY, st.dictionaries(st.text(max_size=6), STYLES, max_size=2)), parts=PARTS, options=OPTIONS, job=st.one_of(ANY, st.dictionaries(st.sampled_from(["job", "input", "variant", "status"]), ANY, max_size=4)))
def test_plans(db: strut.Database, tmp_path_factory, variants, parts, options, job) -> None:
    out = tmp_path_factory.getbasetemp() / "any"
    with allowed, contextlib.suppress(OSError):
        strut.batch.Plan("clips", out, db, variants, parts=parts, **options)
    plan = strut.batch.Plan("clips", out, db, "old")
    with allowed:
        plan.perform(job)
    with allowed:
        plan.record([job])


@cases
@given(track=st.one_of(ANY, st.lists(st.tuples(st.floats(), STYLES), max_size=2)), names=st.lists(st.text(max_size=3), max_size=3), parents=st.lists(st.integers(-2, 3), max_size=3), count=st.integers(0, 3), roles=st.one_of(ANY, st.dictionaries(st.sampled_from(["hips", "wing"]), ANY, max_size=2)), rate=ANY, up=ANY, unit=ANY)
def test_motions(db: strut.Database, jump: strut.Motion, track, names, parents, count, roles, rate, up, unit) -> None:
    if track not in (None, "", b"", []):
        with allowed:
            strut.stylize(jump, db, "odl", track=track)
    with allowed:
        strut.Motion.open(jump.name, roles=roles)
    arrays = [np.ones((count, 3), np.float32), np.ones((2, count, 3), np.float32), np.ones((2, count, 4), np.float32)]
    with allowed:
        strut.Motion.from_arrays(names, parents, *arrays, rate, up=up, metres_per_unit=unit, roles=roles)
    with allowed:
        strut.Motion.from_arrays(names[:count], parents[:count], *arrays, 30.0)


@cases
@given(any_value=ANY, styles=STYLES, numbers=st.lists(st.floats(), max_size=3), frames=st.one_of(st.integers(-5, 5), ANY))
def test_models(db: strut.Database, walks: strut.WalkModel, keys: strut.KeyStyleModel, any_value, styles, numbers, frames) -> None:
    walker = walks.walker()
    if not isinstance(frames, int) or abs(frames) < 100:
        with allowed, contextlib.suppress(OverflowError):
            walker.advance(frames)
    with allowed:
        walker.set_styles(styles)
    for name in ("cadence", "stride", "turn"):
        with allowed:
            walker.configure(**{name: any_value})
    for name in ("cadence", "stride", "turn", "transitions"):
        with allowed:
            walks.walk(styles, steps=1, **{name: any_value})
    with allowed:
        keys.pose(numbers)
    with allowed:
        keys.motion([(0.0, numbers), (any_value, numbers)])
    with allowed:
        db.tensor(any_value)
    with allowed, contextlib.suppress(OSError):
        strut.evaluate("no folder", "neutral", folds=any_value, k=any_value, labels=any_value)


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
