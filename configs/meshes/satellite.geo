// Satellite: truncated cone along z, base radius 4, top radius 2, height 3 m, with four arms of 1 x 1 m that reach 6.5 m from the axis
// (Hassan et al. 2019, section 6.3). Not fixed there, chosen here: base at z = 0, arms along +-x and +-y at half height, z = 1 to 2.
// Region body; no face has a name, all are free. The default size gives about 2,500 nodes; the small satellite.msh was made by:
// gmsh -3 satellite.geo -format msh41 -nt 1 -setnumber size 0.55 -o satellite.msh
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.4 ];  // [m] of an edge
Cone(1) = {0, 0, 0, 0, 0, 3, 4, 2};
Box(2) = {-6.5, -0.5, 1, 13, 1, 1};
Box(3) = {-0.5, -6.5, 1, 1, 13, 1};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
Physical Volume("body") = {4};
Mesh.CharacteristicLengthMin = size;
Mesh.CharacteristicLengthMax = size;
