// Square plate with a round hole: 0.2 x 0.2 x 0.02 m, hole of radius 0.03 m through its middle. Faces left and right (x = -0.1, 0.1),
// hole; the rest has no name and is traction free. Region plate.
// Made by: gmsh -3 plate_with_hole.geo -format msh41 -o plate_with_hole.msh
SetFactory("OpenCASCADE");
half = 0.1;        // [m]
thickness = 0.02;  // [m]
radius = 0.03;     // [m]
coarse = 0.02;     // [m] edges at the rim of the plate
fine = 0.008;      // [m] edges at the hole
Box(1) = {-half, -half, 0, 2 * half, 2 * half, thickness};
Cylinder(2) = {0, 0, 0, 0, 0, thickness, radius};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
hole() = Surface In BoundingBox{-radius - 1e-3, -radius - 1e-3, -1e-3, radius + 1e-3, radius + 1e-3, thickness + 1e-3};
left() = Surface In BoundingBox{-half - 1e-3, -1, -1, -half + 1e-3, 1, 1};
right() = Surface In BoundingBox{half - 1e-3, -1, -1, half + 1e-3, 1, 1};
Physical Volume("plate") = {3};
Physical Surface("left") = {left()};
Physical Surface("right") = {right()};
Physical Surface("hole") = {hole()};
Mesh.CharacteristicLengthMax = coarse;
Characteristic Length { PointsOf{ Volume{3}; } } = coarse;
Characteristic Length { PointsOf{ Surface{hole()}; } } = fine;
