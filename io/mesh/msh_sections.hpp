// The sections of .msh files that are read: those of version 2.2 (msh22.cpp) and of version 4.1 (msh41.cpp).
#pragma once
#include "io/mesh/msh_content.hpp"

namespace nanson {

/// Each starts right behind the heading line and stops right before the $End line.
namespace msh22 {
void read_nodes(MshCursor& in, bool parametric, MshContent& content);
void read_elements(MshCursor& in, MshContent& content);
}  // namespace msh22

namespace msh41 {
void read_entities(MshCursor& in, MshContent& content);
void read_nodes(MshCursor& in, MshContent& content);
void read_elements(MshCursor& in, MshContent& content);
}  // namespace msh41

}  // namespace nanson
