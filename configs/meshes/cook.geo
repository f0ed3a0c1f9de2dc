// Cook's membrane in plane strain: one layer of tets between two planes of symmetry, an unstructured triangulation in the plane.
// Faces left (x = 0), right (x = 48), z0 and z1 (planes of symmetry); the rest is free. Region body.
// The meshes were made by: gmsh -3 cook.geo -format msh41 -nt 1 -o cook.msh, with -setnumber h 3 cook_coarse.msh,
// with -setnumber h 2 -setnumber corner 0.25 cook_graded.msh
DefineConstant[ h = 1.5, corner = 0 ];  // [m] of an edge; at the upper left corner, where the stress is singular; 0: the same
fine = corner > 0 ? corner : h;
Point(1) = {0, 0, 0, h};
Point(2) = {48, 44, 0, h};
Point(3) = {48, 60, 0, h};
Point(4) = {0, 44, 0, fine};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
e[] = Extrude {0, 0, h} { Surface{1}; Layers{1}; };
Physical Volume("body") = {e[1]};
Physical Surface("z0") = {1};
Physical Surface("z1") = {e[0]};
Physical Surface("right") = {e[3]};
Physical Surface("left") = {e[5]};
