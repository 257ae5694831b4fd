import strut

db = strut.Database.demo()  # or strut.Database.open("styles.strutdb")
walk = strut.Motion.open("clips/walk_neutral_001.bvh")

styled = strut.stylize(walk, db, {"proud": 0.7})
styled.save("walk-proud.bvh")
print(styled.poses.shape, styled.duration_secs)
