#!/bin/sh
# Many files, docs/command-line.md: runs after first_steps.sh in the same folder.
set -eu

# anchor folder
mkdir -p inputs
cp clips/walk_neutral_001.bvh clips/run_neutral_001.bvh inputs/
strut stylize --db demo.strutdb --input inputs --style old=0.7 -o old/
# end folder

# anchor mixture
strut stylize --db demo.strutdb --input inputs/walk_neutral_001.bvh --style proud=0.5,old=0.5 -o mixed.bvh
strut stylize --db demo.strutdb --input inputs/walk_neutral_001.bvh --style proud=1.4 -o exaggerated.bvh
strut stylize --db demo.strutdb --input inputs/walk_neutral_001.bvh --style old --part arms:proud=1 -o parts.bvh
# end mixture

# anchor trace
strut stylize --db demo.strutdb --input inputs/walk_neutral_001.bvh --style old -o old.bvh --trace old.jsonl
# end trace

# anchor path
cat >path.csv <<CSV
x,z
0,0
0,4
3,7
CSV
strut drive --db demo.strutdb --path path.csv --style old -o along.bvh
# end path
