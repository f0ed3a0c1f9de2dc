// One eighth of a stent: cylindrical shell about z, outer diameter 20, thickness 0.5, length 20 mm, with round radial holes of 2 mm
// (Hassan et al. 2019, section 6.8). The paper shows no pattern in numbers; ours: rings at z = +-1.25, +-3.75, +-6.25 and +-8.75 mm of 12 holes,
// 30 degrees apart; rings 1 and 3 start at 15 degrees from the plane y = 0, rings 2 and 4 at 0 (their first and last holes are cut by the planes).
// Faces x0 y0 z0 (symmetry planes) and end (z = 10 mm); the rest has no name and is free. Region shell. Lengths in metres.
// The small stent.msh was made by: gmsh -3 stent.geo -format msh41 -nt 1 -o stent.msh; finer: -setnumber size 0.25e-3
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.55e-3 ];  // [m] of an edge
Geometry.Tolerance = 1e-9;
outer = 10e-3;
inner = 9.5e-3;
length = 10e-3;
hole = 1e-3;
Cylinder(1) = {0, 0, 0, 0, 0, length, outer, Pi / 2};
Cylinder(2) = {0, 0, 0, 0, 0, length, inner, Pi / 2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
tool = 10;
For ring In {0:3}
  count = (ring % 2 == 0) ? 3 : 4;
  For i In {0:count - 1}
    angle = (ring % 2 == 0 ? 15 : 0) * Pi / 180 + i * Pi / 6;
    Cylinder(tool) = {0, 0, (1.25 + 2.5 * ring) * 1e-3, 1.2 * outer * Cos(angle), 1.2 * outer * Sin(angle), 0, hole};
    tool += 1;
  EndFor
EndFor
BooleanDifference(4) = { Volume{3}; Delete; }{ Volume{10:tool - 1}; Delete; };
e = 1e-5;
x0() = Surface In BoundingBox{-e, -e, -e, e, outer + e, length + e};
y0() = Surface In BoundingBox{-e, -e, -e, outer + e, e, length + e};
z0() = Surface In BoundingBox{-e, -e, -e, outer + e, outer + e, e};
end() = Surface In BoundingBox{-e, -e, length - e, outer + e, outer + e, length + e};
Physical Volume("shell") = {4};
Physical Surface("x0") = {x0()};
Physical Surface("y0") = {y0()};
Physical Surface("z0") = {z0()};
Physical Surface("end") = {end()};
Mesh.CharacteristicLengthMin = size;
Mesh.CharacteristicLengthMax = size;
