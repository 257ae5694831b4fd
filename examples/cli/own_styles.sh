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

# anchor check
strut inspect styles.strutdb
strut stylize --db styles.strutdb --input clips/walk_neutral_001.bvh --style old=0.7 -o walk-old.bvh
# end check
