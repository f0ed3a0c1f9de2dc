#!/bin/sh -e
# Runs the scenes and renders every picture of this folder, about 180 CPU seconds, most of them for the finest stent. Needs gmsh, gnuplot, python3-h5py and python3-numpy.
cd "$(dirname "$0")/../.."
run() { name=$1; scene=$2; shift 2; ./nanson run "configs/$scene.toml" --threads 1 --quiet --force --out "results/pictures/$name" "$@"; }
r=results/pictures p=configs/pictures
run cube low_dispersion_cube --set mesh.cells=[12,12,12]
run plate beryllium_plate --set output.history_every=2
for scene in satellite punch stent twisting_column twisting_column_incompressible; do run $scene $scene; done
run taylor_bar taylor_bar --set output.every=1.0e-5
for k in constant linear limited; do run $k blake --set physics.reconstruction=$k --set physics.flux_correction=none; done
run limited+full blake
for size in 0.42e-3 0.188e-3; do
  gmsh -3 configs/meshes/stent.geo -format msh41 -nt 1 -setnumber size $size -o $r/stent_$size.msh
  run stent_$size stent --set mesh.file=$PWD/$r/stent_$size.msh --set output.history_every=100
done

io/results/render.py $r/cube --field velocity --frames 2 4 --scale 100 -o $p/low_dispersion_cube.svg
io/results/render.py $r/plate --frames 4 11 --view 20 20 --scale 400 -o $p/beryllium_plate.svg
io/results/plot_history.py $r/plate --columns centre_displacement_z top_P_22 --labels 8x48x8 -o $p/beryllium_plate_history.svg
io/results/render.py $r/satellite --field von_mises --frames 0 12 24 --view 30 40 -o $p/satellite.svg
io/results/plot_blake.py $r/constant $r/linear $r/limited $r/limited+full -o $p/blake.svg
io/results/render.py $r/twisting_column --frames 0 5 10 20 -o $p/twisting_column.svg
io/results/render.py $r/twisting_column_incompressible --frames 0 5 10 20 -o $p/twisting_column_incompressible.svg
io/results/render.py $r/punch --frames 4 20 40 --view 30 40 -o $p/punch.svg
io/results/render.py $r/taylor_bar --field plastic_strain --mirror xy --frames 0 2 4 8 -o $p/taylor_bar.svg
io/results/render.py $r/stent --frames 0 32 --view 35 20 --mirror z --height 400 -o $p/stent.svg
io/results/plot_history.py $r/stent $r/stent_0.42e-3 $r/stent_0.188e-3 --columns middle_displacement_x middle_displacement_z --labels "4,234 tets" "6,931 tets" "45,030 tets" -o $p/stent_history.svg
