"""A motion with options, docs/python.md: runs after ../cli/first_steps.sh in the same folder."""

# anchor stylize
import strut

db = strut.Database.open("demo.strutdb")  # or .demo(), or .build("clips/", pattern="{action}_{style}_{take}.bvh")
walk = strut.Motion.open("clips/walk_neutral_001.bvh")

styled = strut.stylize(walk, db, {"old": 0.7}, parts={"arms": "proud"}, k=30, timing=False)
styled.save("walk-old.bvh")
print(styled.poses.shape, styled.time_out[-1], styled.planted.mean())  # numpy arrays
# end stylize
