#!/bin/sh
# The first steps of docs/get-started.md. tests/docs/examples.test.ts runs it in an empty folder with `strut` in the PATH.
set -eu

# anchor style
# Write the built-in database, and its motions as BVH files into the folder clips/.
strut demo-db -o demo.strutdb --page --bvh clips

# Style one of them: 70 % proud, the rest neutral.
strut stylize --db demo.strutdb --input clips/walk_neutral_001.bvh --style proud=0.7 -o walk-proud.bvh

# Print what a file holds: joints, frames, duration, contacts.
strut inspect walk-proud.bvh
# end style
