#!/bin/sh
# Key-styling, docs/concepts/key-styling.md: runs after first_steps.sh in the same folder.
set -eu

# anchor key-style
# Learn walks over two style variables.
strut train-key-style clips/walk_neutral_001.bvh -o walk.strutkeys --axes foot_separation,foot_height_difference

# A motion through keys: a step of each foot in a second.
cat >keys.csv <<CSV
time,foot_separation,foot_height_difference
0,50,0
0.25,0,-10
0.5,-50,5
0.75,0,12
1,50,0
CSV
strut key-style --model walk.strutkeys --keys keys.csv -o keyed.bvh
# end key-style
