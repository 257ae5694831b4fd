"""Walk models, key-style models and evaluations equal those of the command, byte for byte."""

import json
import pickle
from pathlib import Path

import numpy as np
import pytest
import strut
from conftest import command


def test_a_model_of_walks_is_the_commands(files: Path, walks: strut.WalkModel, tmp_path: Path):
    clips = sorted((files / "clips").glob("walk_*_001.bvh"))
    command("train-walk", *clips, "-o", tmp_path / "command.strutwalk")
    assert walks.to_bytes() == (tmp_path / "command.strutwalk").read_bytes() and walks.refused == {}
    walks.save(tmp_path / "python.strutwalk")
    again = strut.WalkModel.open(tmp_path / "python.strutwalk")
    assert again.styles == walks.styles == pickle.loads(pickle.dumps(walks)).styles and "old" in walks.styles

    options = ["--steps", "8", "--stop", "--turn", "5", "--cadence", "100", "--stride", "0.9", "--transition", "proud=0.5@4:2"]
    command("walk", "--model", tmp_path / "command.strutwalk", "--style", "old", *options, "-o", tmp_path / "command.bvh")
    transitions = [({"proud": 0.5}, 4, 2)]
    walked = again.walk("old", steps=8, stop=True, turn=5, cadence=100, stride=0.9, transitions=transitions)
    assert walked.to_bvh() == (tmp_path / "command.bvh").read_text()
    assert walked.poses.shape == (len(walked.time_out), 87) and walked.planted.any(axis=1).all()
    assert walked.class_weights == {} and walked.trace is None and walked.repaired == 0
    assert len(walked.to_arrays(15).poses) == pytest.approx(len(walked.poses) / 2, abs=1)
    for wrong in ({"steps": 0}, {"turn": 11}, {"stride": 2}, {"cadence": -1}, {"transitions": [("odl", 1, 1)]}):
        with pytest.raises(strut.StrutError) as error:
            again.walk("old", **wrong)
        assert error.value.code == "bad-input"
    with pytest.raises(TypeError):
        again.walk("old", transitions=["old@4:2"])


def test_a_walker_walks_as_the_model_does_and_is_steered(walks: strut.WalkModel):
    walker = walks.walker()
    walker.set_styles({"old": 1})
    walker.reset()
    walked = walks.walk("old", steps=4)
    frames = walker.advance(len(walked.poses))
    np.testing.assert_array_equal(frames.poses, walked.poses)
    np.testing.assert_array_equal(frames.planted, walked.planted)
    np.testing.assert_array_equal(frames.time_out, walked.time_out)
    assert walker.step == 3
    walker.configure(turn=10, cadence=90)
    later = walker.advance(600)
    assert later.time_out[0] > frames.time_out[-1]
    assert np.linalg.norm(later.poses[-1, [0, 2]] - later.poses[0, [0, 2]]) < 600 / 30, "in a circle"
    walker.configure(walking=False)
    still = walker.advance(400).poses[-60:, :3]
    assert np.ptp(still, axis=0).max() < 0.1
    with pytest.raises(strut.StrutError):
        walker.advance(10**9)
    with pytest.raises(strut.StrutError):
        walker.configure(stride=9)


def test_a_key_style_model_is_the_commands(files: Path, tmp_path: Path):
    clips = sorted((files / "clips").glob("jump_*.bvh"))[:2]
    axes = "hips_height,hand_l.y - shoulder_l.y"
    command("train-key-style", *clips, "-o", tmp_path / "command.strutkeys", "--axes", axes, "--seed", "3", "--components", "4")
    steps = []
    model = strut.KeyStyleModel.train(clips, axes.split(","), seed=3, components=4, progress=lambda *step: steps.append(step))
    assert model.to_bytes() == (tmp_path / "command.strutkeys").read_bytes() and steps and model.refused == {}
    assert model.axes == axes.split(",")
    model.save(tmp_path / "python.strutkeys")
    again = pickle.loads(pickle.dumps(strut.KeyStyleModel.open(tmp_path / "python.strutkeys")))

    (tmp_path / "keys.csv").write_text(f"time,{axes}\n0,90,-20\n0.5,80,10\n1.25,95,-30\n")
    arguments = ["--model", tmp_path / "command.strutkeys", "--keys", tmp_path / "keys.csv", "--interpolation", "monotone"]
    command("key-style", *arguments, "-o", tmp_path / "command.bvh")
    keys = [(0, (90, -20)), (0.5, (80, 10)), (1.25, (95, -30))]
    assert again.motion(keys, interpolation="monotone").to_bvh() == (tmp_path / "command.bvh").read_text()
    low, high = again.pose([75, -20]), again.pose([95, -20])
    assert low.shape == (87,) and low.dtype == np.float32 and low[1] < high[1]
    for wrong in ([1.0], [1.0, float("nan")]):
        with pytest.raises(strut.StrutError):
            again.pose(wrong)
    with pytest.raises(strut.StrutError, match="ascending"):
        again.motion(keys[::-1])
    with pytest.raises(strut.StrutError, match="did you mean 'hips_height'"):
        strut.KeyStyleModel.train(clips, "hips_heigth")


def test_evaluations_are_the_commands(files: Path, tmp_path: Path):
    clips = tmp_path / "clips"
    clips.mkdir()
    for clip in (files / "clips").glob("jump_*.bvh"):
        if clip.name.split("_")[1] in ("neutral", "old"):
            (clips / clip.name).write_bytes(clip.read_bytes())
            text = clip.read_text()
            (clips / clip.name.replace("001", "002")).write_text(text + "\n")
    arguments = ["--source", "neutral", "--methods", "knn,mar", "--k", "10,20", "--json", tmp_path / "command.json"]
    arguments[4] = "-k"
    command("evaluate", "--data", clips, *arguments)
    expected = json.loads((tmp_path / "command.json").read_text())["results"]
    rows = strut.evaluate(clips, "neutral", methods=["knn", "mar"], k=[10, 20])
    without_time = [[{name: row[name] for name in row if not name.startswith("ms_per_frame")} for row in of] for of in (rows, expected)]
    assert without_time[0] == without_time[1] and len(rows) == 4
    for wrong in ({"k": "many"}, {"protocol": "none"}, {"folds": [1, 2]}, {"methods": ["mur"]}):
        with pytest.raises(strut.StrutError):
            strut.evaluate(clips, "neutral", **wrong)
    with pytest.raises(TypeError):
        strut.evaluate(clips, "neutral", q=1)
