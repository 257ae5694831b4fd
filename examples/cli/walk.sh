#!/bin/sh
# Walk synthesis, docs/concepts/walk-synthesis.md: runs after first_steps.sh in the same folder.
set -eu

# anchor walk
# Train a model on labelled walks.
strut train-walk clips/walk_*_001.bvh -o walks.strutwalk

# Twelve steps, half proud; from step 6 to step 10 they turn old.
strut walk --model walks.strutwalk --style proud=0.5 --transition old@6:4 --steps 12 -o walk.bvh
# end walk
