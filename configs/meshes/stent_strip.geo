// One eighth of the stent of stent.geo, its axis along y, for a load on the strips at z = +-r (Hassan et al. 2019, section 6.8: there the history is that of
// the point (r/2, 0, sqrt(3/4) r), which lies in the shell only if its axis is y). Outer diameter 20, thickness 0.5, length 20 mm; holes as in stent.geo,
// rings along y, angles from the z axis. Face strip: the outer surface within 6 degrees of the plane x = 0, chosen here; faces x0 y0 z0 (symmetry planes);
// the rest has no name and is free. Region shell. Lengths in metres. The small
// stent_strip.msh was made by: gmsh -3 stent_strip.geo -format msh41 -nt 1 -o stent_strip.msh
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.55e-3 ];  // [m] of an edge
Geometry.Tolerance = 1e-9;
outer = 10e-3;
inner = 9.5e-3;
length = 10e-3;
hole = 1e-3;
half_strip = outer * Sin(6 * Pi / 180);
Cylinder(1) = {0, 0, 0, 0, length, 0, outer};
Cylinder(2) = {0, 0, 0, 0, length, 0, inner};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
tool = 10;
For ring In {0:3}
  count = (ring % 2 == 0) ? 3 : 4;
  For i In {0:count - 1}
    angle = (ring % 2 == 0 ? 15 : 0) * Pi / 180 + i * Pi / 6;
    Cylinder(tool) = {0, (1.25 + 2.5 * ring) * 1e-3, 0, 1.2 * outer * Sin(angle), 0, 1.2 * outer * Cos(angle), hole};
    tool += 1;
  EndFor
EndFor
BooleanDifference(4) = { Volume{3}; Delete; }{ Volume{10:tool - 1}; Delete; };
Box(100) = {0, 0, 0, half_strip, length, 2 * outer};
Box(101) = {half_strip, 0, 0, 2 * outer, length, 2 * outer};
BooleanIntersection(5) = { Volume{4}; }{ Volume{100}; Delete; };
BooleanIntersection(6) = { Volume{4}; Delete; }{ Volume{101}; Delete; };
both() = BooleanFragments{ Volume{5}; Delete; }{ Volume{6}; Delete; };
e = 1e-5;
x0() = Surface In BoundingBox{-e, -e, -e, e, length + e, outer + e};
y0() = Surface In BoundingBox{-e, -e, -e, outer + e, e, outer + e};
z0() = Surface In BoundingBox{-e, -e, -e, outer + e, length + e, e};
strip() = Surface In BoundingBox{-e, -e, 0.99 * outer, half_strip + e, length + e, outer + e};
Physical Volume("shell") = {both()};
Physical Surface("x0") = {x0()};
Physical Surface("y0") = {y0()};
Physical Surface("z0") = {z0()};
Physical Surface("strip") = {strip()};
Mesh.CharacteristicLengthMin = size;
Mesh.CharacteristicLengthMax = size;
