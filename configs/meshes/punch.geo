// Punch block: 1 x 1 x 0.5 m with 3 x 3 through holes along z of diameter 0.2 m, centres at -0.3, 0 and 0.3 m (Hassan et al. 2019, section 6.6).
// Faces xmin xmax ymin ymax zmin zmax and holes; region block. A larger mesh: gmsh -3 punch.geo -format msh41 -setnumber size 0.04 -o punch_fine.msh
// At the default size the holes have eight sides. The small punch.msh was made by: gmsh -3 punch.geo -format msh41 -nt 1 -o punch.msh
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.085 ];  // [m] of an edge
half = 0.5;                      // [m]
height = 0.5;                    // [m]
radius = 0.1;                    // [m] of a hole
pitch = 0.3;                     // [m]
Box(1) = {-half, -half, 0, 2 * half, 2 * half, height};
For i In {-1:1}
  For j In {-1:1}
    Cylinder(10 + 3 * (i + 1) + j + 1) = {i * pitch, j * pitch, 0, 0, 0, height, radius};
  EndFor
EndFor
BooleanDifference(2) = { Volume{1}; Delete; }{ Volume{10:18}; Delete; };
e = 1e-3;
xmin() = Surface In BoundingBox{-half - e, -half - e, -e, -half + e, half + e, height + e};
xmax() = Surface In BoundingBox{half - e, -half - e, -e, half + e, half + e, height + e};
ymin() = Surface In BoundingBox{-half - e, -half - e, -e, half + e, -half + e, height + e};
ymax() = Surface In BoundingBox{-half - e, half - e, -e, half + e, half + e, height + e};
zmin() = Surface In BoundingBox{-half - e, -half - e, -e, half + e, half + e, e};
zmax() = Surface In BoundingBox{-half - e, -half - e, height - e, half + e, half + e, height + e};
inner = pitch + radius + e;
holes() = Surface In BoundingBox{-inner, -inner, -e, inner, inner, height + e};
Physical Volume("block") = {2};
Physical Surface("xmin") = {xmin()};
Physical Surface("xmax") = {xmax()};
Physical Surface("ymin") = {ymin()};
Physical Surface("ymax") = {ymax()};
Physical Surface("zmin") = {zmin()};
Physical Surface("zmax") = {zmax()};
Physical Surface("holes") = {holes()};
Mesh.CharacteristicLengthMin = size;
Mesh.CharacteristicLengthMax = size;
