#!/bin/sh
# A batch, docs/batch.md: runs after many_files.sh in the same folder.
set -eu

# anchor variants
cat >variants.csv <<CSV
variant,style,k,timing
old,old,,
mixed,"proud=0.4,old=-0.2",20,off
CSV
strut stylize-batch inputs --db demo.strutdb --variants variants.csv -o out
# end variants
