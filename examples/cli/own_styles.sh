#!/bin/sh
# A database of one's own, docs/own-styles.md: runs after first_steps.sh in the same folder.
set -eu

cp clips/walk_depressed_001.bvh walk-tired.bvh

# anchor add-style
strut add-style --db demo.strutdb --input walk-tired.bvh --style tired -o more.strutdb
# end add-style

# anchor build-db
strut build-db clips -o styles.strutdb --pattern '{action}_{style}_{take}.bvh' --neutral neutral
# end build-db

mkdir -p session1
cp clips/walk_neutral_001.bvh session1/001.bvh
cp clips/walk_old_001.bvh session1/002.bvh

# anchor labels
cat >labels.csv <<CSV
file,action,style,take
session1/001.bvh,walk,normal,1
session1/002.bvh,walk,old,1
CSV
strut build-db session1 -o session1.strutdb --labels labels.csv --neutral normal
# end labels

# anchor check
strut inspect styles.strutdb
strut stylize --db styles.strutdb --input clips/walk_neutral_001.bvh --style old=0.7 -o walk-old.bvh
# end check
