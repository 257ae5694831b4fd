#!/bin/sh
# A batch, docs/batch.md: runs after first_steps.sh in the same folder.
set -eu

mkdir -p batch
cp clips/walk_neutral_001.bvh batch/

# anchor variants
cat >variants.csv <<CSV
variant,style,k,timing
old,old,,
mixed,"proud=0.4,old=-0.2",20,off
CSV
strut stylize-batch batch --db demo.strutdb --variants variants.csv -o out
# end variants
