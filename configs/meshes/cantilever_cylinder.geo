// Cantilever of circular section along x: length 1 m, radius 0.1 m. Faces clamped (x = 0), tip (x = 1), side; region body.
// Made by: gmsh -3 cantilever_cylinder.geo -format msh41 -o cantilever_cylinder.msh
SetFactory("OpenCASCADE");
length = 1.0;  // [m]
radius = 0.1;  // [m]
size = 0.045;  // [m] of an edge
Cylinder(1) = {0, 0, 0, length, 0, 0, radius};
clamped() = Surface In BoundingBox{-1e-3, -1, -1, 1e-3, 1, 1};
tip() = Surface In BoundingBox{length - 1e-3, -1, -1, length + 1e-3, 1, 1};
side() = Surface{:};
side() -= clamped();
side() -= tip();
Physical Volume("body") = {1};
Physical Surface("clamped") = {clamped()};
Physical Surface("tip") = {tip()};
Physical Surface("side") = {side()};
Mesh.CharacteristicLengthMin = size;
Mesh.CharacteristicLengthMax = size;
